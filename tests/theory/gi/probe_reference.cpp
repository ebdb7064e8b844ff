#include "tests/theory/gi/probe_reference.h"

#include <algorithm>
#include <cmath>

namespace weft::scene {

std::array<float, kShCount> shBasis(glm::vec3 d) {
  return {0.282094792f,
          0.488602512f * d.y,
          0.488602512f * d.z,
          0.488602512f * d.x,
          1.092548431f * d.x * d.y,
          1.092548431f * d.y * d.z,
          0.315391565f * (3.0f * d.z * d.z - 1.0f),
          1.092548431f * d.x * d.z,
          0.546274215f * (d.x * d.x - d.y * d.y)};
}

// Integrals of the Legendre polynomials from the cosine to 1, times 2 pi. 1 - cosine = sine^2 / (1 + cosine), which keeps
// its digits far away.
glm::vec3 capBands(float sine) {
  const float square = std::min(sine * sine, 1.0f), cosine = std::sqrt(1.0f - square);
  return {2.0f * kPi * square / (1.0f + cosine), kPi * square, kPi * square * cosine};
}

glm::vec3 pointBands(float sine) {
  return glm::vec3(kPi * std::min(sine * sine, 1.0f));
}

namespace {

constexpr int bandOf(std::size_t i) {
  return i == 0 ? 0 : i < 4 ? 1 : 2;
}

}  // namespace

glm::vec3 ProbeGrid::position(glm::uvec3 probe) const {
  glm::vec3 at;
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = count[axis] > 1 ? low[axis] + (high[axis] - low[axis]) * (static_cast<float>(probe[axis]) /
                                                                         static_cast<float>(count[axis] - 1))
                               : 0.5f * (low[axis] + high[axis]);
  return at;
}

ProbeGrid placeProbes(std::span<const Instance> spheres, glm::uvec3 count) {
  ProbeGrid grid{.count = count};
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const glm::vec3 low = spheres[i].center - spheres[i].radius, high = spheres[i].center + spheres[i].radius;
    grid.low = i == 0 ? low : glm::min(grid.low, low);
    grid.high = i == 0 ? high : glm::max(grid.high, high);
  }
  return grid;
}

// Comparisons are such that what is not a number lights nothing.
glm::vec3 bandsOfSphere(const ProbeRules& rules, glm::vec3 offset, float radius) {
  const float d2 = glm::dot(offset, offset), r2 = radius * radius;
  if (!(r2 > 0) || !(d2 >= rules.near * rules.near * r2) || !(d2 < rules.far * rules.far * r2))
    return glm::vec3(0);
  const float sine = std::sqrt(r2 / d2);
  const glm::vec3 bands = rules.shape == ProbeShape::cap ? capBands(sine) : pointBands(sine);
  float weight = 1;
  if (rules.window == ProbeWindow::smooth) {
    const float x2 = d2 / (rules.far * rules.far * r2), left = 1.0f - x2 * x2;
    weight = left * left;
  }
  return weight * bands * kCosineLobe;
}

std::vector<Probe> computeProbes(const ProbeGrid& grid, const ProbeRules& rules,
                                 std::span<const Instance> spheres) {
  std::vector<Probe> probes(grid.size());
  for (const Instance& sphere : spheres)
    for (std::uint32_t k = 0; k < grid.count.z; ++k)
      for (std::uint32_t j = 0; j < grid.count.y; ++j)
        for (std::uint32_t i = 0; i < grid.count.x; ++i) {
          const glm::vec3 offset = sphere.center - grid.position({i, j, k});
          const glm::vec3 bands = bandsOfSphere(rules, offset, sphere.radius);
          if (bands.x == 0.0f) continue;
          const auto basis = shBasis(offset / std::sqrt(glm::dot(offset, offset)));
          Probe& probe = probes[grid.indexOf({i, j, k})];
          for (std::size_t n = 0; n < kShCount; ++n)
            probe.sh[n] +=
                glm::vec4(bands[bandOf(n)] * basis[n] * sphere.albedo * (1.0f - sphere.metallic), 0.0f);
        }
  return probes;
}

}  // namespace weft::scene
