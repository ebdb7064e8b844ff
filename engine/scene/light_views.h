// What lights look from: the orthographic view of the sun, and the six views of a cube map. Reversed-Z as all
// views: nearest is 1. Pure functions.
#pragma once

#include <cstdint>

#include "engine/scene/camera.h"
#include "engine/scene/scene.h"

namespace weft::scene {

struct SunView {
  ViewData view;
  glm::mat4 shadowMatrix{1};  // world to (u, v, depth) of a picture of the view, each 0..1 inside
  float texel = 1;            // world units across a texel of that picture
};
// Fits `bounds` (a unit cube when it is empty) in a square picture of `texels` a side. What moves inside the bounds does not
// move texels over the scene: the extent grows in steps and the center in whole texels.
SunView sunView(const Sun& sun, const Box& bounds, std::uint32_t texels);

// The nearest thing that casts a shadow of a lamp: a thousandth of its range.
float nearPlaneOf(const Lamp& lamp);
// Face 0..5: +X −X +Y −Y +Z −Z, turned as OpenGL's cube maps have them, 90° each.
ViewData cubeView(glm::vec3 from, float nearPlane, std::uint32_t face, std::uint32_t texels);

}  // namespace weft::scene
