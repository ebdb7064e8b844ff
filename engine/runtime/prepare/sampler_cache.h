// Sampler objects, found by what a slot asks for. Equal requests share one object, which outlives the plan.
#pragma once

#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/graph/flat_graph.h"

namespace weft::runtime {

class SamplerCache {
 public:
  // The GL name of the sampler. `mipmapped`: the view has more than one level. `texels` is the kind of the texture's texels,
  // and of `color`. One that compares says how: expansion has settled it.
  GLuint get(const graph::Sampler& sampler, const graph::BorderColor& color, bool mipmapped,
             graph::TexelKind texels);

 private:
  // The border's colour, as numbers of the texture's kind.
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
