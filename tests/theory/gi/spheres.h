#pragma once
// What the tests of light probes share: an integral over directions, spheres, and probes computed of them.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "tests/theory/gi/probe_reference.h"

namespace weft::theory {

using namespace weft::scene;

inline constexpr double kPiD = 3.14159265358979323846;

// The integral of f over the directions within `cosine` of `axis` (-1: all of them), three Gauss points
// in each step of the cosine.
template <class F>
auto integrate(glm::dvec3 axis, double cosine, int steps, const F& f) {
  const glm::dvec3 side =
      glm::normalize(std::abs(axis.x) < 0.7 ? glm::cross(axis, {1, 0, 0}) : glm::cross(axis, {0, 1, 0}));
  const glm::dvec3 up = glm::cross(axis, side);
  decltype(f(axis)) sum{};
  for (int i = 0; i < steps; ++i)
    for (int gauss = -1; gauss <= 1; ++gauss)
      for (int j = 0; j < 2 * steps; ++j) {
        const double c = cosine + (1 - cosine) * (i + 0.5 + gauss * std::sqrt(0.15)) / steps;
        const double s = std::sqrt(1 - c * c), phi = kPiD * (j + 0.5) / steps;
        sum += f(axis * c + side * (s * std::cos(phi)) + up * (s * std::sin(phi))) *
               (gauss == 0 ? 8.0 / 18 : 5.0 / 18);
      }
  return sum * ((1 - cosine) * kPiD / (double(steps) * steps));
}

inline std::vector<glm::dvec3> directions(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> all;
  for (int i = 0; i < count; ++i)
    all.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  return all;
}

inline const ProbeRules kBare{.near = 1.05f, .far = 1e5f};  // no window where anybody looks

inline bool meets(glm::dvec3 from, glm::dvec3 direction, glm::dvec3 center, double radius) {
  const double along = glm::dot(center - from, direction);
  return along > 0 && glm::length(from + direction * along - center) < radius;
}

inline Instance ball(glm::vec3 center, float radius, glm::vec3 albedo = glm::vec3(1), float metallic = 0) {
  return {.center = center, .radius = radius, .albedo = albedo, .metallic = metallic};
}

}  // namespace weft::theory
