// The triangles of a scene's meshes, as they stand in the world, and what a ray meets of them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace weft::theory {

struct Hit {
  double distance = 1e30;
  glm::dvec3 normal{0};
};

class Triangles {
 public:
  explicit Triangles(const scene::Scene& scene);
  Hit meet(glm::dvec3 from, glm::dvec3 way) const;  // the nearest; `way` is a unit vector
  bool meetsAny(glm::dvec3 from, glm::dvec3 way) const;

 private:
  struct Triangle {
    glm::dvec3 a, one, two;  // a corner, and the edges from it
  };
  struct Mesh {
    glm::dvec3 low, high;  // around it
    std::size_t first = 0, end = 0;
  };
  template <typename Visit>
  void forMet(glm::dvec3 from, glm::dvec3 way, const Visit& visit) const;

  std::vector<Triangle> triangles_;
  std::vector<Mesh> meshes_;
};

}  // namespace weft::theory
