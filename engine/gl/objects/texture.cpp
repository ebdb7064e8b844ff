// Textures, views of them and framebuffers.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include "engine/gl/context/debug.h"
#include "engine/gl/objects/objects.h"

namespace weft::gl {

namespace {

bool isMultisample(GLenum target) {
  return target == GL_TEXTURE_2D_MULTISAMPLE;
}

GLint limitOf(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

std::string sizeText(const TextureDesc& d) {
  std::string text = fmt::format("{}x{}", d.width, d.height);
  if (d.target == GL_TEXTURE_3D) text += fmt::format("x{}", d.depth);
  if (d.layers > 1) text += fmt::format(", {} layers", d.layers);
  if (d.mips > 1) text += fmt::format(", {} mips", d.mips);
  if (d.samples > 1) text += fmt::format(", {} samples", d.samples);
  return text + " " + enumName(d.format);
}

// Which number the driver would refuse, or "": it says no more than that it does.
std::string refusal(const TextureDesc& d) {
  const bool cube = d.target == GL_TEXTURE_CUBE_MAP || d.target == GL_TEXTURE_CUBE_MAP_ARRAY;
  const GLint largest = limitOf(d.target == GL_TEXTURE_3D ? GL_MAX_3D_TEXTURE_SIZE
                                : cube                    ? GL_MAX_CUBE_MAP_TEXTURE_SIZE
                                                          : GL_MAX_TEXTURE_SIZE);
  const GLint layers = limitOf(GL_MAX_ARRAY_TEXTURE_LAYERS), samples = limitOf(GL_MAX_SAMPLES);
  const std::uint32_t side = std::max({d.width, d.height, d.target == GL_TEXTURE_3D ? d.depth : 1});
  if (side > static_cast<std::uint32_t>(largest))
    return fmt::format("the largest side is {} texels here", largest);
  if (d.mips > static_cast<std::uint32_t>(std::bit_width(side)))
    return fmt::format("this size has at most {} mips", std::bit_width(side));
  if (d.layers > static_cast<std::uint32_t>(layers))
    return fmt::format("at most {} layers are allowed here", layers);
  if (d.samples > static_cast<std::uint32_t>(samples))
    return fmt::format("at most {} samples are allowed here", samples);
  return "";
}

std::string statusReason(GLenum status) {
  switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
      return "an attachment has no such mip or layer, or a format that cannot be rendered to at that point";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
      return "it has no attachment and no size of its own";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
      return "its attachments differ in sample count";
    case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
      return "some attachments are layered and some are not, or they differ in target";
    default:
      return "this driver does not render to this combination of formats";
  }
}

// Filters and wrapping of a texture or view that is read without a sampler object.
void setDefaults(GLuint id, GLenum target, std::uint32_t mips) {
  if (isMultisample(target)) return;
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, mips > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(id, axis, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(mips) - 1);
}

}  // namespace

std::optional<Texture> Texture::create(const TextureDesc& desc, std::string_view label,
                                       base::Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& reason) {
    diagnostics
        .error(base::Code::textureNotCreated, {},
               fmt::format("texture '{}' ({}) cannot be created: {}", label, sizeText(desc), reason))
        .resource = label;
    return std::nullopt;
  };
  if (const std::string reason = refusal(desc); !reason.empty()) return fail(reason);
  GLuint id = 0;
  glCreateTextures(desc.target, 1, &id);
  Texture texture(id);
  texture.desc_ = desc;
  const auto [mips, width, height, depth, layers, samples] =
      std::array{static_cast<GLsizei>(desc.mips),   static_cast<GLsizei>(desc.width),
                 static_cast<GLsizei>(desc.height), static_cast<GLsizei>(desc.depth),
                 static_cast<GLsizei>(desc.layers), static_cast<GLsizei>(desc.samples)};
  switch (desc.target) {
    case GL_TEXTURE_2D:
    case GL_TEXTURE_CUBE_MAP:
      glTextureStorage2D(id, mips, desc.format, width, height);
      break;
    case GL_TEXTURE_2D_ARRAY:
    case GL_TEXTURE_CUBE_MAP_ARRAY:
      glTextureStorage3D(id, mips, desc.format, width, height, layers);
      break;
    case GL_TEXTURE_3D:
      glTextureStorage3D(id, mips, desc.format, width, height, depth);
      break;
    case GL_TEXTURE_2D_MULTISAMPLE:
      glTextureStorage2DMultisample(id, samples, desc.format, width, height, GL_TRUE);
      break;
    default:
      return fail(fmt::format("{} is no target of this engine", enumName(desc.target)));
  }
  GLint stored = 0;
  glGetTextureParameteriv(id, GL_TEXTURE_IMMUTABLE_FORMAT, &stored);
  if (!stored) return fail(takeErrors());
  setDefaults(id, desc.target, desc.mips);
  labelObject(GL_TEXTURE, id, label);
  return texture;
}

std::optional<TextureView> TextureView::create(const TextureRef& of, const ViewDesc& view,
                                               std::string_view label, base::Diagnostics& diagnostics) {
  GLuint id = 0;
  glGenTextures(1, &id);  // workarounds.h: view-names-from-gen
  TextureView texture(id);
  const GLenum format = view.format == 0 ? of.desc.format : view.format;
  glTextureView(id, view.target, of.id, format, view.mip, view.mips, view.layer, view.layers);
  if (!glIsTexture(id)) {
    diagnostics
        .error(base::Code::viewNotCreated, {},
               fmt::format("view '{}' of a texture ({}) cannot be created: {}", label, sizeText(of.desc),
                           takeErrors()))
        .found =
        fmt::format("{} as {}, mips {} to {}, layers {} to {}", enumName(view.target), enumName(format),
                    view.mip, view.mip + view.mips - 1, view.layer, view.layer + view.layers - 1);
    return std::nullopt;
  }
  texture.desc_ = of.desc;
  texture.desc_.target = view.target;
  texture.desc_.format = format;
  texture.desc_.width = std::max(1u, of.desc.width >> view.mip);
  texture.desc_.height = std::max(1u, of.desc.height >> view.mip);
  texture.desc_.depth = std::max(1u, of.desc.depth >> view.mip);
  texture.desc_.layers = view.layers;
  texture.desc_.mips = view.mips;
  setDefaults(id, view.target, view.mips);
  if (view.stencil)
    glTextureParameteri(id, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);  // workarounds.h: stencil-view
  labelObject(GL_TEXTURE, id, label);
  return texture;
}

std::optional<Framebuffer> Framebuffer::create(std::span<const Attachment> attachments,
                                               std::string_view label, base::Diagnostics& diagnostics,
                                               std::uint32_t width, std::uint32_t height) {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  Framebuffer framebuffer(id);
  std::array<GLenum, 32> draws{};
  GLsizei drawCount = 0;
  for (const Attachment& a : attachments) {
    if (a.layer < 0)
      glNamedFramebufferTexture(id, a.point, a.texture, static_cast<GLint>(a.mip));
    else
      glNamedFramebufferTextureLayer(id, a.point, a.texture, static_cast<GLint>(a.mip), a.layer);
    if (a.point >= GL_COLOR_ATTACHMENT0 && a.point < GL_COLOR_ATTACHMENT0 + draws.size()) {
      const auto index = static_cast<GLsizei>(a.point - GL_COLOR_ATTACHMENT0);
      draws[static_cast<std::size_t>(index)] = a.point;
      drawCount = std::max(drawCount, index + 1);
    }
  }
  glNamedFramebufferDrawBuffers(id, drawCount, draws.data());  // absent ones are GL_NONE, which is 0
  glNamedFramebufferReadBuffer(id, drawCount > 0 && draws[0] != GL_NONE ? draws[0] : GL_NONE);
  if (width > 0) glNamedFramebufferParameteri(id, GL_FRAMEBUFFER_DEFAULT_WIDTH, static_cast<GLint>(width));
  if (height > 0) glNamedFramebufferParameteri(id, GL_FRAMEBUFFER_DEFAULT_HEIGHT, static_cast<GLint>(height));
  labelObject(GL_FRAMEBUFFER, id, label);
  const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return framebuffer;

  std::string parts;
  for (const Attachment& a : attachments) {
    GLint format = 0, samples = 0;
    if (glIsTexture(a.texture)) {
      glGetTextureLevelParameteriv(a.texture, static_cast<GLint>(a.mip), GL_TEXTURE_INTERNAL_FORMAT, &format);
      glGetTextureLevelParameteriv(a.texture, static_cast<GLint>(a.mip), GL_TEXTURE_SAMPLES, &samples);
    }
    parts += fmt::format("{}{} mip {} layer {} samples {}", parts.empty() ? "" : "; ",
                         enumName(static_cast<GLenum>(format)), a.mip, a.layer, samples);
  }
  const std::string errors = takeErrors();
  diagnostics
      .error(base::Code::incompleteFramebuffer, {},
             fmt::format("framebuffer '{}' is incomplete: {} ({}{}{})", label, statusReason(status),
                         enumName(status), errors.empty() ? "" : ", ", errors))
      .found = parts.empty() ? "no attachments" : parts;
  return std::nullopt;
}

}  // namespace weft::gl
