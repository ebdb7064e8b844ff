// The frame loop. Preparing stands in execution_prepare.cpp.
#include "engine/runtime/execution.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

#include "engine/base/hash.h"
#include "engine/runtime/formats.h"
#include "engine/runtime/gl_state.h"

namespace weft::runtime {

using graph::Access;
using graph::FlatUse;
using graph::kNone;

FrameReport Execution::frame(const World& world, const FrameInput& input, base::Diagnostics& diagnostics) {
  world_ = &world;
  input_ = input;
  device_.imports.beginFrame(world, input);
  refreshImports(diagnostics);
  resetHistories(diagnostics);
  refreshUniforms();
  refreshOwnHashes();
  generationsBefore_ = generations_;
  cadence_->decide(own_, generations_);
  if (uniformsDirty_ && !uniformBytes_.empty()) {
    gl::uploadBuffer(uniforms_.id(), 0, uniformBytes_);
    uniformsDirty_ = false;
  }
  std::fill(rotated_.begin(), rotated_.end(), std::uint8_t{0});
  FrameReport report;
  device_.timers.beginFrame(static_cast<std::uint32_t>(passes_.size()));
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const graph::Step& planned = plan_->steps[step];
    if (planned.barriers) {
      GLbitfield bits = glBarriersOf(planned.barriers);
      // The plan counts a clear as a texture update; a clear of an attachment goes through the framebuffer instead.
      if (planned.barriers & graph::kBarrierTextureUpdate) bits |= GL_FRAMEBUFFER_BARRIER_BIT;
      // The specification names no bit for glGenerateTextureMipmap; drivers fetch, render or copy: order all three.
      if (passes_[step].context.spec->type == "mipmap")
        bits |= GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT;
      glMemoryBarrier(bits);
      ++report.barriers;
    }
    if (!cadence_->runs(step) || !passes_[step].usable) {
      if (planned.barriersAfterClears) glMemoryBarrier(glBarriersOf(planned.barriersAfterClears));
      ++report.passesSkipped;
      continue;
    }
    runStep(step, diagnostics);
    ++report.passesRun;
  }
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (cadence_->runs(step) && passes_[step].usable) cadence_->remember(step, own_[step], generationsBefore_, generations_);
  device_.timers.endFrame();
  if (plan_->finalBarriers) {
    glMemoryBarrier(glBarriersOf(plan_->finalBarriers));
    ++report.barriers;
  }
  ++framesRun_;
  return report;
}

void Execution::refreshImports(base::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t r = 0; r < graph.resources.size(); ++r) {
    const graph::FlatResource& desc = graph.resources[r];
    if (desc.import == kNone) continue;
    const graph::ImportSpec& import = graph.imports[desc.import];
    if (desc.kind == graph::ResourceKind::imported_texture) (*pool_)[r].imported = device_.imports.texture(import, diagnostics);
    generations_[r] = device_.imports.generation(import);
  }
}

void Execution::resetHistories(base::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t h = 0; h < graph.histories.size(); ++h) {
    const graph::HistorySpec& history = graph.histories[h];
    std::uint64_t state = base::kHashSeed;
    for (const std::uint32_t import : history.resetImports)
      state = base::hashCombine(state, device_.imports.generation(graph.imports[import]));
    for (const std::uint32_t resource : history.resetResources) state = base::hashCombine(state, generations_[resource]);
    for (const graph::Value& value : history.resetValues)
      for (const double x : value.v) state = base::hashCombine(state, std::bit_cast<std::uint64_t>(x));
    const bool changed = framesRun_ > 0 && state != resetState_[h];
    resetState_[h] = state;
    if (!changed) continue;
    GpuResource& resource = (*pool_)[history.resource];
    resource.publications = 0;
    const graph::FlatResource& desc = graph.resources[history.resource];
    for (std::uint32_t copy = 0; copy < resource.copies; ++copy) {
      if (resource.texture) {
        const FlatUse all{.resource = history.resource, .mips = desc.mips, .layers = desc.layers};
        const gl::TextureRef ref = pool_->view(*plan_, all, copy, 0, diagnostics);
        for (std::uint32_t mip = 0; mip < desc.mips; ++mip)
          clearTexture(ref, desc.format, mip, 0, desc.layers, history.first);
      } else if (copy < resource.buffers.size()) {
        clearBuffer(resource.buffers[copy], resource.offset, resource.bytes, history.first);
      }
    }
  }
}

void Execution::refreshUniforms() {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    PreparedPass& pass = passes_[step];
    if (!pass.usable) continue;
    const bool timeless = graph.passes[plan_->steps[step].pass].cadence != graph::Cadence::always;
    for (const DynamicUniform& uniform : pass.dynamics) {
      const graph::Value value = uniform.expr.evaluateFolded([this](std::uint32_t key) {
        const GpuResource& resource = (*pool_)[key];
        // Not published yet: about to be. A headless run publishes everything before its frame 0.
        if (resource.publications == 0)
          return input_.headless && framesRun_ == 0 ? std::numeric_limits<double>::infinity() : 0.0;
        return std::max(0.0, input_.time - resource.publishedAt);
      });
      std::byte* at = uniformBytes_.data() + pass.parametersOffset;
      std::byte before[32];
      std::memcpy(before, at + uniform.member.offset, 16);
      writeValue(at, uniform.member, value);
      uniformsDirty_ |= std::memcmp(before, at + uniform.member.offset, 16) != 0;
    }
    if (pass.viewBlock) {
      const graph::PassSpec& spec = *pass.context.spec;
      const graph::ImportSpec* import = spec.view == kNone ? nullptr : &graph.imports[spec.view];
      const scene::ViewData& view = device_.imports.view(import, graph.screenWidth, graph.screenHeight);
      writeView(uniformBytes_.data() + pass.viewOffset, *pass.viewBlock, view,
                {static_cast<float>(pass.width), static_cast<float>(pass.height)}, timeless);
      uniformsDirty_ = true;
    }
  }
}

void Execution::refreshOwnHashes() {
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const PreparedPass& pass = passes_[step];
    if (plan_->graph->passes[plan_->steps[step].pass].cadence == graph::Cadence::always) continue;
    std::uint64_t own = pass.programHash;
    const auto mix = [&](std::uint32_t offset, const gl::Block* block) {
      if (!block) return;
      const auto* bytes = reinterpret_cast<const char*>(uniformBytes_.data() + offset);
      own = base::hashBytes({bytes, block->bytes}, own);
    };
    mix(pass.parametersOffset, pass.parametersBlock);
    mix(pass.viewOffset, pass.viewBlock);
    for (const std::uint32_t resource : pass.written) own = base::hashCombine(own, (*pool_)[resource].serial);
    for (const std::uint32_t axis : pass.context.spec->threads) own = base::hashCombine(own, axis);
    own_[step] = own;
  }
}

// The first running writer of a resource in a frame turns its history by one and publishes.
void Execution::rotateWritten(const PreparedPass& pass) {
  for (const std::uint32_t r : pass.written) {
    generations_[r] = nextGeneration_++;
    if (rotated_[r]) continue;
    rotated_[r] = 1;
    GpuResource& resource = (*pool_)[r];
    if (resource.copies > 1) resource.current = (resource.current + 1) % resource.copies;
    ++resource.publications;
    const bool beforeFirst = input_.headless && framesRun_ == 0;
    resource.publishedAt = beforeFirst ? -std::numeric_limits<double>::infinity() : input_.time;
  }
}

void Execution::runStep(std::size_t step, base::Diagnostics& diagnostics) {
  PreparedPass& pass = passes_[step];
  const gl::DebugGroup group(device_.context.debugLog(), pass.context.spec->name);
  device_.timers.begin(static_cast<std::uint32_t>(step));
  rotateWritten(pass);
  const GLuint framebuffer = pass.attachments.empty() ? 0 : framebufferOf(pass, diagnostics);
  if (!pass.clears.empty()) {
    openMasks();
    for (const ClearCommand& clear : pass.clears) {
      const GpuResource& resource = (*pool_)[clear.use.resource];
      const std::uint32_t copy = resource.copyOf(0);
      if (!resource.texture) {
        clearBuffer(resource.buffers[copy], resource.offset, resource.bytes, clear.value);
      } else if (clear.attachment >= 0 && framebuffer) {
        const GLenum point = pass.attachments[static_cast<std::size_t>(clear.attachment)].point;
        const std::array<float, 4> value = clearChannelsOf(clear.value);
        const auto texel = clearTexelOf(clear.format, clear.value);
        const auto kind = graph::infoOf(clear.format).kind;
        const auto index = static_cast<GLint>(point - GL_COLOR_ATTACHMENT0);
        if (kind == graph::TexelKind::depth) {
          glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, value.data());
        } else if (kind == graph::TexelKind::depth_stencil) {
          const bool list = clear.value.type == graph::Value::Type::list;
          glClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, value[0], list ? static_cast<GLint>(value[1]) : 0);
        } else if (kind == graph::TexelKind::unsigned_integer) {
          GLuint bits[4];
          std::memcpy(bits, texel.bytes.data(), sizeof bits);
          glClearNamedFramebufferuiv(framebuffer, GL_COLOR, index, bits);
        } else if (kind == graph::TexelKind::signed_integer) {
          GLint bits[4];
          std::memcpy(bits, texel.bytes.data(), sizeof bits);
          glClearNamedFramebufferiv(framebuffer, GL_COLOR, index, bits);
        } else {
          glClearNamedFramebufferfv(framebuffer, GL_COLOR, index, value.data());
        }
      } else {
        const graph::FlatResource& desc = plan_->graph->resources[clear.use.resource];
        const FlatUse all{.resource = clear.use.resource, .mips = desc.mips, .layers = desc.layers};
        const gl::TextureRef ref = pool_->view(*plan_, all, copy, 0, diagnostics);
        for (std::uint32_t mip = clear.use.mip; mip < clear.use.mip + clear.use.mips; ++mip)
          clearTexture(ref, clear.format, mip, clear.use.layer, clear.use.layers, clear.value);
      }
    }
  }
  if (const std::uint16_t after = plan_->steps[step].barriersAfterClears) glMemoryBarrier(glBarriersOf(after));
  bind(pass, diagnostics);
  if (framebuffer) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    applyState(pass);
  } else {
    openMasks();
  }
  if (pass.feedback) glTextureBarrier();
  pass.type->execute(pass.context);
  device_.timers.end(static_cast<std::uint32_t>(step));
}

GLuint Execution::framebufferOf(PreparedPass& pass, base::Diagnostics& diagnostics) {
  attachmentScratch_.clear();
  for (const AttachmentBinding& attachment : pass.attachments) {
    const GpuResource& resource = (*pool_)[attachment.resource];
    attachmentScratch_.push_back({.point = attachment.point,
                                  .texture = attachment.textures[resource.copyOf(attachment.use.history)],
                                  .mip = attachment.mip,
                                  .layer = attachment.layer});
  }
  return framebuffers_.get(attachmentScratch_, pass.context.spec->name, diagnostics);
}

void Execution::bind(PreparedPass& pass, base::Diagnostics& diagnostics) {
  if (pass.variant) glUseProgram(pass.variant->program.id());
  for (const TextureBinding& binding : pass.textures) {
    const GpuResource& resource = (*pool_)[binding.resource];
    const GLuint texture = binding.views.empty() ? resource.imported.id : binding.views[resource.copyOf(binding.history)];
    glBindTextureUnit(binding.unit, texture);
    glBindSampler(binding.unit, binding.sampler);
  }
  for (const ImageBinding& binding : pass.images) {
    const GpuResource& resource = (*pool_)[binding.resource];
    const GLuint texture = binding.views.empty() ? resource.imported.id : binding.views[resource.copyOf(binding.history)];
    glBindImageTexture(binding.unit, texture, 0, binding.layered, 0, binding.access, binding.format);
  }
  for (const BufferBinding& binding : pass.buffers) {
    if (binding.list >= 0) {
      const auto list = static_cast<scene::DrawList>(binding.list);
      const BufferRef table = device_.imports.instances(list, binding.layout, diagnostics);
      glBindBufferBase(binding.target, binding.index, table.id);
      continue;
    }
    if (binding.import != kNone) {
      const BufferRef table =
          device_.imports.buffer(plan_->graph->imports[binding.import], binding.layout, diagnostics);
      glBindBufferBase(binding.target, binding.index, table.id);
      continue;
    }
    const GpuResource& resource = (*pool_)[binding.resource];
    glBindBufferRange(binding.target, binding.index, resource.buffers[resource.copyOf(binding.history)],
                      static_cast<GLintptr>(resource.offset), static_cast<GLsizeiptr>(resource.bytes));
  }
  const auto bindBlock = [&](const gl::Block* block, std::uint32_t offset) {
    if (block) glBindBufferRange(GL_UNIFORM_BUFFER, block->binding, uniforms_.id(), offset, block->bytes);
  };
  bindBlock(pass.parametersBlock, pass.parametersOffset);
  bindBlock(pass.viewBlock, pass.viewOffset);
  for (const FixedBinding& binding : pass.fixed) {
    const GpuResource& resource = (*pool_)[binding.resource];
    passes::BoundTexture& bound = binding.source ? pass.context.source : pass.context.destination;
    const GLuint view = binding.views.empty() ? resource.imported.id : binding.views[resource.copyOf(binding.history)];
    bound.name = view;
    if (pass.context.spec->type != "blit") continue;
    const auto kind = graph::infoOf(plan_->graph->resources[binding.resource].format).kind;
    const GLenum point = kind == graph::TexelKind::depth           ? GL_DEPTH_ATTACHMENT
                         : kind == graph::TexelKind::depth_stencil ? GL_DEPTH_STENCIL_ATTACHMENT
                                                                   : GL_COLOR_ATTACHMENT0;
    const gl::Attachment attachment{.point = point, .texture = view};
    bound.framebuffer = framebuffers_.get({&attachment, 1}, pass.context.spec->name, diagnostics);
  }
  if (pass.list >= 0) pass.context.instances = device_.imports.countOf(static_cast<scene::DrawList>(pass.list));
}

std::uint32_t Execution::lastVersionOf(std::string_view name) const {
  std::uint32_t found = kNone;
  const auto& names = plan_->graph->resourceNames;
  for (std::uint32_t r = 0; r < names.size(); ++r) {
    const std::string_view each = names[r];
    const bool version = each == name || (each.starts_with(name) && each.size() > name.size() && each[name.size()] == '#');
    if (version && plan_->firstStep[r] != kNone) found = r;
  }
  return found;
}

gl::TextureRef Execution::texture(std::string_view name) {
  const std::uint32_t r = lastVersionOf(name);
  return r == kNone ? gl::TextureRef{} : texture(r);
}

gl::TextureRef Execution::texture(std::uint32_t r) {
  base::Diagnostics ignored;
  const graph::FlatResource& desc = plan_->graph->resources[r];
  const FlatUse all{.resource = r, .mips = desc.mips, .layers = desc.layers};
  return pool_->view(*plan_, all, (*pool_)[r].copyOf(0), 0, ignored);
}

BufferRef Execution::buffer(std::string_view name, std::uint64_t& offset) {
  const std::uint32_t r = lastVersionOf(name);
  if (r == kNone || (*pool_)[r].buffers.empty()) return {};
  const GpuResource& resource = (*pool_)[r];
  offset = resource.offset;
  return {resource.buffers[resource.copyOf(0)], resource.bytes};
}

gl::TextureRef Execution::presented() {
  const FlatUse& use = plan_->graph->present;
  if (use.resource == kNone) return {};
  base::Diagnostics ignored;
  return pool_->view(*plan_, use, (*pool_)[use.resource].copyOf(0), GL_TEXTURE_2D, ignored);
}

gl::TextureRef Execution::presentedWhole() {
  FlatUse all = plan_->graph->present;
  if (all.resource == kNone) return {};
  const graph::FlatResource& desc = plan_->graph->resources[all.resource];
  all.mip = all.layer = 0;
  all.mips = desc.mips;
  all.layers = desc.layers;
  base::Diagnostics ignored;
  return pool_->view(*plan_, all, (*pool_)[all.resource].copyOf(0), 0, ignored);
}

bool Execution::ran(std::string_view pass) const {
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (passes_[step].context.spec->name == pass) return cadence_->runs(step) && passes_[step].usable;
  return false;
}

}  // namespace weft::runtime
