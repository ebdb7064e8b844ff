#include "engine/runtime/storage/resource_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "engine/runtime/storage/formats.h"
#include "runtime_sentences.h"

namespace weft::runtime {

using graph::FlatResource;
using graph::FlatUse;
using graph::kNone;
using graph::Plan;
using graph::ResourceKind;
using graph::Storage;

namespace {

// Storage identities: unique within the process, never reused.
std::uint64_t nextSerial() {
  static std::atomic<std::uint64_t> counter{1};
  return counter++;
}

gl::TextureDesc descOf(const Storage& s) {
  return {.target = glTargetOf(s.target),
          .format = glFormatOf(s.format),
          .width = s.width,
          .height = s.height,
          .depth = s.depth,
          .layers = s.layers,
          .mips = s.mips,
          .samples = s.samples};
}

}  // namespace

std::shared_ptr<PhysicalTexture> PhysicalTexture::create(const Storage& storage, std::string owner,
                                                         const std::string& label,
                                                         text::Diagnostics& diagnostics) {
  auto made = std::make_shared<PhysicalTexture>();
  made->desc_ = descOf(storage);
  made->owner_ = std::move(owner);
  made->label_ = label;
  made->serial_ = nextSerial();
  for (std::uint32_t copy = 0; copy < storage.copies; ++copy) {
    auto texture = gl::Texture::create(made->desc_, label, diagnostics);
    if (!texture) return nullptr;
    made->textures_.push_back(std::move(*texture));
  }
  return made;
}

bool PhysicalTexture::fits(const Storage& storage, const std::string& owner) const {
  return owner == owner_ && storage.copies == copies() && descOf(storage) == desc_;
}

gl::TextureRef PhysicalTexture::view(std::uint32_t copy, const gl::ViewDesc& desc,
                                     text::Diagnostics& diagnostics) {
  const gl::Texture& texture = textures_[copy];
  const bool whole = desc.target == desc_.target && (desc.format == 0 || desc.format == desc_.format) &&
                     !desc.stencil && desc.mip == 0 && desc.mips == desc_.mips && desc.layer == 0 &&
                     desc.layers == desc_.layers;
  if (whole) return texture.ref();
  for (const View& view : views_)
    if (view.copy == copy && view.desc == desc) return view.view.ref();
  auto made = gl::Texture::create(texture.ref(), desc, label_, diagnostics);
  if (!made) return {};
  views_.push_back({copy, desc, std::move(*made)});
  return views_.back().view.ref();
}

namespace {

// Reports buffers that are larger than the largest block of the device, whose end no shader could reach.
bool checkBlocks(const Plan& plan, text::Diagnostics& diagnostics) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  bool good = true;
  for (std::size_t r = 0; r < plan.graph->resources.size(); ++r) {
    const FlatResource& resource = plan.graph->resources[r];
    if (resource.kind != ResourceKind::buffer || plan.firstStep[r] == kNone ||
        resource.bytes <= static_cast<std::uint64_t>(most))
      continue;
    good = false;
    diagnostics.error(say::bufferTooLarge, {}, plan.graph->resourceNames[r], resource.bytes, most);
  }
  return good;
}

}  // namespace

std::unique_ptr<ResourcePool> ResourcePool::create(const Plan& plan, const ResourcePool* before,
                                                   text::Diagnostics& diagnostics) {
  if (!checkBlocks(plan, diagnostics)) return nullptr;
  auto pool = std::make_unique<ResourcePool>();
  pool->resources_.resize(plan.graph->resources.size());
  pool->names_ = plan.graph->resourceNames;
  if (before) pool->findNames(*before);
  if (!pool->createTextures(plan, before, diagnostics) || !pool->createArena(plan, before, diagnostics) ||
      !pool->createBuffers(plan, before, diagnostics))
    return nullptr;
  if (before) pool->continueFrom(*before);
  std::unordered_map<std::uint32_t, const graph::Value*> clearOf;
  for (const graph::ClearSpec& clear : plan.graph->clears) clearOf[clear.resource] = &clear.value;
  for (const graph::HistorySpec& history : plan.graph->histories)
    if ((*pool)[history.resource].fresh) pool->fill(plan, history.resource, history.first, diagnostics);
  // Until a time-sliced group first publishes a resource, other passes see version zero, or zeros where there is none.
  for (std::uint32_t r = 0; r < pool->resources_.size(); ++r) {
    GpuResource& mine = (*pool)[r];
    mine.group = plan.groups.slicedWriterOf(r);
    if (mine.group == kNone || !mine.fresh || plan.graph->resources[r].history > 0) continue;
    const auto clear = clearOf.find(r);
    pool->fill(plan, r, clear == clearOf.end() ? graph::Value::number(0) : *clear->second, diagnostics);
  }
  // A plan does not know these clears; its first steps may store to the same memory.
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  return pool;
}

void ResourcePool::findNames(const ResourcePool& before) {
  std::unordered_map<std::string_view, std::uint32_t> byName;
  for (std::uint32_t r = 0; r < before.names_.size(); ++r) byName[before.names_[r]] = r;
  for (std::size_t r = 0; r < names_.size(); ++r)
    if (const auto old = byName.find(names_[r]); old != byName.end()) resources_[r].before = old->second;
}

// What was published lies in the shared storage.
void ResourcePool::continueFrom(const ResourcePool& before) {
  for (GpuResource& mine : resources_) {
    if (mine.before == kNone) continue;
    const GpuResource& old = before.resources_[mine.before];
    if (mine.fresh || mine.serial == 0 || old.serial != mine.serial) mine.before = kNone;
    if (mine.before == kNone || old.copies != mine.copies) continue;
    mine.current = old.current;
    mine.publications = old.publications;
    mine.resets = old.resets;
    mine.publishedAt = old.publishedAt;
  }
}

void ResourcePool::fill(const Plan& plan, std::uint32_t resource, const graph::Value& value,
                        text::Diagnostics& diagnostics) {
  const GpuResource& mine = resources_[resource];
  const FlatResource& r = plan.graph->resources[resource];
  for (std::uint32_t copy = 0; copy < mine.copies; ++copy) {
    if (mine.texture) {
      const gl::TextureRef ref = whole(plan, resource, copy, diagnostics);
      for (std::uint32_t mip = 0; mip < r.mips && ref.id; ++mip)
        clearTexture(ref, r.format, mip, 0, r.layers, value);
    } else if (copy < mine.buffers.size()) {
      clearBuffer(mine.buffers[copy], mine.offset, mine.bytes, value);
    }
  }
}

// First shares the storage of resources of the same name, so that passes find their textures where they were; then whatever fits.
void ResourcePool::shareTextures(const Plan& plan, const std::vector<std::string>& owners,
                                 const ResourcePool& before, Textures& textures) const {
  std::unordered_set<const PhysicalTexture*> shared;
  const auto share = [&](std::size_t s, const std::shared_ptr<PhysicalTexture>& old) {
    if (!textures[s] && old && old->fits(plan.storages[s], owners[s]) && shared.insert(old.get()).second)
      textures[s] = old;
  };
  for (std::size_t r = 0; r < resources_.size(); ++r)
    if (const std::uint32_t s = plan.storageOf[r], old = resources_[r].before; s != kNone && old != kNone)
      share(s, before.resources_[old].texture);
  for (std::size_t s = 0; s < textures.size(); ++s)
    for (std::size_t r = 0; r < before.resources_.size() && !textures[s]; ++r)
      share(s, before.resources_[r].texture);
}

bool ResourcePool::createTextures(const Plan& plan, const ResourcePool* before,
                                  text::Diagnostics& diagnostics) {
  std::vector<std::string> owners(plan.storages.size()), labels(plan.storages.size());
  for (std::size_t r = 0; r < resources_.size(); ++r) {
    const std::uint32_t s = plan.storageOf[r];
    if (s == kNone) continue;
    if (plan.storages[s].persistent) owners[s] = names_[r];
    labels[s].append(labels[s].empty() ? "" : " | ").append(names_[r]);
  }
  Textures textures(plan.storages.size());
  if (before) shareTextures(plan, owners, *before, textures);
  const Textures shared = textures;
  for (std::size_t s = 0; s < textures.size(); ++s) {
    if (!textures[s])
      textures[s] = PhysicalTexture::create(plan.storages[s], owners[s], labels[s], diagnostics);
    if (!textures[s]) return false;
  }
  for (std::size_t r = 0; r < resources_.size(); ++r) {
    const std::uint32_t s = plan.storageOf[r];
    if (s == kNone || plan.graph->resources[r].kind != ResourceKind::texture) continue;
    GpuResource& mine = resources_[r];
    mine.texture = textures[s];
    mine.copies = mine.texture->copies();
    mine.serial = mine.texture->serial();
    mine.fresh = !shared[s];
  }
  return true;
}

namespace {

constexpr GLbitfield kBufferFlags = GL_DYNAMIC_STORAGE_BIT | GL_MAP_READ_BIT;

bool fits(const PhysicalBuffer& buffer, std::size_t copies, std::uint64_t bytes) {
  return buffer.copies.size() == copies && buffer.copies[0].bytes() == bytes;
}

std::shared_ptr<PhysicalBuffer> createBuffer(std::size_t copies, std::uint64_t bytes,
                                             const std::string& label, text::Diagnostics& diagnostics) {
  auto made = std::make_shared<PhysicalBuffer>();
  made->serial = nextSerial();
  while (made->copies.size() < copies) {
    auto copy = gl::Buffer::create(bytes, kBufferFlags, label, diagnostics);
    if (!copy) return nullptr;
    made->copies.push_back(std::move(*copy));
  }
  return made;
}

}  // namespace

bool ResourcePool::createArena(const Plan& plan, const ResourcePool* before, text::Diagnostics& diagnostics) {
  if (plan.arenaBytes == 0) return true;
  if (before && before->arena_ && fits(*before->arena_, 1, plan.arenaBytes)) {
    arena_ = before->arena_;
    return true;
  }
  arena_ = createBuffer(1, plan.arenaBytes, "transient buffers", diagnostics);
  return arena_ != nullptr;
}

bool ResourcePool::createBuffers(const Plan& plan, const ResourcePool* before,
                                 text::Diagnostics& diagnostics) {
  for (std::size_t r = 0; r < resources_.size(); ++r) {
    const FlatResource& desc = plan.graph->resources[r];
    GpuResource& mine = resources_[r];
    if (desc.kind != ResourceKind::buffer || plan.firstStep[r] == kNone) continue;
    mine.bytes = desc.bytes;
    if (plan.bufferOffsetOf[r] != Plan::kNoOffset) {
      mine.offset = plan.bufferOffsetOf[r];
      mine.buffer = arena_;
      mine.fresh = !before || before->arena_ != arena_;
    } else {
      mine.copies = plan.copiesOf(static_cast<std::uint32_t>(r));
      const auto old = mine.before == kNone ? nullptr : before->resources_[mine.before].buffer;
      mine.fresh = !old || old == before->arena_ || !fits(*old, mine.copies, desc.bytes);
      mine.buffer = mine.fresh ? createBuffer(mine.copies, desc.bytes, names_[r], diagnostics) : old;
      if (!mine.buffer) return false;
    }
    mine.serial = mine.buffer->serial;
    for (const gl::Buffer& copy : mine.buffer->copies) mine.buffers.push_back(copy.id());
  }
  return true;
}

void ResourcePool::carry(const Plan& plan, StateStream& state, text::Diagnostics& diagnostics) {
  for (GpuResource& mine : resources_) {
    state.carry(mine.current);
    state.require(mine.current < mine.copies);
    for (std::uint64_t* each : {&mine.publications, &mine.resets, &mine.shows}) state.carry(*each);
    state.carry(mine.publishedAt);
  }
  if (!state.good()) return;
  // After what shaders stored; no step of the plan knows of these reads and writes.
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  for (std::uint32_t r = 0; r < resources_.size() && state.good(); ++r)
    if (plan.persistent[r]) carryContents(plan, r, state, diagnostics);
}

// Texels go as whole numbers through a view, because a driver may convert those of other formats: it need not keep which NaN one is.
void ResourcePool::carryContents(const Plan& plan, std::uint32_t resource, StateStream& state,
                                 text::Diagnostics& diagnostics) {
  const GpuResource& mine = resources_[resource];
  const FlatResource& desc = plan.graph->resources[resource];
  for (const GLuint buffer : mine.buffers) {
    if (!state.loading())
      state.put(gl::readBuffer(buffer, mine.offset, mine.bytes));
    else if (const auto bytes = state.take(mine.bytes); state.good())
      gl::uploadBuffer(buffer, mine.offset, bytes);
  }
  if (!mine.texture) return;
  const ExactTexel texel = exactTexelOf(desc.format);
  for (std::uint32_t copy = 0; copy < mine.copies; ++copy) {
    const gl::ViewDesc all{
        .target = glTargetOf(desc.target), .format = texel.view, .mips = desc.mips, .layers = desc.layers};
    const gl::TextureRef from = mine.texture->view(copy, all, diagnostics);
    for (std::uint32_t mip = 0; mip < desc.mips && from.id; ++mip) {
      const gl::Extent extent = gl::extentOf(from.desc, mip);
      for (std::uint32_t layer = 0; layer < extent.layers && state.good(); ++layer) {
        if (!state.loading()) {
          std::vector<std::byte> bytes = gl::readTexture(from, mip, layer, texel.format, texel.type);
          if (texel.type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV)  // nothing is in the bits above the stencil's
            for (std::size_t i = 0; i < bytes.size(); i += 8) std::fill_n(&bytes[i + 5], 3, std::byte{0});
          state.put(bytes);
          continue;
        }
        const auto bytes =
            state.take(std::size_t{extent.width} * extent.height * gl::texelBytes(texel.format, texel.type));
        if (state.good()) gl::uploadTexture(from, mip, layer, texel.format, texel.type, bytes);
      }
    }
  }
}

gl::TextureRef ResourcePool::view(const Plan& plan, const FlatUse& use, std::uint32_t copy, GLenum target,
                                  text::Diagnostics& diagnostics) {
  const FlatResource& desc = plan.graph->resources[use.resource];
  GpuResource& mine = resources_[use.resource];
  if (!mine.texture) return mine.imported;
  gl::ViewDesc view{.target = target ? target : glTargetOf(desc.target),
                    .format = glFormatOf(desc.format),
                    .mip = use.mip,
                    .mips = use.mips,
                    .layer = use.layer,
                    .layers = use.layers,
                    .stencil = use.planes == 2};
  return mine.texture->view(copy, view, diagnostics);
}

gl::TextureRef ResourcePool::whole(const Plan& plan, std::uint32_t resource, std::uint32_t copy,
                                   text::Diagnostics& diagnostics) {
  const FlatResource& desc = plan.graph->resources[resource];
  return view(plan, {.resource = resource, .mips = desc.mips, .layers = desc.layers}, copy, 0, diagnostics);
}

void clearTexture(const gl::TextureRef& texture, graph::Format format, std::uint32_t mip, std::uint32_t layer,
                  std::uint32_t layers, const graph::Value& value) {
  const ClearTexel texel = clearTexelOf(format, value);
  const gl::Extent extent = gl::extentOf(texture.desc, mip);
  const bool volume = texture.desc.target == GL_TEXTURE_3D;
  glClearTexSubImage(texture.id, static_cast<GLint>(mip), 0, 0, volume ? 0 : static_cast<GLint>(layer),
                     static_cast<GLsizei>(extent.width), static_cast<GLsizei>(extent.height),
                     static_cast<GLsizei>(volume ? extent.layers : layers), texel.format, texel.type,
                     texel.bytes.data());
}

void clearBuffer(GLuint buffer, std::uint64_t offset, std::uint64_t bytes, const graph::Value& value) {
  const auto begin = static_cast<GLintptr>(offset);
  const auto size = static_cast<GLsizeiptr>(bytes);
  const std::array<float, 4> texel = clearChannelsOf(value);
  const bool vector = value.type == graph::Value::Type::list && value.count == 4 && bytes % 16 == 0;
  if (vector)
    glClearNamedBufferSubData(buffer, GL_RGBA32F, begin, size, GL_RGBA, GL_FLOAT, texel.data());
  else if (bytes % 4 == 0)
    glClearNamedBufferSubData(buffer, GL_R32F, begin, size, GL_RED, GL_FLOAT, texel.data());
  else
    glClearNamedBufferSubData(buffer, GL_R8, begin, size, GL_RED, GL_FLOAT, texel.data());
}

}  // namespace weft::runtime
