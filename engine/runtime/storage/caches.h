// Framebuffers and samplers, found by what is asked for: no author names them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/runtime/storage/formats.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

// By their attachments, which are derived from slots. Lives no longer than the textures that are attached.
class FramebufferCache {
 public:
  // The GL name; 0 after an error. `raster`: of one without attachments.
  GLuint get(std::span<const gl::Attachment> attachments, const std::string& label,
             text::Diagnostics& diagnostics, const gl::Raster& raster = {}) {
    for (const Entry& entry : entries_)
      if (std::ranges::equal(entry.attachments, attachments) && entry.raster == raster)
        return entry.framebuffer.id();
    auto made = gl::Framebuffer::create(attachments, label, diagnostics, raster);
    if (!made) return 0;
    entries_.push_back({{attachments.begin(), attachments.end()}, raster, std::move(*made)});
    return entries_.back().framebuffer.id();
  }

 private:
  struct Entry {
    std::vector<gl::Attachment> attachments;
    gl::Raster raster;
    gl::Framebuffer framebuffer;
  };
  std::vector<Entry> entries_;
};

// Equal requests share one object, which outlives the plan.
class SamplerCache {
 public:
  // The GL name of the sampler. `mipmapped`: the view has more than one level. `texels` is the kind of the texture's texels,
  // and of `color`. One that compares says how: expansion has settled it.
  GLuint get(const graph::Sampler& sampler, const graph::BorderColor& color, bool mipmapped,
             graph::TexelKind texels) {
    const bool border = sampler.wrap == graph::Wrap::border;
    const Wish wish{sampler, mipmapped, border ? color : graph::BorderColor{},
                    border ? texels : graph::TexelKind::floating};
    for (const auto& [known, object] : entries_)
      if (known == wish) return object.id();
    const bool linear = sampler.linear || sampler.compare;
    const GLenum level = linear ? GL_LINEAR : GL_NEAREST,
                 levels = linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST;
    entries_.emplace_back(wish, gl::SamplerObject::create(linear ? "linear" : "nearest"));
    const GLuint id = entries_.back().second.id();
    const auto set = [id](GLenum what, GLenum value) {
      glSamplerParameteri(id, what, static_cast<GLint>(value));
    };
    set(GL_TEXTURE_MAG_FILTER, level);
    set(GL_TEXTURE_MIN_FILTER, mipmapped ? levels : level);
    constexpr GLenum kWraps[] = {GL_CLAMP_TO_EDGE, GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_BORDER};
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
      set(axis, kWraps[static_cast<std::size_t>(sampler.wrap)]);
    if (sampler.compare) {
      set(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
      set(GL_TEXTURE_COMPARE_FUNC, glCompareOf(sampler.function.value_or(graph::Compare::greater)));
    }
    if (border) setBorder(id, color, texels);
    return id;
  }

 private:
  struct Wish {
    graph::Sampler sampler;
    bool mipmapped = false;
    graph::BorderColor color;  // of one with a border, as is `texels`
    graph::TexelKind texels;
    friend bool operator==(const Wish&, const Wish&) = default;
  };
  static void setBorder(GLuint id, const graph::BorderColor& color, graph::TexelKind texels) {
    std::array<GLint, 4> wholes{};
    std::array<GLuint, 4> naturals{};
    for (std::size_t i = 0; i < 4; ++i) {
      wholes[i] = static_cast<GLint>(std::clamp<double>(color[i], INT32_MIN, INT32_MAX));
      naturals[i] = static_cast<GLuint>(std::clamp<double>(color[i], 0, UINT32_MAX));
    }
    if (texels == graph::TexelKind::signed_integer)
      glSamplerParameterIiv(id, GL_TEXTURE_BORDER_COLOR, wholes.data());
    else if (texels == graph::TexelKind::unsigned_integer)
      glSamplerParameterIuiv(id, GL_TEXTURE_BORDER_COLOR, naturals.data());
    else
      glSamplerParameterfv(id, GL_TEXTURE_BORDER_COLOR, color.data());
  }

  std::vector<std::pair<Wish, gl::SamplerObject>> entries_;
};

}  // namespace weft::runtime
