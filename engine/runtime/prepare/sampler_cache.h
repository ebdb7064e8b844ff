// Sampler objects by what a slot asks for. They live across plans; equal wishes share one object.
#pragma once

#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/graph/flat_graph.h"

namespace weft::runtime {

class SamplerCache {
 public:
  // The sampler's name. `mipmapped`: the view has more than one level. `compare`: of a shadow sampler;
  // `always` means "less or equal".
  GLuint get(const graph::Sampler& sampler, bool mipmapped, graph::Compare compare);

 private:
  struct Entry {
    gl::SamplerDesc desc;
    gl::SamplerObject object;
  };
  std::vector<Entry> entries_;
};

}  // namespace weft::runtime
