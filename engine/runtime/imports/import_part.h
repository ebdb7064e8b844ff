// Some levels or layers of an imported texture, as one binding sees them. The texture may be another one in any frame, so the
// view of it is made when it is bound, and kept until the import changes.
#pragma once

#include <glad/gl.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "engine/gl/objects/objects.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

class ImportPart {
 public:
  // `import`: its name, for messages. The format of `part` is 0: that of the texture.
  ImportPart(const gl::ViewDesc& part, std::string import) : part_(part), import_(std::move(import)) {}

  // `generation` is another number when `texture` is another one under the name of one that was destroyed. Levels and layers
  // that it lacks are its last ones: what stands in while an import is loaded may be one texel. 0: there is none, or W118 was
  // reported.
  GLuint viewOf(const gl::TextureRef& texture, std::uint64_t generation, text::Diagnostics& diagnostics) {
    if (texture.id == texture_ && generation == generation_) return view_.id();
    texture_ = texture.id;
    generation_ = generation;
    view_.reset();
    if (texture.id == 0) return 0;
    gl::ViewDesc part = part_;
    part.mips = std::min(part.mips, texture.desc.mips);
    part.mip = std::min(part.mip, texture.desc.mips - part.mips);
    part.layers = std::min(part.layers, texture.desc.layers);
    part.layer = std::min(part.layer, texture.desc.layers - part.layers);
    if (auto made = gl::TextureView::create(texture, part, import_, diagnostics)) view_ = std::move(*made);
    return view_.id();
  }

 private:
  gl::ViewDesc part_;
  std::string import_;
  GLuint texture_ = 0;  // of which view_ is
  std::uint64_t generation_ = 0;
  gl::TextureView view_;
};

}  // namespace weft::runtime
