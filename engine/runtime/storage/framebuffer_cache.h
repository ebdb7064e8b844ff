// Framebuffers, found by their attachments. They are derived from slots; no author names them. Lives no longer than the
// textures that are attached.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/objects/objects.h"

namespace weft::runtime {

class FramebufferCache {
 public:
  // The GL name; 0 after an error. Without attachments, width and height give the area that is rasterised.
  GLuint get(std::span<const gl::Attachment> attachments, const std::string& label,
             base::Diagnostics& diagnostics, std::uint32_t width = 0, std::uint32_t height = 0);
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::vector<gl::Attachment> attachments;
    std::uint32_t width = 0, height = 0;
    gl::Framebuffer framebuffer;
  };
  std::vector<Entry> entries_;
};

}  // namespace weft::runtime
