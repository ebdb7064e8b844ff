// A horizontal plane that things stand on. It takes their shadows; what it shows beside them is the environment, or a
// surface of its own that ends in the environment. Does not: stop light, or anything that moves.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace weft::scene {

struct Ground {
  float height = 0;                 // world Y
  std::optional<glm::vec3> albedo;  // linear, of a diffuse surface; empty: it shows the environment
  float radius = 100;               // of that surface, about the world's Y axis; it fades in the outer half
};

}  // namespace weft::scene
