// What shaders/spheres/probes/bake.comp.glsl computes, on the CPU and in the plainest way: the reference of the tests of light probes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace weft::scene {

// Real spherical harmonics up to band 2, and what of them a cap of constant radiance has in closed form. Order of the nine:
// Y00, Y1-1 (y), Y10 (z), Y11 (x), Y2-2 (xy), Y2-1 (yz), Y20 (3zz - 1), Y21 (xz), Y22 (xx - yy), as
// shaders/gi/sh.glsl has them.
constexpr std::size_t kShCount = 9;
constexpr float kPi = 3.14159265358979f;

// The functions in a unit direction.
std::array<float, kShCount> shBasis(glm::vec3 direction);

// The factor of each band from radiance to irradiance, the cosine lobe: pi, 2 pi / 3, pi / 4.
constexpr glm::vec3 kCosineLobe{kPi, kPi * 2 / 3, kPi / 4};

// Radiance 1 in a cone around a direction w whose half angle has this sine (0..1, at most a right angle): the coefficient
// (l, m) of it is component l of this times Y_lm(w). Its zonal harmonics, turned to w.
glm::vec3 capBands(float sine);
// The same of a point that lights a surface facing it as much as the cone does: all of its light comes from w.
glm::vec3 pointBands(float sine);

// The centers of the outermost probes are the corners of the box.
struct ProbeGrid {
  glm::vec3 low{0}, high{0};  // world
  glm::uvec3 count{1};        // along each axis, over 0
  std::size_t size() const { return std::size_t{count.x} * count.y * count.z; }
  // One probe along an axis stands in the middle.
  glm::vec3 position(glm::uvec3 probe) const;
  std::size_t indexOf(glm::uvec3 probe) const {
    return probe.x + count.x * (probe.y + std::size_t{count.y} * probe.z);
  }
};

// Fitted to the spheres; the origin when there are none.
ProbeGrid placeProbes(std::span<const Instance> spheres, glm::uvec3 count);

// How a sphere is seen: as the cap of the sky that it covers, or as a point as strong.
enum class ProbeShape : std::uint8_t { cap, point };
// How its light ends at the far distance: by (1 - x^4)^2 with x the share of that distance (Karis 2013), or at once.
enum class ProbeWindow : std::uint8_t { smooth, hard };

struct ProbeRules {
  float near = 1.05f,
        far = 10;  // in radii of the sphere, from its center: it lights probes in between; near is at least 1
  ProbeShape shape = ProbeShape::cap;
  ProbeWindow window = ProbeWindow::smooth;
};

// Bands of the irradiance at `offset` from the probe to the center of a sphere of radiance 1: coefficient (l, m) is
// component l times Y_lm(offset / |offset|). Zero where it does not light the probe.
glm::vec3 bandsOfSphere(const ProbeRules& rules, glm::vec3 offset, float radius);

// Coefficients of irradiance; xyz are red, green and blue.
struct Probe {
  glm::vec4 sh[kShCount];
};

// Adds the spheres up in their order: grid.size() probes.
std::vector<Probe> computeProbes(const ProbeGrid& grid, const ProbeRules& rules,
                                 std::span<const Instance> spheres);

}  // namespace weft::scene
