// The G-buffer: what its textures hold comes out again within their quantization.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/theory/lab.h"

namespace deferred_gbuffer_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 128, kHeight = 96;

Setup spheresOnAFloor() {
  Setup setup{.graph = "tests/theory/deferred/gbuffer.json"};
  setup.width = kWidth;
  setup.height = kHeight;
  setup.balls = {{.center = {0, 1, 0}, .albedo = {0.8f, 0.2f, 0.05f}},
                 {.center = {40, 3, -60}, .radius = 9, .albedo = {0.01f, 0.5f, 1}}};
  setup.camera = {.position = {3, 4, 9}, .target = {0, 1, -3}, .fovDegrees = 70, .nearPlane = 0.05};
  return setup;
}

}  // namespace

TEST_CASE("G-buffer: position from reversed-Z depth is the stored one within 1e-5 of the distance") {
  const Setup setup = spheresOnAFloor();
  Lab lab(setup);
  lab.frame();
  const Picture panels = lab.read("panels");
  double worst = 0;
  int seen = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float *place = panels.at(x, y), *truth = panels.at(2 * kWidth + x, y);
      if (truth[3] == 0) continue;
      const auto apart = [&](const float* a, auto&& b) {
        return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      };
      const double distance = apart(truth, setup.camera.position);
      if (distance > 2000) continue;  // of the floor, near the horizon
      worst = std::max(worst, apart(place, truth) / distance);
      ++seen;
    }
  CHECK(seen > 8000);
  CHECK(worst < 1e-5);
  MESSAGE("worst difference, as a share of the distance: ", worst);
  CHECK(lab.reports() == "");
}

TEST_CASE(
    "G-buffer: normals come back within 7e-5 radians, those along the axes exactly, the base color within "
    "its steps") {
  const Setup setup = spheresOnAFloor();
  Lab lab(setup);
  lab.frame();
  const Picture panels = lab.read("panels");
  double worst = 0;
  int floors = 0, balls = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float *facing = panels.at(kWidth + x, y), *at = panels.at(2 * kWidth + x, y);
      const float* color = panels.at(3 * kWidth + x, y);
      if (at[3] == 0) continue;
      if (std::abs(at[1]) < 1e-3) {
        ++floors;
        CHECK(facing[0] == 0);
        CHECK(facing[1] == 1);
        CHECK(facing[2] == 0);
        continue;
      }
      const Ball& ball = setup.balls[std::hypot(at[0], at[1] - 1, at[2]) < 1.5 ? 0 : 1];
      double across = 0;
      for (int c = 0; c < 3; ++c) {
        const double truth = (double(at[c]) - ball.center[c]) / ball.radius;
        across += (facing[c] - truth) * (facing[c] - truth);
        CHECK(std::abs(color[c] - ball.albedo[c]) < 0.005);  // a step of sRGB at 1 is 0.009
      }
      worst = std::max(worst, std::sqrt(across));
      ++balls;
    }
  CHECK(floors > 2000);
  CHECK(balls > 300);
  CHECK(worst <
        7e-5);  // half a step of 1/32767 both ways, 4.24 times as long on the sphere where it is longest
  MESSAGE("worst normal: ", worst, " radians");
}

TEST_CASE("G-buffer: exponents of Blinn-Phong come back within 1.4 %") {
  for (const double exponent : {1.5, 8.0, 60.0, 500.0, 1000.0}) {
    Setup setup = spheresOnAFloor();
    setup.sets = {{"ball_model", std::to_string(std::log2(exponent) / 10)}};
    Lab lab(setup);
    lab.frame();
    const Picture panels = lab.read("panels");
    int seen = 0;
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float* place = panels.at(x, kHeight / 2);
      if (std::hypot(place[0], place[1] - 1, place[2]) > 1.001) continue;
      CHECK(place[3] == doctest::Approx(exponent).epsilon(0.014));
      ++seen;
    }
    CHECK(seen > 5);
  }
}

}  // namespace deferred_gbuffer_test
