#include "engine/runtime/frame/read_back.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>

#include "engine/graph/subresource.h"
#include "runtime_sentences.h"

namespace weft::runtime {

using graph::FlatResource;
using graph::FlatUse;
using graph::TexelKind;

namespace {

NumberKind kindOf(GLenum base) {
  return base == GL_UNSIGNED_INT ? NumberKind::unsigned_integer
         : base == GL_INT        ? NumberKind::signed_integer
                                 : NumberKind::floating;
}

// The kind of the members of the first block that a pass binds the buffer to.
NumberKind kindOfBuffer(std::uint32_t resource, std::span<const PreparedPass> passes) {
  for (const PreparedPass& pass : passes)
    for (const BufferBinding& binding : pass.buffers) {
      if (binding.resource != resource || binding.import != graph::kNone || binding.drawn) continue;
      const gl::Reflection& reflection = pass.variant->program.reflection();
      const bool storage = binding.target == GL_SHADER_STORAGE_BUFFER;
      for (const gl::Block& block : storage ? reflection.storageBlocks : reflection.uniformBlocks) {
        if (block.binding != binding.index || block.members.empty()) continue;
        std::optional<NumberKind> kind;
        for (const gl::BlockMember& member : block.members) {
          const auto shape = gl::shapeOf(member.type);
          const NumberKind mine = shape ? kindOf(shape->base) : NumberKind::floating;
          if (kind.value_or(mine) != mine) return NumberKind::floating;
          kind = mine;
        }
        return *kind;
      }
    }
  return NumberKind::floating;
}

NumberKind kindOfTexture(const FlatResource& resource, const FlatUse& use) {
  const TexelKind kind = graph::infoOf(resource.format).kind;
  if (kind == TexelKind::unsigned_integer || use.planes == 2) return NumberKind::unsigned_integer;
  return kind == TexelKind::signed_integer ? NumberKind::signed_integer : NumberKind::floating;
}

bool sameShape(const Output& a, const Output& b) {
  return a.name == b.name && a.channels == b.channels && a.width == b.width && a.height == b.height &&
         a.bytes.size() == b.bytes.size();
}

// What glReadPixels gets: as many channels as the format has, as numbers of 32 bits.
gl::ClientFormat clientOf(const FlatResource& resource, const FlatUse& use) {
  if (use.planes == 2) return {GL_STENCIL_INDEX, GL_UNSIGNED_INT};
  gl::ClientFormat client = gl::clientFormatOf(glFormatOf(resource.format));
  constexpr GLenum kFloats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  constexpr GLenum kIntegers[] = {GL_RED_INTEGER, GL_RG_INTEGER, GL_RGB_INTEGER, GL_RGBA_INTEGER};
  const std::size_t channels = graph::infoOf(resource.format).channels - std::size_t{1};
  if (client.channels > 1) client.format = (client.type == GL_FLOAT ? kFloats : kIntegers)[channels];
  return client;
}

}  // namespace

double Output::number(std::size_t index) const {
  std::uint32_t bits = 0;
  std::memcpy(&bits, bytes.data() + index * 4, 4);
  if (kind == NumberKind::unsigned_integer) return bits;
  if (kind == NumberKind::signed_integer) return std::bit_cast<std::int32_t>(bits);
  return std::bit_cast<float>(bits);
}

bool ReadBack::prepare(const graph::Plan& plan, std::span<const PreparedPass> passes, ReadBack* before,
                       text::Diagnostics& diagnostics) {
  std::uint64_t total = 0;
  const graph::FlatGraph& graph = *plan.graph;
  for (std::uint32_t i = 0; i < graph.outputs.size(); ++i) {
    if (plan.outputLive[i] == 0) continue;
    const FlatUse& use = graph.outputs[i];
    const FlatResource& resource = graph.resources[use.resource];
    const bool buffer = graph::isBuffer(resource);
    Output output;
    output.name = graph.outputNames[i];
    output.kind = buffer ? kindOfBuffer(use.resource, passes) : kindOfTexture(resource, use);
    if (!buffer) {
      output.channels = graph::outputChannelsOf(resource);
      output.width = std::max(1u, resource.width >> use.mip);
      output.height = std::max(1u, resource.height >> use.mip);
    }
    output.bytes.resize(graph::outputBytesOf(use, resource));
    sources_.push_back({i, total});
    total += (output.bytes.size() + 15) / 16 * 16;
    outputs_.push_back(std::move(output));
  }
  if (before) {
    before->collect();
    for (Output& mine : outputs_)
      for (const Output& old : before->outputs_)
        if (sameShape(mine, old)) {
          const NumberKind kind = mine.kind;
          mine = old;
          mine.kind = kind;
        }
    if (std::ranges::equal(outputs_, before->outputs_, sameShape)) {
      ring_ = before->ring_;
      return true;
    }
  }
  return total == 0 || createRing(total, diagnostics);
}

bool ReadBack::createRing(std::uint64_t bytes, text::Diagnostics& diagnostics) {
  // The mapping is coherent: what a copy wrote is visible once its fence has signalled, without another barrier.
  constexpr GLbitfield kAccess = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  ring_ = std::make_shared<Ring>();
  for (Slot& slot : ring_->slots) {
    if (!gl::remake(slot.buffer, bytes, kAccess | GL_CLIENT_STORAGE_BIT, "read-back", diagnostics))
      return false;
    slot.mapped = static_cast<const std::byte*>(
        glMapNamedBufferRange(slot.buffer.id(), 0, static_cast<GLsizeiptr>(bytes), kAccess));
    if (slot.mapped) continue;
    diagnostics.error(say::readBackNotMapped, {});
    return false;
  }
  return true;
}

void ReadBack::copy(const graph::Plan& plan, ResourcePool& pool, FramebufferCache& framebuffers,
                    std::uint32_t frame, text::Diagnostics& diagnostics) {
  if (!ring_ || ring_->at(0).fence) return;
  Slot& slot = ring_->at(0);
  for (const Source& source : sources_) {
    const FlatUse& use = plan.graph->outputs[source.use];
    const GpuResource& from = pool[use.resource];
    if (graph::isBuffer(plan.graph->resources[use.resource]))
      glCopyNamedBufferSubData(from.buffers[from.copyOf(use.history)], slot.buffer.id(),
                               static_cast<GLintptr>(from.offset), static_cast<GLintptr>(source.offset),
                               static_cast<GLsizeiptr>(from.bytes));
    else
      copyTexture(plan, use, pool, framebuffers, slot, source.offset, diagnostics);
  }
  slot.fence = gl::Fence::insert();
  slot.frame = frame;
  ring_->next = (ring_->next + 1) % kRing;
}

// The copy goes through a framebuffer, as the plan's barriers expect (engine/graph/compile/hazards.cpp).
void ReadBack::copyTexture(const graph::Plan& plan, const FlatUse& use, ResourcePool& pool,
                           FramebufferCache& framebuffers, const Slot& slot, std::uint64_t offset,
                           text::Diagnostics& diagnostics) {
  const FlatResource& resource = plan.graph->resources[use.resource];
  const gl::TextureRef texture =
      pool.whole(plan, use.resource, pool[use.resource].copyOf(use.history), diagnostics);
  const gl::ClientFormat client = clientOf(resource, use);
  const bool plain = resource.target == graph::Target::texture_2d,
             volume = resource.target == graph::Target::texture_3d;
  glBindBuffer(GL_PIXEL_PACK_BUFFER, slot.buffer.id());
  for (std::uint32_t mip = use.mip; mip < std::uint32_t{use.mip} + use.mips; ++mip) {
    const std::uint32_t width = std::max(1u, resource.width >> mip),
                        height = std::max(1u, resource.height >> mip);
    const std::uint32_t layers = volume ? std::max(1u, resource.depth >> mip) : use.layers;
    for (std::uint32_t layer = use.layer; layer < use.layer + layers; ++layer) {
      const gl::Attachment attachment{.point = gl::attachmentPointOf(glFormatOf(resource.format)),
                                      .texture = texture.id,
                                      .mip = mip,
                                      .layer = plain ? -1 : static_cast<std::int32_t>(layer)};
      static const std::string label = "read-back";
      glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers.get({&attachment, 1}, label, diagnostics));
      glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), client.format,
                   client.type, reinterpret_cast<void*>(offset));
      offset += std::uint64_t{width} * height * graph::outputChannelsOf(resource) * 4;
    }
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void ReadBack::collect() {
  if (!ring_) return;
  const Slot* newest = nullptr;
  for (std::size_t i = 0; i < kRing; ++i) {
    Slot& slot = ring_->at(i);
    if (!slot.fence) continue;
    if (!slot.fence.isSignalled()) break;
    slot.fence.reset();
    newest = &slot;
  }
  if (newest) take(*newest);
}

void ReadBack::finish() {
  if (!ring_) return;
  const Slot& last = ring_->at(kRing - 1);
  if (last.fence) last.fence.wait(std::numeric_limits<std::uint64_t>::max());
  collect();
}

void ReadBack::take(const Slot& slot) {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    Output& output = outputs_[i];
    std::memcpy(output.bytes.data(), slot.mapped + sources_[i].offset, output.bytes.size());
    output.arrived = true;
    output.frame = slot.frame;
  }
}

const Output* ReadBack::find(std::string_view name) const {
  const auto found = std::ranges::find(outputs_, name, &Output::name);
  return found == outputs_.end() ? nullptr : &*found;
}

}  // namespace weft::runtime
