// Sampler objects by what a slot asks for. They live across plans; equal wishes share one object.
#pragma once

#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/graph/flat_graph.h"

namespace weft::runtime {

class SamplerCache {
 public:
  // The sampler's name. `mipmapped`: the view has more than one level. `compare`: of a shadow sampler that names none;
  // `always` means "less or equal". `texels`: of the texture; the colour of a border is of the same kind.
  GLuint get(const graph::Sampler& sampler, const graph::BorderColor& color, bool mipmapped,
             graph::Compare compare, graph::TexelKind texels);

 private:
  // What lies outside 0..1, in numbers of the texture's kind.
  struct Border {
    graph::BorderColor color{};
    graph::TexelKind texels = graph::TexelKind::none;
    friend bool operator==(const Border&, const Border&) = default;
  };
  struct Entry {
    gl::SamplerDesc desc;
    Border border;
    gl::SamplerObject object;
  };
  static void setBorder(GLuint sampler, const Border& border);

  std::vector<Entry> entries_;
};

}  // namespace weft::runtime
