// One step of the frame loop: clears, bindings, the pass itself.
#include <cstring>

#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/gl_state.h"
#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

using graph::FlatUse;
using graph::kNone;

void Execution::runStep(std::size_t step, base::Diagnostics& diagnostics) {
  PreparedPass& pass = passes_[step];
  const gl::DebugGroup group(device_.context.debugLog(), pass.context.spec->name);
  device_.timers.begin(static_cast<std::uint32_t>(step));
  const GLuint framebuffer = pass.attachments.empty() ? 0 : framebufferOf(pass, diagnostics);
  if (!pass.clears.empty() && cadence_->slices(step).begins()) {
    openMasks(states_);
    for (const ClearCommand& clear : pass.clears) {
      const GpuResource& resource = (*pool_)[clear.use.resource];
      const std::uint32_t copy = resource.copyOf(0, pass.job);
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
          glClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, value[0],
                                    list ? static_cast<GLint>(value[1]) : 0);
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
  if (const std::uint16_t after = plan_->steps[step].barriersAfterClears)
    glMemoryBarrier(glBarriersOf(after));
  bind(pass, diagnostics);
  if (framebuffer) {
    states_.bindFramebuffer(framebuffer);
    applyState(pass, states_);
    scissorTo(pass, states_);
  } else {
    openMasks(states_);
  }
  if (pass.feedback) glTextureBarrier();
  pass.type->execute(pass.context);
  device_.timers.end(static_cast<std::uint32_t>(step));
}

GLuint Execution::framebufferOf(PreparedPass& pass, base::Diagnostics& diagnostics) {
  attachmentScratch_.clear();
  for (const AttachmentBinding& attachment : pass.attachments) {
    const GpuResource& resource = (*pool_)[attachment.resource];
    attachmentScratch_.push_back(
        {.point = attachment.point,
         .texture = attachment.textures[resource.copyOf(attachment.use.history, pass.job)],
         .mip = attachment.mip,
         .layer = attachment.layer});
  }
  return framebuffers_.get(attachmentScratch_, pass.context.spec->name, diagnostics);
}

void Execution::bind(PreparedPass& pass, base::Diagnostics& diagnostics) {
  if (pass.variant) states_.useProgram(pass.variant->program.id());
  if (pass.context.geometry.vertexArray) states_.bindVertexArray(pass.context.geometry.vertexArray);
  for (const TextureBinding& binding : pass.textures) {
    const GpuResource& resource = (*pool_)[binding.resource];
    const GLuint texture = binding.views.empty() ? resource.importedFor(binding.history, pass.job)
                                                 : binding.views[resource.copyOf(binding.history, pass.job)];
    states_.bindTexture(binding.unit, texture);
    states_.bindSampler(binding.unit, binding.sampler);
  }
  for (const ImageBinding& binding : pass.images) {
    const GpuResource& resource = (*pool_)[binding.resource];
    const GLuint texture = binding.views.empty() ? resource.importedFor(binding.history, pass.job)
                                                 : binding.views[resource.copyOf(binding.history, pass.job)];
    states_.bindImage(binding.unit, texture, binding.layered, binding.access, binding.format);
  }
  for (const BufferBinding& binding : pass.buffers) {
    if (binding.list >= 0) {
      const auto list = static_cast<scene::DrawList>(binding.list);
      const BufferRef table = device_.imports.instances(list, binding.layout, diagnostics);
      states_.bindBuffer(binding.target, binding.index, table.id, 0, 0);
      continue;
    }
    if (binding.import != kNone) {
      const BufferRef table =
          device_.imports.buffer(plan_->graph->imports[binding.import], binding.layout, diagnostics);
      states_.bindBuffer(binding.target, binding.index, table.id, 0, 0);
      continue;
    }
    const GpuResource& resource = (*pool_)[binding.resource];
    states_.bindBuffer(binding.target, binding.index,
                       resource.buffers[resource.copyOf(binding.history, pass.job)],
                       static_cast<GLintptr>(resource.offset), static_cast<GLsizeiptr>(resource.bytes));
  }
  const auto bindBlock = [&](const gl::Block* block, std::uint32_t offset) {
    if (block) states_.bindBuffer(GL_UNIFORM_BUFFER, block->binding, uniforms_.id(), offset, block->bytes);
  };
  bindBlock(pass.parametersBlock, pass.parametersOffset);
  bindBlock(pass.viewBlock, pass.viewOffset);
  bindBlock(pass.sliceBlock, pass.sliceOffset);
  for (const FixedBinding& binding : pass.fixed) {
    const GpuResource& resource = (*pool_)[binding.resource];
    passes::BoundTexture& bound = binding.source ? pass.context.source : pass.context.destination;
    const GLuint view = binding.views.empty() ? resource.importedFor(binding.history, pass.job)
                                              : binding.views[resource.copyOf(binding.history, pass.job)];
    bound.name = view;
    if (!pass.framebuffers) continue;
    const auto kind = graph::infoOf(plan_->graph->resources[binding.resource].format).kind;
    const GLenum point = kind == graph::TexelKind::depth           ? GL_DEPTH_ATTACHMENT
                         : kind == graph::TexelKind::depth_stencil ? GL_DEPTH_STENCIL_ATTACHMENT
                                                                   : GL_COLOR_ATTACHMENT0;
    const gl::Attachment attachment{.point = point, .texture = view};
    bound.framebuffer = framebuffers_.get({&attachment, 1}, pass.context.spec->name, diagnostics);
  }
  if (pass.list >= 0)
    pass.context.instances = device_.imports.countOf(static_cast<scene::DrawList>(pass.list));
}

}  // namespace weft::runtime
