// Framebuffers and samplers, found by what is asked for: no author names them.
#pragma once

#include <algorithm>
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
    gl::SamplerDesc desc;
    const bool linear = sampler.linear || sampler.compare;
    desc.magFilter = linear ? GL_LINEAR : GL_NEAREST;
    desc.minFilter = !mipmapped ? desc.magFilter
                     : linear   ? GL_LINEAR_MIPMAP_LINEAR
                                : GL_NEAREST_MIPMAP_NEAREST;
    constexpr GLenum kWraps[] = {GL_CLAMP_TO_EDGE, GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_BORDER};
    desc.wrap = kWraps[static_cast<std::size_t>(sampler.wrap)];
    if (sampler.compare) desc.compare = glCompareOf(sampler.function.value_or(graph::Compare::greater));
    if (sampler.wrap == graph::Wrap::border) {
      desc.border = color;
      desc.borderBase = texels == graph::TexelKind::signed_integer     ? GL_INT
                        : texels == graph::TexelKind::unsigned_integer ? GL_UNSIGNED_INT
                                                                       : GL_FLOAT;
    }
    for (const auto& [known, object] : entries_)
      if (known == desc) return object.id();
    entries_.emplace_back(desc, gl::SamplerObject::create(desc, linear ? "linear" : "nearest"));
    return entries_.back().second.id();
  }

 private:
  std::vector<std::pair<gl::SamplerDesc, gl::SamplerObject>> entries_;
};

}  // namespace weft::runtime
