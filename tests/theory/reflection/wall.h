// White metals of every roughness under the bundled environment, and the brute-force radiance of their pixels.
#pragma once

#include <array>
#include <cstdint>

#include "tests/theory/lab.h"
#include "tests/theory/reflection/oracle.h"

namespace weft::theory {

// A ball per roughness, 61 pixels in radius, seen from far away; `azimuth` turns the camera about the balls, in degrees.
struct ReflectionWall {
  static constexpr std::uint32_t kSide = 128, kColumns = 6, kRows = 2;  // pixels of a ball's square
  static constexpr std::array<double, 12> kRoughness = {0,   0.05, 0.1, 0.2, 0.3, 0.4,
                                                        0.5, 0.6,  0.7, 0.8, 0.9, 1};
  explicit ReflectionWall(double azimuth);
  // What a ray through the picture, in pixels from its lower left corner, meets of ball `i`.
  bool hit(std::size_t i, double x, double y, Vec3& normal, Vec3& view) const;
  // The mean over the area of a pixel; false where the ball does not cover it. `fewer`: by what to divide the samples.
  bool truth(const ReflectionOracle& oracle, const ReflectionOracle::Metal& metal, std::size_t ball,
             std::uint32_t x, std::uint32_t y, unsigned set, Vec3& out, int fewer = 1) const;

  Setup setup;

 private:
  glm::dvec3 center(std::size_t i) const;
  glm::dvec3 back_, right_;
};

// Of the map as the file has it.
ReflectionOracle bundledOracle();

}  // namespace weft::theory
