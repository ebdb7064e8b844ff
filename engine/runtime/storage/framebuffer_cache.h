// Framebuffers, found by their attachments. They are derived from slots; no author names them. Lives no longer than the
// textures that are attached.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

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

}  // namespace weft::runtime
