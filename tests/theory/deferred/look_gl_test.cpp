// Bloom by one Gaussian, and dots: what they keep.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "tests/theory/lab.h"

namespace deferred_look_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 384, kHeight = 256;

// The picture after the composite, whose curve is linear and whose white is 32.
Picture render(const char* graph, const char* bloom, const std::string& width) {
  Setup setup{.graph = graph, .width = kWidth, .height = kHeight};
  setup.sets = {{"bloom", bloom},     {"bloom_strength", "1"},    {"threshold", "0"},
                {"firefly", "false"}, {"plane.at", "[190, 130]"}, {"plane.value", "2000"}};
  if (!width.empty()) setup.sets.push_back({"bloom_width", width});
  Lab lab(setup);
  lab.frame();
  CHECK(lab.reports() == "");
  return lab.read("panels");
}

double lightAt(const Picture& panels, std::uint32_t x, std::uint32_t y) {
  const double c = panels.at(2 * kWidth + x, y)[1];
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

TEST_CASE("Gaussian bloom: a point becomes a Gaussian as wide as it says, and loses nothing") {
  for (const double sigma : {4.0, 8.0, 16.0}) {  // pixels
    const Picture panels =
        render("tests/theory/deferred/gaussian.json", "true", std::to_string(sigma / kHeight));
    double sum = 0, x1 = 0, y1 = 0, x2 = 0, y2 = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const double light = lightAt(panels, x, y);
        sum += light;
        x1 += light * x;
        y1 += light * y;
        x2 += light * x * x;
        y2 += light * y * y;
      }
    const double across = std::sqrt(x2 / sum - x1 / sum * x1 / sum),
                 along = std::sqrt(y2 / sum - y1 / sum * y1 / sum);
    MESSAGE("standard deviation ", sigma, ": ", across, " across, ", along, " along, sum ", sum * 32 / 2000);
    // Halving and enlarging add about a pixel of variance; three standard deviations hold 98.7 % of it.
    CHECK(std::abs(across * across - sigma * sigma) < 0.03 * sigma * sigma + 1.5);
    CHECK(std::abs(along * along - sigma * sigma) < 0.03 * sigma * sigma + 1.5);
    CHECK(sum * 32 == doctest::Approx(2000).epsilon(0.01));
  }
}

TEST_CASE(
    "Gaussian bloom takes the pyramid's place: the same slots, another glow, and off the same picture") {
  const char* pyramid = "tests/theory/impulse_exact.json";
  const char* gaussian = "tests/theory/deferred/gaussian.json";
  const Picture off[] = {render(pyramid, "false", ""), render(gaussian, "false", "")};
  const Picture on[] = {render(pyramid, "true", ""), render(gaussian, "true", "")};
  int different_off = 0, different_on = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      different_off += lightAt(off[0], x, y) != lightAt(off[1], x, y);
      different_on += lightAt(on[0], x, y) != lightAt(on[1], x, y);
    }
  CHECK(different_off == 0);
  CHECK(different_on > 1000);
}

TEST_CASE("dots: only 0 and 1, and every 4 x 4 of them as bright as the gray within 1/32") {
  for (const double gray : {0.0, 0.02, 0.1, 0.2159, 0.33, 0.5, 0.77, 0.97, 1.0})
    for (const char* color : {"false", "true"}) {
      Setup setup{.graph = "tests/theory/deferred/bayer.json", .width = 32, .height = 32};
      setup.sets = {{"light", "[" + std::to_string(gray) + ", " + std::to_string(gray) + ", " +
                                  std::to_string(gray) + "]"},
                    {"bayer_color", color}};
      Lab lab(setup);
      lab.frame();
      const Picture shown = lab.read("shown");
      for (std::uint32_t y = 0; y + 4 <= 32; y += 3)
        for (std::uint32_t x = 0; x + 4 <= 32; x += 3) {
          double mean = 0;
          for (std::uint32_t i = 0; i < 16; ++i) {
            const float bit = shown.at(x + i % 4, y + i / 4)[1];
            CHECK((bit == 0 || bit == 1));
            mean += bit / 16.0;
          }
          CHECK(std::abs(mean - gray) <= 1.0 / 32 + 1e-5);
        }
      CHECK(lab.reports() == "");
    }
}

TEST_CASE("dots of several pixels are the small ones, enlarged; by channels there are eight colors") {
  const auto dots = [](const char* pixel, const char* color) {
    Setup setup{.graph = "tests/theory/deferred/bayer.json", .width = 48, .height = 48};
    setup.sets = {{"light", "[0.7, 0.3, 0.1]"}, {"bayer_pixel", pixel}, {"bayer_color", color}};
    Lab lab(setup);
    lab.frame();
    return lab.read("shown");
  };
  const Picture small = dots("1", "true"), large = dots("3", "true"), gray = dots("1", "false");
  double means[3] = {};
  for (std::uint32_t y = 0; y < 48; ++y)
    for (std::uint32_t x = 0; x < 48; ++x)
      for (int c = 0; c < 3; ++c) {
        CHECK(large.at(x, y)[c] == small.at(x / 3, y / 3)[c]);
        CHECK(gray.at(x, y)[c] == gray.at(x, y)[0]);
        means[c] += small.at(x, y)[c] / (48.0 * 48);
      }
  CHECK(std::abs(means[0] - 0.7) <= 1.0 / 32);
  CHECK(std::abs(means[1] - 0.3) <= 1.0 / 32);
  CHECK(std::abs(means[2] - 0.1) <= 1.0 / 32);
}

}  // namespace deferred_look_test
