// Shadows from maps that formulas filled: what is in the shadow by construction gets no direct light, what is outside all of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

namespace deferred_shadows_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 240, kHeight = 180;

Vec3 minus(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec3 scaled(Vec3 a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
Vec3 unit(Vec3 a) {
  return scaled(a, 1 / std::sqrt(dot(a, a)));
}

const std::vector<Ball> kBalls = {
    {.center = {2, 1, 0}, .albedo = {0.8f, 0.8f, 0.8f}, .metallic = 0, .roughness = 0.8f},
    {.center = {3.2f, 0.5f, 1.6f},
     .radius = 0.5f,
     .albedo = {0.8f, 0.8f, 0.8f},
     .metallic = 0,
     .roughness = 0.5f}};

Setup spheresOnAFloor(const char* source) {
  Setup setup{.graph = "tests/theory/deferred/lighting.json"};
  setup.width = kWidth;
  setup.height = kHeight;
  setup.balls = kBalls;
  setup.camera = {.position = {0, 6, 9}, .target = {0, 0, 0}, .fovDegrees = 45, .nearPlane = 0.1};
  setup.sets = {{"source", source}};
  return setup;
}

Picture render(Setup setup, bool shadows) {
  setup.sets.push_back({"shadows", shadows ? "true" : "false"});
  Lab lab(setup);
  lab.frame();
  CHECK(lab.reports() == "");
  return lab.read("panels");
}

// The surface at a pixel: place, normal, and which ball it is on, -1 for the floor.
struct Point {
  Vec3 place, normal{0, 1, 0};
  int ball = -1;
};
bool pointAt(const Picture& panels, std::uint32_t x, std::uint32_t y, Point& point) {
  const float* at = panels.at(kWidth + x, y);
  if (at[3] == 0) return false;
  point = {.place = {at[0], at[1], at[2]}};
  for (std::size_t i = 0; i < kBalls.size(); ++i) {
    const auto& c = kBalls[i].center;
    const Vec3 out = minus(point.place, {c.x, c.y, c.z});
    if (std::abs(std::sqrt(dot(out, out)) - kBalls[i].radius) > 1e-3) continue;
    point.ball = static_cast<int>(i);
    point.normal = unit(out);
  }
  return true;
}

// How far inside the shadow of a ball (positive) or beside it (negative) the line from `place` towards `to` passes.
double insideShadow(const Point& point, Vec3 to, double until) {
  double deepest = -1e9;
  for (std::size_t i = 0; i < kBalls.size(); ++i) {
    if (static_cast<int>(i) == point.ball) continue;
    const auto& c = kBalls[i].center;
    const Vec3 away = minus({c.x, c.y, c.z}, point.place);
    const double along = std::clamp(dot(away, to), 0.0, until);
    const Vec3 nearest = minus(away, scaled(to, along));
    deepest = std::max(deepest, kBalls[i].radius - std::sqrt(dot(nearest, nearest)));
  }
  return deepest;
}

struct Count {
  int dark = 0, bright = 0, wrong_dark = 0, wrong_bright = 0;
};

}  // namespace

TEST_CASE("sun: no direct light below a roof and behind spheres, all of it elsewhere") {
  const Vec3 sun = unit({0.3, 1, 0.2});
  Setup setup = spheresOnAFloor("sun");
  setup.sets.push_back({"direction", "[0.3, 1, 0.2]"});
  setup.sets.push_back({"roof", "2.5"});
  const Picture open = render(setup, false), shaded = render(setup, true);
  Count count;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      Point point;
      if (!pointAt(open, x, y, point) || std::abs(point.place.x) > 5 || std::abs(point.place.z) > 5) continue;
      const double facing = dot(point.normal, sun);
      if (facing < 0.1) continue;
      // The roof is at height 2.5 where x < 0; spheres are lower.
      const double at_roof = point.place.x + (2.5 - point.place.y) * sun.x / sun.y;
      const double inside = std::max(insideShadow(point, sun, 100), -at_roof);
      if (std::abs(inside) < 0.1) continue;  // texels are 1/64 wide
      const float seen = shaded.at(x, y)[0], all = open.at(x, y)[0];
      if (inside > 0) {
        ++count.dark;
        count.wrong_dark += seen > 1e-6f;  // a GPU may round 32 of 32
      } else {
        ++count.bright;
        count.wrong_bright += seen != all;
      }
    }
  CHECK(count.dark > 5000);
  CHECK(count.bright > 5000);
  CHECK(count.wrong_dark == 0);
  CHECK(count.wrong_bright == 0);
}

TEST_CASE(
    "sun: the soft filter's penumbra is as wide as the sun's disc makes it, and grows with the distance") {
  constexpr double kAngle = 8;
  std::vector<double> widths;
  for (const double roof : {0.75, 1.5, 3.0}) {
    Setup setup = spheresOnAFloor("sun");
    setup.balls.clear();
    setup.camera = {.position = {0, 9, 0.01}, .target = {0, 0, 0}, .fovDegrees = 20, .nearPlane = 0.1};
    setup.sets.push_back({"angle", std::to_string(kAngle)});
    const Picture open = render(setup, false);
    setup.sets.push_back({"roof", std::to_string(roof)});
    const Picture shaded = render(setup, true);
    // Columns of the picture run along the roof's edge; their means fall from 1 to 0. Where they cross 0.1 and 0.9.
    double at[2] = {0, 0}, before = 0;
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      double seen = 0, place = 0;
      for (std::uint32_t y = kHeight / 4; y < kHeight * 3 / 4; ++y) {
        seen += shaded.at(x, y)[0] / open.at(x, y)[0] / (kHeight / 2);
        place += open.at(kWidth + x, y)[0] / double(kHeight / 2);
      }
      for (int i = 0; i < 2; ++i) {
        const double level = i ? 0.9 : 0.1;
        if (before < level && seen >= level) at[i] = place;
      }
      before = std::max(before, seen);
    }
    // A disc moved over an edge: its visible share goes from 0.1 to 0.9 over 0.687 of its width.
    const double truth = 0.687 * 2 * roof * std::tan(kAngle / 2 * std::numbers::pi / 180);
    widths.push_back(at[1] - at[0]);
    MESSAGE("roof at ", roof, ": penumbra ", widths.back(), ", by theory ", truth);
    CHECK(std::abs(widths.back() - truth) < 0.1 * truth + 0.02);
    CHECK(std::abs(at[0] + at[1]) < 0.04);  // about the edge
  }
}

TEST_CASE("lamps: no direct light behind spheres, all of it elsewhere; nothing outside a spot's cone") {
  for (const bool spot : {false, true}) {
    const Vec3 lamp = spot ? Vec3{2, 5, 0.5} : Vec3{-1.5, 4, 1};
    Setup setup = spheresOnAFloor("lamps");
    setup.sets.push_back({"spot_first", spot ? "true" : "false"});
    setup.sets.push_back({"lamp_count", "1"});
    const Picture open = render(setup, false), shaded = render(setup, true);
    Count count;
    int outside = 0, lit_outside = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        Point point;
        if (!pointAt(open, x, y, point)) continue;
        const Vec3 away = minus(lamp, point.place);
        const double distance = std::sqrt(dot(away, away));
        const Vec3 to = scaled(away, 1 / distance);
        if (distance > 9 || dot(point.normal, to) < 0.15) continue;
        if (spot && to.y < std::cos(40.2 * std::numbers::pi / 180)) {
          ++outside;
          lit_outside += open.at(x, y)[0] != 0;
          continue;
        }
        if (spot && to.y < std::cos(39.8 * std::numbers::pi / 180)) continue;
        const double inside = insideShadow(point, to, distance);
        if (std::abs(inside) < 0.08) continue;  // texels are 1/256 of the distance wide
        const float seen = shaded.at(x, y)[0], all = open.at(x, y)[0];
        if (inside > 0) {
          ++count.dark;
          count.wrong_dark += seen > 1e-6f;  // a GPU may round nine ninths
        } else {
          ++count.bright;
          count.wrong_bright += seen != all;
          CHECK(all > 0);
        }
      }
    CAPTURE(spot);
    CHECK(count.dark > 400);
    CHECK(count.bright > 5000);
    CHECK(count.wrong_dark == 0);
    CHECK(count.wrong_bright == 0);
    CHECK((outside > 2000) == spot);
    CHECK(lit_outside == 0);
  }
}

}  // namespace deferred_shadows_test
