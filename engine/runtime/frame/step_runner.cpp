// One step of a frame: bindings, clears, the pass itself.
#include "engine/runtime/frame/step_runner.h"

#include <cstring>

#include "engine/gl/context/debug.h"
#include "engine/gl/context/state.h"
#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

using graph::kNone;

namespace {

// In the order of the enumerations.
// clang-format off
constexpr GLenum kFactors[] = {
    GL_ZERO, GL_ONE, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR,
    GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA,
    GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR, GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_SRC_ALPHA_SATURATE};
// clang-format on
constexpr GLenum kEquations[] = {GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX};
constexpr GLenum kStencilOps[] = {GL_KEEP,      GL_ZERO, GL_REPLACE,   GL_INCR,
                                  GL_INCR_WRAP, GL_DECR, GL_DECR_WRAP, GL_INVERT};

template <class Enum, std::size_t kCount>
GLenum glOf(const GLenum (&all)[kCount], Enum value) {
  return all[static_cast<std::size_t>(value)];
}

void applyBlend(GLuint index, const graph::Blend& blend) {
  const bool on = !(blend == graph::Blend{});
  (on ? glEnablei : glDisablei)(GL_BLEND, index);
  if (!on) return;
  const auto& [color, alpha] = blend;
  glBlendEquationSeparatei(index, glOf(kEquations, color.equation), glOf(kEquations, alpha.equation));
  glBlendFuncSeparatei(index, glOf(kFactors, color.source), glOf(kFactors, color.destination),
                       glOf(kFactors, alpha.source), glOf(kFactors, alpha.destination));
}

// Of the faces; what the pass only reads is not written.
void applyStencil(const graph::StencilState* stencil, bool writable) {
  gl::enable(GL_STENCIL_TEST, stencil != nullptr);
  if (!stencil) return;
  glStencilMask(writable ? stencil->writeMask : 0u);
  for (const GLenum side : {GL_FRONT, GL_BACK}) {
    const graph::StencilFace& face = side == GL_BACK ? stencil->back : stencil->front;
    glStencilFuncSeparate(side, glCompareOf(face.test), stencil->reference, stencil->readMask);
    glStencilOpSeparate(side, glOf(kStencilOps, face.fail), glOf(kStencilOps, face.depthFail),
                        glOf(kStencilOps, face.pass));
  }
}

// Sets the fixed-function state whole before each pass, so that nothing leaks from one to the next.
void applyState(const PreparedPass& pass) {
  const graph::StateSpec& state = pass.context.spec->state;
  bool depthAttached = false, depthWritable = false, stencilWritable = false;
  const GLboolean colored = pass.writesColor ? GL_TRUE : GL_FALSE;
  glColorMask(colored, colored, colored, colored);
  for (const AttachmentBinding& attachment : pass.attachments) {
    const bool depth =
        attachment.point == GL_DEPTH_ATTACHMENT || attachment.point == GL_DEPTH_STENCIL_ATTACHMENT;
    depthAttached |= depth;
    depthWritable |= depth && attachment.use.access != graph::Access::read;
    const bool stencil =
        attachment.point != GL_DEPTH_ATTACHMENT && (depth || attachment.point == GL_STENCIL_ATTACHMENT);
    stencilWritable |= stencil && attachment.use.access != graph::Access::read;
    if (depth || stencil) continue;
    const GLuint index = attachment.point - GL_COLOR_ATTACHMENT0;
    const auto said = std::ranges::find(pass.colors, index, &PreparedPass::DrawBuffer::first);
    const graph::ColorState color = said == pass.colors.end() ? graph::ColorState{} : said->second;
    applyBlend(index, color.blend);
    if (const unsigned mask = color.mask; pass.writesColor && mask != 15)
      glColorMaski(index, mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
  }
  gl::enable(GL_FRAMEBUFFER_SRGB, pass.encodesSrgb);
  const std::array<std::int32_t, 4> whole{0, 0, static_cast<std::int32_t>(pass.width),
                                          static_cast<std::int32_t>(pass.height)};
  const auto& viewport = state.viewport ? *state.viewport : whole;
  glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
  const auto constant = [&](std::size_t i) { return static_cast<GLfloat>(state.blendColor[i]); };
  glBlendColor(constant(0), constant(1), constant(2), constant(3));
  applyStencil(state.stencil ? &*state.stencil : nullptr, stencilWritable);
  gl::enable(GL_DEPTH_CLAMP, state.depthClamp);
  gl::enable(GL_SAMPLE_ALPHA_TO_COVERAGE, state.alphaToCoverage);
  gl::enable(GL_SAMPLE_MASK, state.sampleMask.has_value());
  if (state.sampleMask) glSampleMaski(0, *state.sampleMask);
  gl::enable(GL_PROGRAM_POINT_SIZE, pass.sizesPoints);
  const bool depthTest = depthAttached && state.depthTest;
  gl::enable(GL_DEPTH_TEST, depthTest);
  if (depthTest) glDepthFunc(glCompareOf(state.depthCompare));
  glDepthMask(depthTest && depthWritable && state.depthWrite ? GL_TRUE : GL_FALSE);
  gl::enable(GL_CULL_FACE, state.cull != graph::Cull::none);
  if (state.cull != graph::Cull::none) glCullFace(state.cull == graph::Cull::back ? GL_BACK : GL_FRONT);
  glPolygonMode(GL_FRONT_AND_BACK, state.lines ? GL_LINE : GL_FILL);
  const bool offset = state.offsetFactor != 0 || state.offsetUnits != 0;
  gl::enable(GL_POLYGON_OFFSET_FILL, offset);
  if (offset)
    glPolygonOffset(static_cast<GLfloat>(state.offsetFactor), static_cast<GLfloat>(state.offsetUnits));
}

// Confines rendering to the rows of the pass's slices; off for a pass that runs whole.
void scissorTo(const PreparedPass& pass) {
  const passes::PassContext& c = pass.context;
  const bool confined = c.sliceCount != c.slices;
  gl::enable(GL_SCISSOR_TEST, confined);
  if (!confined) return;
  const auto at = [&](std::uint64_t slice) { return static_cast<GLint>(pass.height * slice / c.slices); };
  const GLint from = at(c.slice);
  glScissor(0, from, static_cast<GLsizei>(pass.width), at(c.slice + c.sliceCount) - from);
}

}  // namespace

void StepRunner::run(std::size_t step, PreparedPass& pass, bool clears, text::Diagnostics& diagnostics) {
  const gl::DebugGroup group(device_.context.debugLog(), pass.context.spec->name);
  device_.timers.begin(static_cast<std::uint32_t>(step));
  const bool draws = !pass.attachments.empty() || pass.context.spec->raster[0] > 0;
  const GLuint framebuffer = draws ? framebufferOf(pass, diagnostics) : 0;
  // Before clears, at which a driver looks at the textures of the program that is in use.
  const bool bound = bind(pass, diagnostics);
  if (clears && !pass.clears.empty()) clear(pass, framebuffer, diagnostics);
  if (const std::uint16_t after = plan_.steps[step].barriersAfterClears) glMemoryBarrier(glBarriersOf(after));
  if (framebuffer) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    applyState(pass);
    scissorTo(pass);
  } else {
    gl::openMasks();
  }
  if (pass.feedback) glTextureBarrier();
  if (bound) pass.type->execute(pass.context);
  device_.timers.end(static_cast<std::uint32_t>(step));
}

void StepRunner::clear(const PreparedPass& pass, GLuint framebuffer, text::Diagnostics& diagnostics) {
  gl::openMasks();
  for (const ClearCommand& clear : pass.clears) {
    const GpuResource& resource = pool_[clear.use.resource];
    const std::uint32_t copy = resource.copyOf(0, pass.group);
    if (!resource.texture) {
      clearBuffer(resource.buffers[copy], resource.offset, resource.bytes, clear.value);
    } else if (clear.attachment >= 0 && framebuffer) {
      clearAttachment(framebuffer, pass.attachments[static_cast<std::size_t>(clear.attachment)].point, clear);
    } else {
      const gl::TextureRef ref = pool_.whole(plan_, clear.use.resource, copy, diagnostics);
      for (std::uint32_t mip = clear.use.mip; mip < clear.use.mip + clear.use.mips; ++mip)
        clearTexture(ref, clear.format, mip, clear.use.layer, clear.use.layers, clear.value);
    }
  }
}

void StepRunner::clearAttachment(GLuint framebuffer, GLenum point, const ClearCommand& clear) {
  const ClearTexel texel = clearTexelOf(clear.format, clear.value);
  const auto index = static_cast<GLint>(point - GL_COLOR_ATTACHMENT0);
  const void* const bytes = texel.bytes.data();
  // depth-remembered-past-clears, gl/context/workarounds.md
  const bool depth = texel.format == GL_DEPTH_STENCIL || texel.format == GL_DEPTH_COMPONENT;
  const bool twice = depth && !device_.context.device().software && cleared_.insert(framebuffer).second;
  if (texel.format == GL_DEPTH_STENCIL) {
    GLfloat value = 0;
    GLint stencil = 0;
    std::memcpy(&value, texel.bytes.data(), 4);
    std::memcpy(&stencil, texel.bytes.data() + 4, 4);
    if (twice) glClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, 1 - value, stencil);
    glClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, value, stencil);
  } else if (texel.type == GL_UNSIGNED_INT) {
    glClearNamedFramebufferuiv(framebuffer, GL_COLOR, index, static_cast<const GLuint*>(bytes));
  } else if (texel.type == GL_INT) {
    glClearNamedFramebufferiv(framebuffer, GL_COLOR, index, static_cast<const GLint*>(bytes));
  } else {
    const auto* const value = static_cast<const GLfloat*>(bytes);
    const GLfloat other = 1 - *value;
    if (twice) glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &other);
    glClearNamedFramebufferfv(framebuffer, depth ? GL_DEPTH : GL_COLOR, depth ? 0 : index, value);
  }
}

GLuint StepRunner::framebufferOf(const PreparedPass& pass, text::Diagnostics& diagnostics) {
  scratch_.clear();
  for (const AttachmentBinding& attachment : pass.attachments) {
    const GpuResource& resource = pool_[attachment.resource];
    scratch_.push_back({.point = attachment.point,
                        .texture = attachment.textures[resource.copyOf(attachment.use.history, pass.group)],
                        .mip = attachment.mip,
                        .layer = attachment.layer});
  }
  const graph::PassSpec& spec = *pass.context.spec;
  return framebuffers_.get(scratch_, spec.name, diagnostics,
                           {spec.raster[0], spec.raster[1], spec.rasterSamples});
}

template <class Binding>
GLuint StepRunner::textureOf(const Binding& binding, const PreparedPass& pass,
                             text::Diagnostics& diagnostics) {
  const GpuResource& resource = pool_[binding.resource];
  if (!binding.views.empty()) return binding.views[resource.copyOf(binding.history, pass.group)];
  if (!binding.part) return resource.importedFor(pass.group).id;
  const graph::ImportSpec& import = plan_.graph->imports[plan_.graph->resources[binding.resource].import];
  return binding.part->viewOf(resource.importedFor(pass.group), device_.imports.generation(import),
                              diagnostics);
}

bool StepRunner::bind(PreparedPass& pass, text::Diagnostics& diagnostics) {
  if (pass.meshes) gatherMeshes(pass, diagnostics);
  if (pass.variant) glUseProgram(pass.variant->program.id());
  if (const GLuint vertices = pass.context.geometry.vertexArray) glBindVertexArray(vertices);
  const auto holds = [&](const FirstOf& first) {
    return first.resource == kNone || !pool_[first.resource].hasPublication(first.history, pass.group);
  };
  for (const TextureBinding& binding : pass.textures) {
    if (!holds(binding.firstOf)) continue;
    const GLuint texture = textureOf(binding, pass, diagnostics);
    if (binding.access) {
      glBindImageTexture(binding.unit, texture, 0, binding.layered, 0, binding.access, binding.format);
    } else {
      glBindTextureUnit(binding.unit, texture);
      glBindSampler(binding.unit, binding.sampler);
    }
  }
  for (const BufferBinding& binding : pass.buffers)
    if (holds(binding.firstOf)) bindBuffer(binding, pass, diagnostics);
  for (const auto& [block, offset] : {std::pair(pass.parametersBlock, pass.parametersOffset),
                                      {pass.viewBlock, pass.viewOffset},
                                      {pass.sliceBlock, pass.sliceOffset}})
    if (block) gl::bindBuffer(GL_UNIFORM_BUFFER, block->binding, uniforms_.buffer(), offset, block->bytes);
  bool bound = true;
  for (const FixedBinding& binding : pass.fixed)
    if (holds(binding.firstOf)) bound = bindFixed(binding, pass, diagnostics) && bound;
  if (pass.list >= 0 && !pass.meshes)
    pass.context.instances = device_.imports.tables().countOf(static_cast<scene::DrawList>(pass.list));
  return bound;
}

// Takes the draw commands of what the pass's view sees of the meshes in its list.
void StepRunner::gatherMeshes(PreparedPass& pass, text::Diagnostics& diagnostics) {
  const imports::MeshDraw draw = device_.imports.tables().draw(*pass.meshes, diagnostics);
  pass.context.geometry = {.vertexArray = draw.vertexArray,
                           .mode = GL_TRIANGLES,
                           .count = draw.count,
                           .indexType = GL_UNSIGNED_INT,
                           .commands = draw.commands};
}

void StepRunner::bindBuffer(const BufferBinding& binding, PreparedPass& pass,
                            text::Diagnostics& diagnostics) {
  if (binding.drawn) {
    const auto list = static_cast<scene::DrawList>(pass.list);
    imports::SceneTables& tables = device_.imports.tables();
    const BufferRef table = pass.meshes ? tables.meshes(list, binding.layout, diagnostics)
                                        : tables.spheres(list, binding.layout, diagnostics);
    gl::bindBuffer(binding.target, binding.index, table.id, 0, 0);
  } else if (binding.import != kNone) {
    const graph::ImportSpec& import = plan_.graph->imports[binding.import];
    const BufferRef table =
        device_.imports.of(import).buffer(device_.imports.frame(), binding.layout, diagnostics);
    gl::bindBuffer(binding.target, binding.index, table.id, 0, 0);
  } else {
    const GpuResource& resource = pool_[binding.resource];
    const GLuint buffer = resource.buffers[resource.copyOf(binding.history, pass.group)];
    const auto offset = static_cast<GLintptr>(resource.offset),
               bytes = static_cast<GLsizeiptr>(resource.bytes);
    if (binding.target == GL_DRAW_INDIRECT_BUFFER)
      pass.context.commands = {.name = buffer, .offset = offset, .bytes = bytes};
    else
      gl::bindBuffer(binding.target, binding.index, buffer, offset, bytes);
  }
}

// Binds what a pass type without a shader works on: GL names of textures, and framebuffers around them if it wants some.
bool StepRunner::bindFixed(const FixedBinding& binding, PreparedPass& pass, text::Diagnostics& diagnostics) {
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
  const graph::FlatResource& shape = plan_.graph->resources[binding.resource];
  const gl::Attachment attachment{.point = gl::attachmentPointOf(glFormatOf(shape.format)),
                                  .texture = bound.name,
                                  .mip = binding.mip,
                                  .layer = binding.layer};
  bound.framebuffer = framebuffers_.get({&attachment, 1}, pass.context.spec->name, diagnostics);
  return true;
}

}  // namespace weft::runtime
