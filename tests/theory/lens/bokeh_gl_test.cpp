// Points of light and highlights through the depth of field: a disc without hole, dots or ring, of the lens's radius, that keeps the light.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/theory/lab.h"

namespace lens_bokeh_test {

using namespace weft::theory;

TEST_CASE(
    "focus: a point of light in the near and in the far field is a disc without hole, dots or ring, of the "
    "lens's "
    "radius") {
  constexpr std::uint32_t kWide = 384, kHigh = 384;
  struct Disc {
    double light = 0, radius = 0, least = 1e9, greatest = 0, mean = 0;
  };
  const auto discOf = [&](double coc, bool before, int x, int y, const char* largest = "128", int side = 2) {
    // A lens for which the plane, 10 before or 40 behind a focus at 20, has that disc: f^2 / (N (s - f)) |1 -
    // s / d| on a sensor of 24 mm.
    const double distance = before ? 12 : 60, focus = 20, f = 0.95 * std::sqrt(coc / 120);
    const double aperture = f * f / (focus - f) * std::abs(1 - focus / distance) / (2 * coc * 0.024 / kHigh);
    Setup setup{.graph = "tests/theory/impulse.json", .width = kWide, .height = kHigh};
    setup.sets = {{"dof", "true"},
                  {"bloom", "false"},
                  {"focal_length", std::to_string(1000 * f)},
                  {"aperture", std::to_string(aperture)},
                  {"focus_distance", "20"},
                  {"largest_bokeh", largest},
                  {"plane.distance", std::to_string(distance)},
                  {"plane.background", "0"},
                  {"plane.value", "4000"},
                  {"plane.side", std::to_string(side)},
                  {"plane.at", "[" + std::to_string(x) + ", " + std::to_string(y) + "]"}};
    Lab lab(setup);
    lab.frame(0);
    const Picture panels = lab.read("panels");
    CHECK(lab.reports() == "");
    Disc disc;
    double r2 = 0, cx = 0, cy = 0;
    const auto value = [&](std::uint32_t px, std::uint32_t py) {
      return static_cast<double>(panels.at(kWide + px, py)[1]);
    };
    for (std::uint32_t py = 0; py < kHigh; ++py)
      for (std::uint32_t px = 0; px < kWide; ++px) {
        disc.light += value(px, py);
        cx += value(px, py) * px;
        cy += value(px, py) * py;
      }
    cx /= disc.light;
    cy /= disc.light;
    int count = 0;
    for (std::uint32_t py = 0; py < kHigh; ++py)
      for (std::uint32_t px = 0; px < kWide; ++px) {
        const double d2 = (px - cx) * (px - cx) + (py - cy) * (py - cy);
        r2 += value(px, py) * d2 / disc.light;
        if (d2 > 0.64 * coc * coc) continue;
        disc.least = std::min(disc.least, value(px, py));
        disc.greatest = std::max(disc.greatest, value(px, py));
        disc.mean += value(px, py);
        ++count;
      }
    disc.mean /= count;
    disc.light /= 16000;
    disc.radius = std::sqrt(2 * r2);
    return disc;
  };
  for (const bool before : {false, true})
    for (const double coc : {4.0, 5.8, 8.0, 13.0, 21.0, 32.0, 50.0, 80.0, 120.0}) {
      const Disc disc = discOf(coc, before, 190, 186);
      CAPTURE(before);
      CAPTURE(coc);
      MESSAGE("light ", disc.light, ", radius ", disc.radius, ", least ", disc.least / disc.mean,
              ", greatest ", disc.greatest / disc.mean);
      // Within 0.8 of the radius. Discs of a few pixels are domes, because of the half size.
      CHECK(disc.light == doctest::Approx(1).epsilon(0.01));
      CHECK(disc.radius == doctest::Approx(coc).epsilon(0.06));
      CHECK(disc.least > 0.6 * disc.mean);
      CHECK(disc.greatest < (coc < 8 ? 1.65 : 1.4) * disc.mean);
    }
  // A highlight of a few pixels, with as many samples as the default has.
  for (const int side : {4, 8, 12})
    for (const double coc : {24.0, 30.0, 31.0}) {
      const Disc disc = discOf(coc, true, 190, 186, "32", side);
      CAPTURE(side);
      CAPTURE(coc);
      CHECK(disc.least > 0.8 * disc.mean);
      CHECK(disc.greatest < 1.2 * disc.mean);
    }
  // A point of two, wherever it lies on the texels of the half size.
  for (const int at : {186, 187, 188, 189}) {
    const Disc disc = discOf(31, true, at, 183 + 3 * at % 4, "32");
    CAPTURE(at);
    CHECK(disc.least > 0.8 * disc.mean);
    CHECK(disc.greatest < 1.2 * disc.mean);
  }
}

// Each of the brightest texels of a small square becomes a disc. Their sum goes beyond half floats; here the picture has floats, which show it.
TEST_CASE("focus: highlights that overlap are as bright as a half float can be, and no brighter") {
  constexpr std::uint32_t kSize = 256;
  for (const bool before : {false, true})
    for (const int side : {6, 10}) {
      constexpr double coc = 3.2;
      const double distance = before ? 12 : 60, focus = 20, f = 0.95 * std::sqrt(coc / 120);
      const double aperture =
          f * f / (focus - f) * std::abs(1 - focus / distance) / (2 * coc * 0.024 / kSize);
      Setup setup{.graph = "tests/theory/impulse_wide.json", .width = kSize, .height = kSize};
      setup.sets = {{"dof", "true"},
                    {"bloom", "false"},
                    {"focal_length", std::to_string(1000 * f)},
                    {"aperture", std::to_string(aperture)},
                    {"focus_distance", "20"},
                    {"plane.distance", std::to_string(distance)},
                    {"plane.background", "0"},
                    {"plane.value", "65504"},
                    {"plane.side", std::to_string(side)},
                    {"plane.at", "[60, 60]"}};
      Lab lab(setup);
      lab.frame(0);
      const Picture panels = lab.read("panels");
      CHECK(lab.reports() == "");
      double greatest = 0;
      bool finite = true;
      for (std::uint32_t y = 0; y < kSize; ++y)
        for (std::uint32_t x = kSize; x < 2 * kSize; ++x)
          for (int c = 0; c < 3; ++c) {
            const double value = double(panels.at(x, y)[c]);
            finite = finite && std::isfinite(value);
            greatest = std::max(greatest, value);
          }
      CAPTURE(before);
      CAPTURE(side);
      MESSAGE("greatest ", greatest);
      CHECK(finite);
      CHECK(greatest > 5000);
      CHECK(greatest <= 65504);
    }
}

}  // namespace lens_bokeh_test
