// Motion blur: nothing where nothing moves, streaks along the motion and past the silhouette where something does, the light
// of the picture kept; and the velocity of the sky under a camera that turns.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "tests/theory/lab.h"

namespace lens_motion_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 240, kHeight = 160;

struct Panels {
  Picture all;
  const float* at(std::uint32_t panel, std::uint32_t x, std::uint32_t y) const {
    return all.at(panel * kWidth + x, y);
  }
  const float* before(std::uint32_t x, std::uint32_t y) const { return at(0, x, y); }
  const float* after(std::uint32_t x, std::uint32_t y) const { return at(1, x, y); }
  const float* velocity(std::uint32_t x, std::uint32_t y) const { return at(2, x, y); }
};

Setup scene(std::vector<Ball> balls) {
  return {.graph = "tests/theory/lens/lens.json",
          .width = kWidth,
          .height = kHeight,
          .sets = {{"motion_blur", "true"}},
          .balls = std::move(balls)};
}

Panels panelsOf(const Setup& setup) {
  Lab lab(setup);
  lab.frame(0);
  lab.frame(1);
  Panels panels{lab.read("panels")};
  CHECK(lab.reports() == "");
  return panels;
}

// Sum of what differs from the sky of radiance 1, and where it lies.
struct Dark {
  double mass = 0, x = 0, y = 0, xx = 0, yy = 0;
  double spreadX() const { return xx / mass - x * x / mass / mass; }
  double spreadY() const { return yy / mass - y * y / mass / mass; }
};

Dark darkOf(const Panels& panels, std::uint32_t panel) {
  Dark dark;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const double d = 1 - panels.at(panel, x, y)[1];
      dark.mass += d;
      dark.x += d * x;
      dark.y += d * y;
      dark.xx += d * x * x;
      dark.yy += d * y * y;
    }
  return dark;
}

const Ball kGray{.center = {0, 0, 0}, .radius = 2, .albedo = {0.2f, 0.2f, 0.2f}};

// World units per second across the view that move the silhouette of kGray, at a distance of 19.8, by `pixels` in a frame.
float speedOf(double pixels) {
  const double focal = kHeight / 2.0 / std::tan(M_PI / 6);
  return static_cast<float>(pixels * 19.8 / focal * 60);
}

}  // namespace

TEST_CASE("motion blur of a frame in which nothing moves is the identity, bit for bit") {
  const Panels panels = panelsOf(scene({kGray, {.center = {4, 2, -3}, .albedo = {0.9f, 0.5f, 0.1f}}}));
  std::size_t different = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      different += std::memcmp(panels.before(x, y), panels.after(x, y), 4 * sizeof(float)) != 0;
  CHECK(different == 0);
  CHECK(panels.before(kWidth / 2, kHeight / 2)[1] < 0.5);
}

TEST_CASE(
    "motion blur: a moving sphere smears along its motion, past its silhouette, and keeps the light within 1 "
    "%") {
  for (const bool upwards : {false, true}) {
    Setup setup = scene({kGray});
    const float speed = speedOf(24);
    setup.balls[0].velocity = upwards ? glm::vec3(0, speed, 0) : glm::vec3(speed, 0, 0);
    setup.sets.insert(setup.sets.end(), {{"shutter", "360"}, {"samples", "32"}});
    const Panels panels = panelsOf(setup);
    const Dark sharp = darkOf(panels, 0), blurred = darkOf(panels, 1);
    CAPTURE(upwards);
    MESSAGE("light kept: ", blurred.mass / sharp.mass,
            ", of the whole picture: ", (kWidth * kHeight - blurred.mass) / (kWidth * kHeight - sharp.mass));
    CHECK(blurred.mass == doctest::Approx(sharp.mass).epsilon(0.01));
    // It stays where it is, and the variance along the motion grows by that of a box 24 pixels wide.
    CHECK(blurred.x / blurred.mass == doctest::Approx(sharp.x / sharp.mass).epsilon(0.005));
    CHECK(blurred.y / blurred.mass == doctest::Approx(sharp.y / sharp.mass).epsilon(0.005));
    const double along = upwards ? blurred.spreadY() - sharp.spreadY() : blurred.spreadX() - sharp.spreadX();
    const double across = upwards ? blurred.spreadX() - sharp.spreadX() : blurred.spreadY() - sharp.spreadY();
    CHECK(along == doctest::Approx(24.0 * 24 / 12).epsilon(0.1));
    CHECK(std::abs(across) < 1.0);
  }
}

TEST_CASE(
    "motion blur reaches 15 pixels whatever the tiles, and no pixel is missed beside one that is reached") {
  // Five positions, so that the silhouette falls differently into the tiles. Along the row through the center darkness
  // falls off towards both ends; a tile that was missed would cut it off at a multiple of 16.
  for (int step = 0; step < 5; ++step) {
    Setup setup = scene({kGray});
    setup.balls[0].center.x = 0.4f * static_cast<float>(step);
    setup.balls[0].velocity = {speedOf(30), 0, 0};
    setup.sets.insert(setup.sets.end(), {{"shutter", "360"}, {"samples", "64"}});
    const Panels panels = panelsOf(setup);
    std::uint32_t edge = 0;
    while (edge < kWidth && panels.before(edge, kHeight / 2)[1] > 0.6) ++edge;
    REQUIRE(edge > 20);
    CAPTURE(edge);
    for (std::uint32_t out = 1; out < 13; ++out) {
      const double expected =
          0.8 * (15.0 - out) / 30;  // share of the shutter in which the sphere covers this pixel
      CHECK(std::abs(1 - panels.after(edge - out, kHeight / 2)[1] - expected) < 0.05);
    }
    CHECK(panels.after(edge - 18, kHeight / 2)[1] == 1);
  }
}

TEST_CASE("motion blur of one color is that color, whatever moves") {
  Setup setup = scene({{.center = {0, 0, 0}, .radius = 3, .velocity = {80, 30, 0}}});
  setup.orbitDegreesPerSecond = 90;
  const Panels panels = panelsOf(setup);
  double worst = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      worst = std::max(worst, std::abs(1.0 - panels.after(x, y)[1]) - std::abs(1.0 - panels.before(x, y)[1]));
  CHECK(worst < 2e-3);
}

TEST_CASE(
    "the sky's velocity under a turning camera is the difference of both projections of its direction") {
  Setup setup = scene({});
  setup.orbitDegreesPerSecond = 60;  // one degree per frame
  Lab lab(setup);
  lab.frame(0);
  lab.frame(1);
  const Panels panels{lab.read("panels")};
  const weft::scene::ViewData view = lab.viewAt(1);
  const glm::dmat4 now(view.view_projection), before(view.previous_view_projection),
      inverse = glm::inverse(now);
  double largest = 0;
  for (std::uint32_t y = 5; y < kHeight; y += 30)
    for (std::uint32_t x = 5; x < kWidth; x += 30) {
      const glm::dvec2 uv((x + 0.5) / kWidth, (y + 0.5) / kHeight);
      // A point of the ray, on the near plane, gives its direction.
      const glm::dvec4 near_point = inverse * glm::dvec4(uv * 2.0 - 1.0, 1, 1);
      const glm::dvec3 direction = glm::dvec3(near_point) / near_point.w - glm::dvec3(view.eye);
      const glm::dvec4 a = now * glm::dvec4(direction, 0), b = before * glm::dvec4(direction, 0);
      const glm::dvec2 expected = (glm::dvec2(a) / a.w - glm::dvec2(b) / b.w) * 0.5;
      CAPTURE(x);
      CAPTURE(y);
      CHECK(panels.velocity(x, y)[0] == doctest::Approx(expected.x).epsilon(2e-3));
      CHECK(std::abs(panels.velocity(x, y)[1] - expected.y) < 2e-5);
      largest = std::max(largest, std::abs(expected.x));
    }
  CHECK(largest * kWidth > 2);  // pixels: the test tests something
}

}  // namespace lens_motion_test
