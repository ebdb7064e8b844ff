// Metals of several colours and roughnesses that touch or nearly do, on a ground, and the radiance of their pixels by paths.
#pragma once

#include "tests/theory/neighbours/tracer.h"

namespace weft::theory {

// Under the bundled environment without its sun: dimmed where it is brighter than kBrightest.
struct MetalScene {
  static constexpr float kBrightest = 6;
  static constexpr std::uint32_t kWidth = 288, kHeight = 128;
  enum class Stand { inTheAir, onGround };
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
