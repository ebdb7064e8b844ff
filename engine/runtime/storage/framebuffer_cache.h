// Framebuffers, found by their attachments. They are derived from slots; no author names them. Does not: notice that an
// attached texture is deleted (takeOver() is told).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/objects/objects.h"

namespace weft::runtime {

class FramebufferCache {
 public:
  // The GL name; 0 after an error. Without attachments, width and height give the area that is rasterised.
  GLuint get(std::span<const gl::Attachment> attachments, const std::string& label,
             base::Diagnostics& diagnostics, std::uint32_t width = 0, std::uint32_t height = 0);
  // Takes the framebuffers of `other` whose attachments all still exist; `alive` has the names of textures and views that do.
  void takeOver(FramebufferCache& other, const std::unordered_set<GLuint>& alive);
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
