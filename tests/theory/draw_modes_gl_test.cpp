// The studio drawn as triangles against the studio ray-traced; the sorts of the ray-traced mode against each
// other.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

namespace draw_modes_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 320, kHeight = 240;

// Bright above, a gradient around, darker below: every direction has its own color.
std::shared_ptr<const weft::assets::ImageF> gradientEnvironment() {
  return makeEnvironment([](int x, int y) {
    const Vec3 d = equirectDirection(x, y, 256, 128);
    return std::array{1 + 0.8 * d.x, 1 + 0.8 * d.y, 1 + 0.8 * d.z};
  });
}

std::vector<Ball> crowd() {
  std::vector<Ball> balls;
  for (int i = 0; i < 12; ++i)
    balls.push_back({.center = {(i % 4) * 2.5 - 3.75, 2.5 - (i / 4) * 2.5, (i * 5 % 7) * 0.8},
                     .albedo = {0.9f, 0.5f, 0.1f + 0.05f * static_cast<float>(i)},
                     .metallic = i % 2 ? 1.0f : 0.0f,
                     .roughness = static_cast<float>(i) / 11});
  balls.push_back({.center = {-3.2, 2.1, 4}, .radius = 0.7f, .velocity = {1, 0, 0}});
  return balls;
}

Setup studio(std::vector<weft::graph::Setting> sets) {
  Setup setup{.graph = "tests/theory/draw_modes.json",
              .width = kWidth,
              .height = kHeight,
              .sets = std::move(sets),
              .balls = crowd()};
  setup.camera = {.position = {1, 0.5, 14}, .target = {0, 0, 0}, .fovDegrees = 45, .nearPlane = 0.1};
  setup.environment = gradientEnvironment();
  return setup;
}

Picture draw(const Setup& setup) {
  Lab lab(setup);
  lab.frame(1);
  Picture panels = lab.read("panels");
  CHECK(lab.reports() == "");
  return panels;
}

// The panels of draw_modes.json.
const float* radianceAt(const Picture& panels, std::uint32_t x, std::uint32_t y) {
  return panels.at(x, y);
}
const float* velocityAt(const Picture& panels, std::uint32_t x, std::uint32_t y) {
  return panels.at(2 * kWidth + x, y);
}
float depthAt(const Picture& panels, std::uint32_t x, std::uint32_t y) {
  return panels.at(3 * kWidth + x, y)[0];
}

}  // namespace

TEST_CASE(
    "icospheres of 81,920 triangles are the ray-traced spheres: 1 % inside, the silhouette moves by less "
    "than a pixel") {
  const Picture traced = draw(studio({})), mesh = draw(studio({{"draw", "icosphere"}, {"subdivision", "6"}}));
  double worst = 0, worstDepth = 0, worstVelocity = 0;
  int inside = 0, differs = 0, edges = 0;
  for (std::uint32_t y = 2; y + 2 < kHeight; ++y)
    for (std::uint32_t x = 2; x + 2 < kWidth; ++x) {
      // Inside: both have a sphere here and around, at nearly one depth.
      const float near = depthAt(traced, x, y);
      bool interior = near > 0, edge = false;
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
          const auto u = static_cast<std::uint32_t>(static_cast<int>(x) + i),
                     v = static_cast<std::uint32_t>(static_cast<int>(y) + j);
          const float other = depthAt(traced, u, v);
          interior = interior && other > 0 && std::abs(other / near - 1) < 0.05f;
          edge = edge || (other > 0) != (near > 0);
        }
      if ((near > 0) != (depthAt(mesh, x, y) > 0)) {
        ++differs;
        CHECK(edge);  // nowhere but beside a silhouette
      }
      edges += edge ? 1 : 0;
      if (!interior) continue;
      ++inside;
      for (int c = 0; c < 3; ++c)
        worst =
            std::max<double>(worst, std::abs(radianceAt(mesh, x, y)[c] / radianceAt(traced, x, y)[c] - 1));
      worstDepth = std::max<double>(worstDepth, std::abs(depthAt(mesh, x, y) / near - 1));
      for (int c = 0; c < 2; ++c)
        worstVelocity = std::max<double>(worstVelocity,
                                         std::abs(velocityAt(mesh, x, y)[c] - velocityAt(traced, x, y)[c]));
    }
  MESSAGE("worst inside: radiance ", worst, ", depth ", worstDepth, ", velocity ", worstVelocity);
  CHECK(inside > 5000);
  CHECK(differs < edges / 2);
  CHECK(worst < 0.0013);
  CHECK(worstDepth < 2.6e-5);
  CHECK(worstVelocity < 1.3e-6);
}

TEST_CASE(
    "icospheres around the eye and cut by the near plane show their inside, as the ray-traced spheres do") {
  struct Place {
    const char* name;
    glm::dvec3 eye;
    double nearPlane;
  };
  // In the sphere of radius 1 at (1.25, 2.5, 2.4); so close to it that the near plane cuts it; and in a place between all spheres.
  for (const Place& place : {Place{"inside", {1.35, 2.6, 1.9}, 0.05}, Place{"cut", {1.25, 2.5, 3.7}, 0.6},
                             Place{"between", {0, 1.25, 6}, 0.1}}) {
    const auto setup = [&](std::vector<weft::graph::Setting> sets) {
      Setup made = studio(std::move(sets));
      made.camera = {.position = place.eye,
                     .target = place.eye + glm::dvec3(0.1, -0.2, -2),
                     .fovDegrees = 70,
                     .nearPlane = place.nearPlane};
      return made;
    };
    const Picture traced = draw(setup({})), mesh = draw(setup({{"draw", "icosphere"}, {"subdivision", "6"}}));
    int covered = 0, missing = 0;
    double worst = 0;
    for (std::uint32_t y = 2; y + 2 < kHeight; ++y)
      for (std::uint32_t x = 2; x + 2 < kWidth; ++x) {
        const float near = depthAt(traced, x, y);
        bool edge = near <= 0;  // silhouettes, and where the near plane cuts
        for (int k = 0; k < 25 && !edge; ++k)
          edge = std::abs(depthAt(traced, x + static_cast<std::uint32_t>(k % 5) - 2,
                                  y + static_cast<std::uint32_t>(k / 5) - 2) /
                              near -
                          1) > 0.05f;
        if (edge) continue;
        ++covered;
        if (std::abs(depthAt(mesh, x, y) / near - 1) > 0.02f) ++missing;
        for (int c = 0; c < 3; ++c)
          worst = std::max<double>(worst, std::abs(radianceAt(mesh, x, y)[c] - radianceAt(traced, x, y)[c]));
      }
    CAPTURE(std::string(place.name));
    MESSAGE(covered, " pixels inside, ", missing, " of them at another depth; radiance differs by ", worst);
    CHECK(covered > 20000);
    CHECK(missing == 0);
    CHECK(worst < 0.0013);
  }
}

TEST_CASE("icospheres: nothing is sorted; a wireframe draws lines only") {
  Setup setup = studio({{"draw", "icosphere"}, {"subdivision", "3"}});
  const Picture filled = draw(setup);
  setup.sets.emplace_back("wireframe", "true");
  const Picture lines = draw(setup);
  int pixels = 0, kept = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      pixels += depthAt(filled, x, y) > 0;
      kept += depthAt(lines, x, y) > 0;
    }
  CHECK(kept > pixels / 20);
  CHECK(kept < pixels * 9 / 10);
}

TEST_CASE("the sorts on the CPU and on the GPU give one picture, byte for byte") {
  const Picture first = draw(studio({{"sort", "gpu_bitonic"}}));
  CHECK(first.texels == draw(studio({{"sort", "cpu_radix"}})).texels);
}

}  // namespace draw_modes_test
