// What a reader of light probes makes of them, as shaders/gi/probes.glsl does it, for tests.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/theory/gi/probe_reference.h"

namespace weft::scene {

// Irradiance of a surface with this unit normal, not below zero.
inline glm::vec3 irradianceOf(const Probe& probe, glm::vec3 normal) {
  const auto basis = shBasis(normal);
  glm::vec3 sum(0);
  for (std::size_t n = 0; n < kShCount; ++n) sum += basis[n] * glm::vec3(probe.sh[n]);
  return glm::max(sum, glm::vec3(0));
}

// What of its light a reader needs who multiplies by the environment: it was thrown back by what faces `facing` in the mean, a
// unit direction; `sure` is nearly 1 (0.91) where all of it comes along the normal, less where it comes from many sides, 1/2 at least. The
// environment's irradiance in `facing` times sure, plus that in -facing times 1 - sure, is right for a linear one.
struct Bounce {
  glm::vec3 irradiance{0}, facing{0, 1, 0};
  float sure = 0.5f;
};

// The integral of L(w) max(w.n, 0) w, whose direction and length (over the irradiance) are wanted. By bands the clamped cosine is
// 1/4 + 1/2 w.n + 5/32 (3 (w.n)^2 - 1), so with D and T the integrals of L w and L w w' it is 3/16 D + 1/2 T n + 3/16 n (n.D);
// of the third moment only its part in band 1 is known.
inline Bounce bounceOf(const Probe& probe, glm::vec3 normal) {
  Bounce bounce{.irradiance = irradianceOf(probe, normal), .facing = -normal};
  const auto basis = shBasis(normal);
  float l[kShCount], all = 0;
  for (std::size_t n = 0; n < kShCount; ++n) {
    l[n] = glm::dot(glm::vec3(probe.sh[n]), glm::vec3(0.2126f, 0.7152f, 0.0722f));
    all += basis[n] * l[n];
    l[n] /= kCosineLobe[n == 0 ? 0 : n < 4 ? 1 : 2];
  }
  const float flux = l[0] * 3.544907702f, zz = flux / 3 + l[6] / 0.946174695f;
  const float even = flux - zz, odd = l[8] / 0.546274215f;
  const float xy = l[4] / 1.092548431f, yz = l[5] / 1.092548431f, xz = l[7] / 1.092548431f;
  const glm::vec3 d = glm::vec3(l[3], l[1], l[2]) * 2.046653415f;
  const glm::mat3 t(0.5f * (even + odd), xy, xz, xy, 0.5f * (even - odd), yz, xz, yz, zz);
  const glm::vec3 from = 0.1875f * d + 0.5f * (t * normal) + 0.1875f * glm::dot(normal, d) * normal;
  const float size = std::sqrt(glm::dot(from, from));
  if (size > 1e-6f) bounce.facing = -from / size;
  bounce.sure = 0.5f + 0.5f * std::clamp(size / std::max(all, 1e-6f), 0.0f, 1.0f);
  return bounce;
}

// The share of the light at the nearest point of the box that is left at a point outside: far away it falls with the square of the
// distance. 1 inside.
// From a source in the middle of the box, spread over a quarter of its half diagonal.
inline float leftOutside(const ProbeGrid& grid, glm::vec3 point) {
  const glm::vec3 half = 0.5f * (grid.high - grid.low), out = point - 0.5f * (grid.low + grid.high);
  const glm::vec3 edge = glm::clamp(out, -half, half);
  const float spread = glm::dot(half, half) / 16;
  return (glm::dot(edge, edge) + spread) / std::max(glm::dot(out, out) + spread, 1e-20f);
}

// The mix of the eight probes around a point, each as near as it is along the axes; outside the box that of its nearest point,
// times leftOutside.
inline Probe probeAt(const ProbeGrid& grid, std::span<const Probe> probes, glm::vec3 point) {
  glm::uvec3 below(0), above(0);
  glm::vec3 part(0);
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = grid.high[axis] - grid.low[axis], last = static_cast<float>(grid.count[axis] - 1);
    if (!(extent > 0)) continue;
    const float at = std::clamp((point[axis] - grid.low[axis]) / extent * last, 0.0f, last);
    below[axis] = static_cast<std::uint32_t>(at);
    above[axis] = std::min(below[axis] + 1, grid.count[axis] - 1);
    part[axis] = at - static_cast<float>(below[axis]);
  }
  const float left = leftOutside(grid, point);
  Probe mixed{};
  for (unsigned corner = 0; corner < 8; ++corner) {
    glm::uvec3 at = below;
    float weight = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const bool up = (corner >> axis & 1u) != 0;
      if (up) at[axis] = above[axis];
      weight *= up ? part[axis] : 1.0f - part[axis];
    }
    const Probe& probe = probes[grid.indexOf(at)];
    for (std::size_t n = 0; n < kShCount; ++n) mixed.sh[n] += weight * left * probe.sh[n];
  }
  return mixed;
}

}  // namespace weft::scene
