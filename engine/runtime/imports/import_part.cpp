#include "engine/runtime/imports/import_part.h"

#include <algorithm>
#include <optional>

namespace weft::runtime {

GLuint ImportPart::viewOf(const gl::TextureRef& texture, std::uint64_t generation,
                          base::Diagnostics& diagnostics) {
  if (texture.id == texture_ && generation == generation_) return view_.id();
  texture_ = texture.id;
  generation_ = generation;
  std::optional<gl::TextureView> made;
  if (texture.id) {
    gl::ViewDesc part = part_;
    part.mips = std::min(part.mips, texture.desc.mips);
    part.mip = std::min(part.mip, texture.desc.mips - part.mips);
    part.layers = std::min(part.layers, texture.desc.layers);
    part.layer = std::min(part.layer, texture.desc.layers - part.layers);
    made = gl::TextureView::create(texture, part, import_, diagnostics);
  }
  view_ = made ? std::move(*made) : gl::TextureView{};
  return view_.id();
}

}  // namespace weft::runtime
