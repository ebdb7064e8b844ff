#include "engine/scene/probes/probes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/scene/frame/parallel.h"

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

constexpr std::size_t kMaxParts = 16;  // of a grid that are computed beside each other

constexpr int bandOf(std::size_t i) {
  return i == 0 ? 0 : i < 4 ? 1 : 2;
}

// Probes along one axis that may lie within `reach` of `center`, with one to spare on each side against rounding.
struct Range {
  std::uint32_t first = 0, end = 0;
};
Range cellsWithin(float low, float high, std::uint32_t count, float center, float reach) {
  const float extent = high - low;
  if (count < 2 || !(extent > 0)) return {0, count};
  const float per = static_cast<float>(count - 1) / extent, last = static_cast<float>(count);
  const float first = std::floor((center - reach - low) * per) - 1;
  const float end = std::ceil((center + reach - low) * per) + 2;
  return {static_cast<std::uint32_t>(std::clamp(first, 0.0f, last)),
          static_cast<std::uint32_t>(std::clamp(end, 0.0f, last))};
}

// Adds what a sphere gives to the probes of the lines along x from `from` to `to`; line j + count.y * k is at (j, k).
void addSphere(const ProbeGrid& grid, const ProbeRules& rules, const Instance& sphere, std::size_t from,
               std::size_t to, std::span<Probe> out) {
  const glm::vec3 color = sphere.albedo * (1.0f - sphere.metallic), c = sphere.center;
  const float reach = rules.far * sphere.radius;
  const Range x = cellsWithin(grid.low.x, grid.high.x, grid.count.x, c.x, reach);
  const Range y = cellsWithin(grid.low.y, grid.high.y, grid.count.y, c.y, reach);
  const Range z = cellsWithin(grid.low.z, grid.high.z, grid.count.z, c.z, reach);
  for (std::uint32_t k = z.first; k < z.end; ++k)
    for (std::uint32_t j = y.first; j < y.end; ++j) {
      const std::size_t line = j + std::size_t{grid.count.y} * k;
      if (line < from || line >= to) continue;
      for (std::uint32_t i = x.first; i < x.end; ++i) {
        const glm::vec3 offset = c - grid.position({i, j, k});
        const glm::vec3 bands = bandsOfSphere(rules, offset, sphere.radius);
        if (bands.x == 0.0f) continue;
        const auto basis = shBasis(offset / std::sqrt(glm::dot(offset, offset)));
        Probe& probe = out[grid.indexOf({i, j, k})];
        for (std::size_t n = 0; n < kShCount; ++n)
          probe.sh[n] += glm::vec4(bands[bandOf(n)] * basis[n] * color, 0.0f);
      }
    }
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

bool computeProbes(const ProbeGrid& grid, const ProbeRules& rules, std::span<const Instance> spheres,
                   std::span<Probe> out, const std::atomic<bool>* canceled, int threads) {
  assert(out.size() == grid.size());
  std::ranges::fill(out, Probe{});
  const std::size_t lines = std::size_t{grid.count.y} * grid.count.z;
  const auto isCanceled = [canceled] { return canceled && canceled->load(std::memory_order_relaxed); };
  onThreads(threads, [&] {
    forRanges(lines, (lines + kMaxParts - 1) / kMaxParts, [&](std::size_t from, std::size_t to) {
      for (const Instance& sphere : spheres) {
        if (isCanceled()) return;
        addSphere(grid, rules, sphere, from, to, out);
      }
    });
  });
  return !isCanceled();
}

}  // namespace weft::scene
