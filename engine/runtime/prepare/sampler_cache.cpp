#include "engine/runtime/prepare/sampler_cache.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

void SamplerCache::setBorder(GLuint sampler, const Border& border) {
  if (border.texels != graph::TexelKind::signed_integer &&
      border.texels != graph::TexelKind::unsigned_integer)
    return glSamplerParameterfv(sampler, GL_TEXTURE_BORDER_COLOR, border.color.data());
  std::array<GLint, 4> wholes{};
  std::array<GLuint, 4> naturals{};
  for (std::size_t i = 0; i < 4; ++i) {
    wholes[i] = static_cast<GLint>(std::clamp<double>(border.color[i], INT32_MIN, INT32_MAX));
    naturals[i] = static_cast<GLuint>(std::clamp<double>(border.color[i], 0, UINT32_MAX));
  }
  if (border.texels == graph::TexelKind::signed_integer)
    glSamplerParameterIiv(sampler, GL_TEXTURE_BORDER_COLOR, wholes.data());
  else
    glSamplerParameterIuiv(sampler, GL_TEXTURE_BORDER_COLOR, naturals.data());
}

GLuint SamplerCache::get(const graph::Sampler& sampler, const graph::BorderColor& color, bool mipmapped,
                         graph::TexelKind texels) {
  gl::SamplerDesc desc;
  const bool linear = sampler.linear || sampler.compare;
  desc.magFilter = linear ? GL_LINEAR : GL_NEAREST;
  desc.minFilter = !mipmapped ? desc.magFilter : linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST;
  constexpr GLenum kWraps[] = {GL_CLAMP_TO_EDGE, GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_BORDER};
  desc.wrap = kWraps[static_cast<std::size_t>(sampler.wrap)];
  if (sampler.compare) desc.compare = glCompareOf(sampler.function.value_or(graph::Compare::greater));
  Border border;
  if (sampler.wrap == graph::Wrap::border) border = {color, texels};
  for (const Entry& each : entries_)
    if (each.desc == desc && each.border == border) return each.object.id();
  entries_.push_back({desc, border, gl::SamplerObject::create(desc, linear ? "linear" : "nearest")});
  const GLuint id = entries_.back().object.id();
  if (sampler.wrap == graph::Wrap::border) setBorder(id, border);
  return id;
}

}  // namespace weft::runtime
