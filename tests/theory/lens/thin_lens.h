// A thin lens before the picture of a lab's camera, by its definition: which lens has which discs, its outline, and what a light out of focus is
// then, where things hide it from parts of the lens. Nothing here is taken from a shader.
#pragma once

#include <utility>
#include <vector>

#include "tests/theory/lab.h"

namespace weft::theory {

// How far out the outline of an aperture is in a direction, of the radius of its corners; the first corner lies along x. Below 3 blades it is round.
double outlineOf(int blades, double angle);

struct ThinLens {
  double focus = 20;     // world units
  double distance = 60;  // of the light
  double diameter = 20;  // of the light's disc, in pixels, of the outline's corners
  std::uint32_t height = 120;
  int blades = 0;
  // World units along a pixel at a distance, for a camera with a field of view of 60 degrees.
  double unitsPerPixel(double at) const;
  // What depth of field is told for it.
  std::vector<weft::graph::Setting> sets() const;
};

// A black ball that may hide light, in camera space: x to the right, y up, z the distance.
struct Blocker {
  glm::dvec3 center{0};
  double radius = 0;
};

// How much of its light a point at `light` (pixels) sends to a point at `pixel`: 1 or 0.
double arrives(const ThinLens& lens, glm::dvec2 light, glm::dvec2 pixel,
               const std::vector<Blocker>& blockers);

}  // namespace weft::theory
