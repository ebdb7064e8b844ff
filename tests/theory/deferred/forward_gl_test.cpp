// The same spheres forward and by way of a G-buffer, under image-based light: what its quantization costs. And the sky behind them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

namespace deferred_forward_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 320, kHeight = 200;

// A blue sky over a brown ground with a broad warm light, in scene-referred units.
std::shared_ptr<const weft::assets::ImageF> broadSky() {
  return makeEnvironment([](int x, int y) {
    const Vec3 d = equirectDirection(x, y, 256, 128);
    const double up = 1 / (1 + std::exp(-8 * d.y)),
                 light = 3 * std::pow(std::max(0.0, dot(d, {0.6, 0.64, 0.48})), 20);
    return std::array{0.25 * (1 - up) + 0.4 * up + light, 0.2 * (1 - up) + 0.6 * up + 0.9 * light,
                      0.15 * (1 - up) + 1.0 * up + 0.7 * light};
  });
}

// Reinhard's curve and sRGB, as steps of 255.
double shown(double light) {
  const double c = light / (1 + light);
  return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

}  // namespace

TEST_CASE(
    "spheres through the G-buffer are the forward ones within 1/255, and the sky behind them to the bit") {
  Setup setup{.graph = "tests/theory/deferred/forward.json"};
  setup.width = kWidth;
  setup.height = kHeight;
  setup.environment = broadSky();
  setup.sets = {{"floor", "false"}};
  const glm::vec3 colors[] = {{0.95f, 0.64f, 0.54f}, {0.02f, 0.3f, 0.8f}, {0.5f, 0.5f, 0.5f}, {1, 1, 1}};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 6; ++column)
      setup.balls.push_back(
          {.center = {-6.25f + 2.5f * static_cast<float>(column), -3.75f + 2.5f * static_cast<float>(row), 0},
           .albedo = colors[row],
           .metallic = column % 2 ? 1.0f : 0.0f,
           .roughness = 0.2f * static_cast<float>(column)});
  setup.camera = {.position = {0, 0, 17}, .target = {0, 0, 0}, .fovDegrees = 40, .nearPlane = 0.1};
  Lab lab(setup);
  lab.frame();
  const Picture panels = lab.read("panels");
  double worst = 0;
  int surfaces = 0, skies = 0, other_sky = 0;
  for (std::uint32_t y = 1; y + 1 < kHeight; ++y)
    for (std::uint32_t x = 1; x + 1 < kWidth; ++x) {
      bool all = true, none = true;  // of the neighbors on a sphere, by either way
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const bool on = panels.at(2 * kWidth + x + static_cast<std::uint32_t>(i),
                                    y + static_cast<std::uint32_t>(j))[0] > 0;
          all &= on;
          none &= !on;
        }
      const float *forward = panels.at(x, y), *deferred = panels.at(kWidth + x, y);
      for (int c = 0; c < 3; ++c) {
        if (all) worst = std::max(worst, std::abs(shown(forward[c]) - shown(deferred[c])));
        if (none) other_sky += forward[c] != deferred[c];
      }
      surfaces += all;
      skies += none;
    }
  CHECK(surfaces > 10000);
  CHECK(skies > 10000);
  CHECK(worst < 1);
  CHECK(other_sky == 0);
  CHECK(lab.reports() == "");
  MESSAGE("worst difference in steps of 255: ", worst);
}

}  // namespace deferred_forward_test
