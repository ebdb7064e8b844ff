#include "engine/runtime/storage/framebuffer_cache.h"

#include <algorithm>

namespace weft::runtime {

GLuint FramebufferCache::get(std::span<const gl::Attachment> attachments, const std::string& label,
                             base::Diagnostics& diagnostics, std::uint32_t width, std::uint32_t height) {
  const bool sized = attachments.empty();
  for (const Entry& entry : entries_)
    if (std::ranges::equal(entry.attachments, attachments) &&
        (!sized || (entry.width == width && entry.height == height)))
      return entry.framebuffer.id();
  auto made = gl::Framebuffer::create(attachments, label, diagnostics, sized ? width : 0, sized ? height : 0);
  if (!made) return 0;
  entries_.push_back({{attachments.begin(), attachments.end()}, width, height, std::move(*made)});
  return entries_.back().framebuffer.id();
}

}  // namespace weft::runtime
