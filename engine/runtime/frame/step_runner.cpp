// One step of a frame: clears, bindings, the pass itself.
#include "engine/runtime/frame/step_runner.h"

#include <cstring>

#include "engine/runtime/frame/gl_state.h"
#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

using graph::FlatUse;
using graph::kNone;

void StepRunner::run(std::size_t step, PreparedPass& pass, bool clears, base::Diagnostics& diagnostics) {
  const gl::DebugGroup group(device_.context.debugLog(), pass.context.spec->name);
  device_.timers.begin(static_cast<std::uint32_t>(step));
  const GLuint framebuffer = pass.attachments.empty() ? 0 : framebufferOf(pass, diagnostics);
  if (clears && !pass.clears.empty()) clear(pass, framebuffer, diagnostics);
  if (const std::uint16_t after = plan_.steps[step].barriersAfterClears) glMemoryBarrier(glBarriersOf(after));
  const bool bound = bind(pass, diagnostics);
  if (framebuffer) {
    states_.bindFramebuffer(framebuffer);
    applyState(pass, states_);
    scissorTo(pass, states_);
  } else {
    openMasks(states_);
  }
  if (pass.feedback) glTextureBarrier();
  if (bound) pass.type->execute(pass.context);
  device_.timers.end(static_cast<std::uint32_t>(step));
}

void StepRunner::clear(const PreparedPass& pass, GLuint framebuffer, base::Diagnostics& diagnostics) {
  openMasks(states_);
  for (const ClearCommand& clear : pass.clears) {
    const GpuResource& resource = pool_[clear.use.resource];
    const std::uint32_t copy = resource.copyOf(0, pass.group);
    if (!resource.texture) {
      clearBuffer(resource.buffers[copy], resource.offset, resource.bytes, clear.value);
    } else if (clear.attachment >= 0 && framebuffer) {
      clearAttachment(framebuffer, pass.attachments[static_cast<std::size_t>(clear.attachment)].point, clear);
    } else {
      const graph::FlatResource& desc = plan_.graph->resources[clear.use.resource];
      const FlatUse all{.resource = clear.use.resource, .mips = desc.mips, .layers = desc.layers};
      const gl::TextureRef ref = pool_.view(plan_, all, copy, 0, diagnostics);
      for (std::uint32_t mip = clear.use.mip; mip < clear.use.mip + clear.use.mips; ++mip)
        clearTexture(ref, clear.format, mip, clear.use.layer, clear.use.layers, clear.value);
    }
  }
}

void StepRunner::clearAttachment(GLuint framebuffer, GLenum point, const ClearCommand& clear) {
  const std::array<float, 4> value = clearChannelsOf(clear.value);
  const auto texel = clearTexelOf(clear.format, clear.value);
  const auto index = static_cast<GLint>(point - GL_COLOR_ATTACHMENT0);
  switch (graph::infoOf(clear.format).kind) {
    case graph::TexelKind::depth:
      glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, value.data());
      break;
    case graph::TexelKind::depth_stencil: {
      const bool list = clear.value.type == graph::Value::Type::list;
      glClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, value[0],
                                list ? static_cast<GLint>(value[1]) : 0);
      break;
    }
    case graph::TexelKind::unsigned_integer: {
      GLuint bits[4];
      std::memcpy(bits, texel.bytes.data(), sizeof bits);
      glClearNamedFramebufferuiv(framebuffer, GL_COLOR, index, bits);
      break;
    }
    case graph::TexelKind::signed_integer: {
      GLint bits[4];
      std::memcpy(bits, texel.bytes.data(), sizeof bits);
      glClearNamedFramebufferiv(framebuffer, GL_COLOR, index, bits);
      break;
    }
    default:
      glClearNamedFramebufferfv(framebuffer, GL_COLOR, index, value.data());
  }
}

GLuint StepRunner::framebufferOf(const PreparedPass& pass, base::Diagnostics& diagnostics) {
  scratch_.clear();
  for (const AttachmentBinding& attachment : pass.attachments) {
    const GpuResource& resource = pool_[attachment.resource];
    scratch_.push_back({.point = attachment.point,
                        .texture = attachment.textures[resource.copyOf(attachment.use.history, pass.group)],
                        .mip = attachment.mip,
                        .layer = attachment.layer});
  }
  return framebuffers_.get(scratch_, pass.context.spec->name, diagnostics);
}

namespace {

GLuint viewOf(const GpuResource& resource, const std::vector<GLuint>& views, std::uint32_t history,
              std::uint32_t group) {
  return views.empty() ? resource.importedFor(group).id : views[resource.copyOf(history, group)];
}

}  // namespace

template <class Binding>
GLuint StepRunner::textureOf(const Binding& binding, const PreparedPass& pass,
                             base::Diagnostics& diagnostics) {
  const GpuResource& resource = pool_[binding.resource];
  if (!binding.part) return viewOf(resource, binding.views, binding.history, pass.group);
  const graph::ImportSpec& import = plan_.graph->imports[plan_.graph->resources[binding.resource].import];
  return binding.part->viewOf(resource.importedFor(pass.group), device_.imports.generation(import),
                              diagnostics);
}

bool StepRunner::bind(PreparedPass& pass, base::Diagnostics& diagnostics) {
  if (pass.meshes) gatherMeshes(pass, diagnostics);
  if (pass.variant) states_.useProgram(pass.variant->program.id());
  if (pass.context.geometry.vertexArray) states_.bindVertexArray(pass.context.geometry.vertexArray);
  const auto holds = [&](const FirstOf& first) {
    return first.resource == kNone || !pool_[first.resource].hasPublication(first.history, pass.group);
  };
  for (const TextureBinding& binding : pass.textures) {
    if (!holds(binding.firstOf)) continue;
    states_.bindTexture(binding.unit, textureOf(binding, pass, diagnostics));
    states_.bindSampler(binding.unit, binding.sampler);
  }
  for (const ImageBinding& binding : pass.images) {
    if (!holds(binding.firstOf)) continue;
    states_.bindImage(binding.unit, textureOf(binding, pass, diagnostics), binding.layered, binding.access,
                      binding.format);
  }
  for (const BufferBinding& binding : pass.buffers)
    if (holds(binding.firstOf)) bindBuffer(binding, pass.group, diagnostics);
  bindBlock(pass.parametersBlock, pass.parametersOffset);
  bindBlock(pass.viewBlock, pass.viewOffset);
  bindBlock(pass.sliceBlock, pass.sliceOffset);
  bool bound = true;
  for (const FixedBinding& binding : pass.fixed)
    if (holds(binding.firstOf)) bound = bindFixed(binding, pass, diagnostics) && bound;
  if (pass.list >= 0 && !pass.meshes)
    pass.context.instances = device_.imports.tables().countOf(static_cast<scene::DrawList>(pass.list));
  return bound;
}

// Takes the draw commands of what the pass's view sees of the meshes in its list.
void StepRunner::gatherMeshes(PreparedPass& pass, base::Diagnostics& diagnostics) {
  const imports::MeshDraw draw = device_.imports.tables().draw(*pass.meshes, diagnostics);
  pass.context.geometry = {.vertexArray = draw.vertexArray,
                           .mode = GL_TRIANGLES,
                           .count = draw.count,
                           .indexType = GL_UNSIGNED_INT,
                           .commands = draw.commands};
}

void StepRunner::bindBuffer(const BufferBinding& binding, std::uint32_t group,
                            base::Diagnostics& diagnostics) {
  if (binding.list >= 0) {
    const auto list = static_cast<scene::DrawList>(binding.list);
    imports::SceneTables& tables = device_.imports.tables();
    const BufferRef table = binding.meshes ? tables.meshes(list, binding.layout, diagnostics)
                                           : tables.spheres(list, binding.layout, diagnostics);
    states_.bindBuffer(binding.target, binding.index, table.id, 0, 0);
  } else if (binding.import != kNone) {
    const graph::ImportSpec& import = plan_.graph->imports[binding.import];
    const BufferRef table = device_.imports.buffer(import, binding.layout, diagnostics);
    states_.bindBuffer(binding.target, binding.index, table.id, 0, 0);
  } else {
    const GpuResource& resource = pool_[binding.resource];
    states_.bindBuffer(binding.target, binding.index,
                       resource.buffers[resource.copyOf(binding.history, group)],
                       static_cast<GLintptr>(resource.offset), static_cast<GLsizeiptr>(resource.bytes));
  }
}

void StepRunner::bindBlock(const gl::Block* block, std::uint32_t offset) {
  if (block) states_.bindBuffer(GL_UNIFORM_BUFFER, block->binding, uniforms_.buffer(), offset, block->bytes);
}

// Binds what a pass type without a shader works on: GL names of textures, and framebuffers around them if it wants some.
bool StepRunner::bindFixed(const FixedBinding& binding, PreparedPass& pass, base::Diagnostics& diagnostics) {
  if (const GpuResource& resource = pool_[binding.resource]; !resource.texture && !resource.buffers.empty()) {
    (binding.source ? pass.context.sourceBuffer : pass.context.destinationBuffer) = {
        .name = resource.buffers[resource.copyOf(binding.history, pass.group)],
        .offset = static_cast<GLintptr>(resource.offset),
        .bytes = static_cast<GLsizeiptr>(resource.bytes)};
    return true;
  }
  passes::BoundTexture& bound = binding.source ? pass.context.source : pass.context.destination;
  bound.name = textureOf(binding, pass, diagnostics);
  if (!pass.framebuffers || !bound.name) return bound.name != 0;
  const GLuint whole = viewOf(pool_[binding.resource], binding.textures, binding.history, pass.group);
  const graph::FlatResource& shape = plan_.graph->resources[binding.resource];
  bound.texture = whole;
  bound.target = glTargetOf(shape.target);
  bound.level = static_cast<GLint>(binding.mip);
  bound.layer = std::max(0, binding.layer);
  if (pass.context.exact) return true;
  const gl::Attachment attachment{.point = attachmentPointOf(glFormatOf(shape.format)),
                                  .texture = whole,
                                  .mip = binding.mip,
                                  .layer = binding.layer};
  bound.framebuffer = framebuffers_.get({&attachment, 1}, pass.context.spec->name, diagnostics);
  return true;
}

}  // namespace weft::runtime
