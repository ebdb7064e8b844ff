// Depth of field: the disc is the thin lens's; what is in focus stays to the bit; layers do not leak into each other; one
// colour stays that colour; light is kept, and spread as wide as the disc says.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/theory/lab.h"

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 240, kHeight = 160;

struct Lens {
  double focalLength = 200, aperture = 1.4, focus = 20, sensor = 24;  // mm, f-number, world units, mm
};

// Radius in pixels of the image of a point at `distance`: two similar triangles behind the lens. The lens equation gives where
// the point and the plane in focus have their images; the cone to the point's image cuts the sensor in a disc.
double discRadius(const Lens& lens, double distance) {
  const double f = lens.focalLength / 1000;
  const auto imageOf = [&](double d) { return std::isinf(d) ? f : 1 / (1 / f - 1 / d); };
  const double sensor = imageOf(lens.focus), image = imageOf(distance), pupil = f / lens.aperture;
  const double diameter = pupil * std::abs(sensor - image) / image;
  return diameter / 2 / (lens.sensor / 1000) * kHeight;
}

Setup scene(std::vector<Ball> balls, const Lens& lens, const std::string& rings = "6") {
  return {.graph = "tests/theory/lens.json",
          .width = kWidth,
          .height = kHeight,
          .sets = {{"dof", "true"},
                   {"rings", rings},
                   {"focal_length", std::to_string(lens.focalLength)},
                   {"aperture", std::to_string(lens.aperture)},
                   {"focus_distance", std::to_string(lens.focus)},
                   {"sensor_height", std::to_string(lens.sensor)}},
          .balls = std::move(balls)};
}

struct Panels {
  Picture all;
  const float* before(std::uint32_t x, std::uint32_t y) const { return all.at(x, y); }
  const float* after(std::uint32_t x, std::uint32_t y) const { return all.at(kWidth + x, y); }
};

Panels panelsOf(const Setup& setup) {
  Lab lab(setup);
  lab.frame(0);
  Panels panels{lab.read("panels")};
  CHECK(lab.complaints() == "");
  return panels;
}

double largestChange(const Panels& panels) {
  double worst = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      for (int c = 0; c < 4; ++c) worst = std::max<double>(worst, std::abs(panels.after(x, y)[c] - panels.before(x, y)[c]));
  return worst;
}

struct Dark {
  double mass = 0, variance = 0;  // of what differs from the sky of radiance 1; variance per axis
};

Dark darkOf(const Panels& panels, bool after) {
  double mass = 0, x1 = 0, y1 = 0, r2 = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const double d = 1 - (after ? panels.after(x, y) : panels.before(x, y))[1];
      mass += d;
      x1 += d * x;
      y1 += d * y;
      r2 += d * (double{1} * x * x + double{1} * y * y);
    }
  return {mass, (r2 / mass - (x1 * x1 + y1 * y1) / mass / mass) / 2};
}

const glm::vec3 kGrey{0.2f, 0.2f, 0.2f};

}  // namespace

TEST_CASE("focus: the disc's radius is the thin lens's, before the focus, behind it and at infinity, within 0.5 %") {
  const Lens lenses[] = {{}, {.focalLength = 100, .aperture = 1.0, .focus = 6}, {.focalLength = 300, .aperture = 2, .focus = 12, .sensor = 36}};
  for (const Lens& lens : lenses)
    for (const double distance : {4.0, 8.0, 30.0, 100.0}) {
      Lab lab(scene({{.center = {0, 0, 20 - distance}, .radius = static_cast<float>(distance / 10)}}, lens));
      lab.frame(0);
      const std::uint32_t layer = 0.9 * distance < lens.focus ? 0 : 1;
      const Picture layers = lab.read("post.fields", 0, layer);
      const double expected = std::min(discRadius(lens, 0.9 * distance), 31.0);
      CAPTURE(lens.focus);
      CAPTURE(distance);
      REQUIRE(expected > 0.6);
      CHECK(2 * layers.at(kWidth / 4, kHeight / 4)[3] == doctest::Approx(expected).epsilon(0.005));
      const Picture far = lab.read("post.fields", 0, 1);
      CHECK(2 * far.at(2, 2)[3] == doctest::Approx(std::min(discRadius(lens, INFINITY), 31.0)).epsilon(0.005));
    }
}

TEST_CASE("focus: defocus of what is in focus is the identity, bit for bit") {
  // The sky with the focus so far away that its disc is nothing, and in the middle something in the plane in focus.
  const Lens far{.focalLength = 50, .aperture = 8, .focus = 5000};
  CHECK(largestChange(panelsOf(scene({{.center = {0, 0, -3000}, .radius = 300, .albedo = kGrey}}, far))) == 0);
}

TEST_CASE("focus: what is in focus does not leak into the blurred sky around it, nor the sky into it") {
  const Lens lens{.focalLength = 300, .focus = 19.5};
  REQUIRE(discRadius(lens, INFINITY) > 3);
  const Panels panels = panelsOf(scene({{.center = {0, 0, 0}, .radius = 1, .albedo = kGrey},
                                        {.center = {4, 1, 0}, .radius = 1, .albedo = {0.9f, 0.1f, 0.1f}}}, lens));
  MESSAGE("largest change: ", largestChange(panels));
  CHECK(largestChange(panels) < 4e-3);
}

TEST_CASE("focus: what is before the focus covers the sharp sky as far as its disc reaches, and no farther") {
  const Lens lens{.focalLength = 50, .aperture = 1.4, .focus = 1000, .sensor = 4};
  const double radius = discRadius(lens, 6);
  REQUIRE(radius > 4);
  const Panels panels = panelsOf(scene({{.center = {0, 0, 14}, .radius = 0.8f, .albedo = kGrey}}, lens));
  std::uint32_t edge = 0;
  const std::uint32_t row = kHeight / 2;
  while (edge < kWidth && panels.before(edge, row)[1] > 0.6) ++edge;
  REQUIRE(edge > 40);
  CAPTURE(radius);
  CHECK(panels.after(edge - 1, row)[1] < 0.8);
  CHECK(panels.after(edge + 1, row)[1] > 0.3);  // the sky shows inside the silhouette
  CHECK(panels.after(edge - static_cast<std::uint32_t>(radius / 2), row)[1] < 0.98);
  for (std::uint32_t x = 0; x + radius + 4 < edge; ++x) CHECK(panels.after(x, row)[1] == panels.before(x, row)[1]);
}

TEST_CASE("focus: one colour stays that colour") {
  const Lens lens{.aperture = 0.7};
  const Panels panels = panelsOf(scene({{.center = {0, 0, 14}, .radius = 1},
                                        {.center = {-3, 2, 0}, .radius = 1},
                                        {.center = {6, -3, -30}, .radius = 5}}, lens));
  CHECK(largestChange(panels) < 4e-3);
}

TEST_CASE("focus: before and behind, light is kept within 2 % and spreads as a disc of the thin lens's radius") {
  struct Case {
    Lens lens;
    Ball ball;
  };
  const Case cases[] = {{{.focalLength = 150, .aperture = 1.4, .focus = 40}, {.center = {0, 0, 14}, .radius = 0.8f, .albedo = kGrey}},
                        {{.focalLength = 100, .aperture = 0.7, .focus = 5}, {.center = {0, 0, -10}, .radius = 4, .albedo = kGrey}}};
  for (const Case& c : cases) {
    const Panels panels = panelsOf(scene({c.ball}, c.lens, "8"));
    const Dark sharp = darkOf(panels, false), blurred = darkOf(panels, true);
    const double radius = discRadius(c.lens, 20.0 - c.ball.center.z - 0.5 * c.ball.radius);
    CAPTURE(radius);
    MESSAGE("light kept: ", blurred.mass / sharp.mass, ", variance ", blurred.variance - sharp.variance, " of ", radius * radius / 4);
    REQUIRE(radius > 4);
    CHECK(blurred.mass == doctest::Approx(sharp.mass).epsilon(0.02));
    CHECK(blurred.variance - sharp.variance == doctest::Approx(radius * radius / 4).epsilon(0.25));
  }
}

TEST_CASE("focus: blades make a polygon of the disc, and the light stays") {
  Setup setup = scene({{.center = {0, 0, 14}, .radius = 0.8f, .albedo = kGrey}}, {.focalLength = 150, .focus = 40}, "8");
  setup.sets.push_back({"blades", "5"});
  const Panels panels = panelsOf(setup);
  CHECK(darkOf(panels, true).mass == doctest::Approx(darkOf(panels, false).mass).epsilon(0.03));
}

TEST_CASE("focus: without dof_reach there is still a blurred picture, and GL has nothing to say") {
  Setup setup = scene({{.center = {0, 0, 14}, .radius = 0.8f, .albedo = kGrey}}, {.focalLength = 150, .focus = 40}, "8");
  setup.disables = {"post.dof_reach"};
  const Panels panels = panelsOf(setup);
  CHECK(darkOf(panels, true).variance > darkOf(panels, false).variance + 10);
}
