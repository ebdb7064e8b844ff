// Metals of several colors and roughnesses that touch or nearly do, on a ground or not, or among other spheres in the
// light of a low sun, and the radiance of their pixels by paths.
#pragma once

#include "tests/theory/neighbors/tracer.h"

namespace weft::theory {

// `inTheAir` and `onGround`: under the bundled environment without its sun, dimmed where it is brighter than kBrightest.
// `amongLit`: two rough metals, the first kRough balls, before which stand metal and diffuse ones, half of each in the
// light of a low sun, under a plain sky; in the reflections of the two they overlap.
struct MetalScene {
  static constexpr float kBrightest = 6;
  static constexpr std::uint32_t kWidth = 288, kHeight = 128;
  static constexpr int kRough = 2;
  enum class Stand { inTheAir, onGround, amongLit };
  explicit MetalScene(Stand stand);

  // The sphere that covers the whole pixel, -1: none. Counted from the lower left corner.
  int sphereOf(const MetalTracer& tracer, std::uint32_t x, std::uint32_t y) const;
  // The mean of a pixel by side x side paths.
  glm::dvec3 truth(const MetalTracer& tracer, std::uint32_t x, std::uint32_t y, int side,
                   std::mt19937& random) const;

  Setup setup;

 private:
  glm::dvec3 rayOf(double x, double y) const;
};

}  // namespace weft::theory
