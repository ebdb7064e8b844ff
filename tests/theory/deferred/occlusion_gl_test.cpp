// Ambient occlusion against closed forms: a plane sees everything, a sphere that touches the floor takes a cap of the sky away, whose
// share, weighted by the cosine, is sin^2 of its half angle times the sine of its elevation.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "tests/theory/lab.h"

namespace deferred_occlusion_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 320, kHeight = 240;
constexpr double kElevations[] = {5, 10, 15, 20, 30, 45, 60, 85};  // degrees, of the camera

Setup scene(double elevation, const char* method) {
  Setup setup{.graph = "tests/theory/deferred/occlusion.json"};
  setup.width = kWidth;
  setup.height = kHeight;
  const double up = elevation * std::numbers::pi / 180;
  setup.camera = {.position = {0, 0.5 + 9 * std::sin(up), 9 * std::cos(up)},
                  .target = {0, 0.5, 0},
                  .fovDegrees = 45,
                  .nearPlane = 0.1};
  setup.sets = {{"ao_method", method}, {"ao_radius", "20"}};
  return setup;
}

struct Errors {
  double low = 0, high = 0, sum = 0;
  int count = 0;
};

// Differences from the closed form of the points of the floor whose distance from where the sphere of radius 1 stands, and whose azimuth
// (degrees; 0 is beside the sphere, 90 before it) lie in these bounds.
Errors errorsOf(const Picture& panels, double nearest, double azimuth_low, double azimuth_high) {
  Errors errors;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float* at = panels.at(kWidth + x, y);
      if (at[3] == 0 || std::abs(at[1]) > 1e-3) continue;
      const double distance = std::hypot(at[0], at[2]);
      const double azimuth = std::atan2(at[2], std::abs(at[0])) * 180 / std::numbers::pi;
      if (distance < nearest || distance > 4 || azimuth < azimuth_low || azimuth > azimuth_high) continue;
      const double error = panels.at(x, y)[0] - (1 - std::pow(1 + distance * distance, -1.5));
      errors.low = std::min(errors.low, error);
      errors.high = std::max(errors.high, error);
      errors.sum += std::abs(error);
      ++errors.count;
    }
  return errors;
}

Picture render(const Setup& setup) {
  Lab lab(setup);
  lab.frame();
  CHECK(lab.reports() == "");
  return lab.read("panels");
}

}  // namespace

TEST_CASE("ambient occlusion: a plane is 1, to the bit, from every angle, by both methods") {
  for (const char* method : {"horizon", "hemisphere"})
    for (const double elevation : kElevations) {
      CAPTURE(method);
      CAPTURE(elevation);
      const Picture panels = render(scene(elevation, method));
      int floors = 0, darker = 0;
      for (std::uint32_t y = 0; y < kHeight; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x) {
          floors += panels.at(kWidth + x, y)[3] != 0;
          darker += panels.at(x, y)[0] != 1;
        }
      CHECK(floors > 20000);
      CHECK(darker == 0);
    }
}

TEST_CASE("ambient occlusion: the floor beside a sphere is within 0.05 of the closed form") {
  for (const double elevation : kElevations) {
    Setup setup = scene(elevation, "horizon");
    setup.balls = {{.center = {0, 1, 0}}};
    const Picture panels = render(setup);
    const Errors front = errorsOf(panels, 1.25, 22.5, 90), side = errorsOf(panels, 2, -22.5, 22.5);
    CAPTURE(elevation);
    CHECK(front.count > (elevation < 15 ? 6000 : 12000));
    CHECK(side.count > (elevation < 15 ? 1400 : 3000));
    CHECK(front.low > -0.05);
    CHECK(front.high < 0.05);
    CHECK(side.low > -0.05);
    CHECK(side.high < 0.05);
    const double means[] = {front.sum / front.count, side.sum / side.count};
    MESSAGE(elevation, " degrees: before the sphere ", front.low, " to ", front.high, ", mean ", means[0],
            " of ", front.count, "; beside it ", side.low, " to ", side.high, ", mean ", means[1], " of ",
            side.count);
  }
}

TEST_CASE(
    "ambient occlusion: without back faces all behind a sphere is filled, which is dark from low angles and "
    "nearly the same from above") {
  for (const double elevation : {10.0, 60.0}) {
    double means[2];
    for (const bool known : {false, true}) {
      Setup setup = scene(elevation, "horizon");
      setup.balls = {{.center = {0, 1, 0}}};
      setup.sets.push_back({"known_backs", known ? "true" : "false"});
      const Errors side = errorsOf(render(setup), 2, -22.5, 22.5);
      means[known] = side.sum / side.count;
      if (!known) CHECK((side.low < -0.06) == (elevation < 30));
    }
    CHECK(means[1] < 0.01);
    CHECK((means[0] > 2 * means[1]) == (elevation < 30));
    MESSAGE(elevation, " degrees: mean difference ", means[0], " without and ", means[1], " with back faces");
  }
}

TEST_CASE("ambient occlusion: more slices and steps come closer") {
  Errors errors[2];
  for (int i = 0; i < 2; ++i) {
    Setup setup = scene(30, "horizon");
    setup.balls = {{.center = {0, 1, 0}}};
    setup.sets.push_back({"ao_slices", i == 0 ? "2" : "4"});
    setup.sets.push_back({"ao_steps", i == 0 ? "8" : "32"});
    errors[i] = errorsOf(render(setup), 1.25, 45, 90);
  }
  CHECK(errors[1].sum / errors[1].count < 0.2 * errors[0].sum / errors[0].count);
  CHECK(errors[1].low > -0.025);
  CHECK(errors[1].high < 0.01);
  const double means[] = {errors[0].sum / errors[0].count, errors[1].sum / errors[1].count};
  MESSAGE("mean difference ", means[0], ", then ", means[1], ", worst ", errors[1].low, " ", errors[1].high);
}

TEST_CASE("ambient occlusion: points in hemispheres find what horizons find, fainter") {
  Setup setup = scene(45, "hemisphere");
  setup.sets = {{"ao_method", "hemisphere"}, {"ao_radius", "3"}};
  setup.balls = {{.center = {0, 1, 0}}};
  const Picture panels = render(setup);
  const Errors near = errorsOf(panels, 1.25, 22.5, 90), far = errorsOf(panels, 3, 22.5, 90);
  CHECK(near.low > -0.01);  // never darker than the closed form
  CHECK(near.high < 0.25);
  CHECK(far.high < 0.06);
  double contact = 1;  // where the sphere touches the floor it is dark
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float* at = panels.at(kWidth + x, y);
      if (at[3] != 0 && std::abs(at[1]) < 1e-3 && std::hypot(at[0], at[2]) < 0.8)
        contact = std::min<double>(contact, panels.at(x, y)[0]);
    }
  CHECK(contact < 0.75);
  MESSAGE("from ", near.low, " to ", near.high, " and ", far.high, "; at the sphere's foot ", contact);
}

TEST_CASE(
    "ambient occlusion: no halo on what lies far behind, and a near edge stays bright before a dark place") {
  for (const char* method : {"horizon", "hemisphere"}) {
    Setup setup = scene(45, method);
    setup.sets = {{"ao_method", method}, {"ao_radius", "1"}};
    setup.balls = {{.center = {0, 4, 2}}};  // 4 above the floor, further than the radius
    const Picture panels = render(setup);
    int floors = 0, darker = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const float* at = panels.at(kWidth + x, y);
        floors += at[3] != 0 && std::abs(at[1]) < 1e-3;
        darker += panels.at(x, y)[0] < 0.99f;
      }
    CAPTURE(method);
    CHECK(floors > 20000);
    CHECK(darker == 0);
  }
  // A small sphere in the air before the dark place under a large one.
  Setup setup = scene(45, "horizon");
  setup.sets = {{"ao_method", "horizon"}, {"ao_radius", "1"}};
  setup.balls = {{.center = {0, 1, 0}}, {.center = {0, 3.1f, 3.5f}, .radius = 0.4f}};
  const Picture panels = render(setup);
  int small = 0, faded = 0, dark_beside = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x + 1 < kWidth; ++x) {
      const auto of_small = [&](std::uint32_t column) {
        const float* at = panels.at(kWidth + column, y);
        return at[3] != 0 && std::hypot(at[0], at[1] - 3.1f, at[2] - 3.5f) < 0.401f;
      };
      small += of_small(x);
      faded += of_small(x) && panels.at(x, y)[0] < 0.99f;
      dark_beside += of_small(x) && !of_small(x + 1) && panels.at(x + 1, y)[0] < 0.9f;
    }
  CHECK(small > 200);
  CHECK(faded == 0);
  CHECK(dark_beside > 3);
}

}  // namespace deferred_occlusion_test
