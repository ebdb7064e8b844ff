// Mirrors and nearly mirrors under a busy environment: closer to the supersampled picture with anti-aliasing
// by curvature than without, still white in a white furnace, in both draw modes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "tests/load_image.h"
#include "tests/theory/lab.h"

namespace specular_aa_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 128, kHeight = 64, kFine = 8;

// Noise in every texel and a sun a few texels wide.
std::shared_ptr<const weft::assets::ImageF> busyEnvironment() {
  auto image = std::make_shared<weft::assets::ImageF>();
  image->width = 1024;
  image->height = 512;
  image->channels = 4;
  std::mt19937 random(5);
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x) {
      const bool sun = std::abs(x - 700) < 6 && std::abs(y - 150) < 5;
      const float value = sun ? 40.0f : static_cast<float>(random() % 1024) / 512.0f;
      for (int c = 0; c < 3; ++c) image->texels.push_back(value);
      image->texels.push_back(1);
    }
  return image;
}

Setup mirrors(std::uint32_t scale, bool aa, const char* draw) {
  Setup setup{.graph = "tests/theory/draw_modes.json", .width = kWidth * scale, .height = kHeight * scale};
  setup.sets = {{"specular_aa", aa ? "true" : "false"}, {"draw", draw}, {"subdivision", "6"}};
  setup.camera = {.position = {0, 0, 10}, .target = {0, 0, 0}, .fovDegrees = 45, .nearPlane = 0.1};
  float x = -6;
  for (const float roughness : {0.0f, 0.03f, 0.1f, 0.2f, 0.26f}) {
    setup.balls.push_back({.center = {x, 1, 0}, .radius = 1.2f, .roughness = roughness});
    setup.balls.push_back({.center = {x, -2.2f, 0}, .radius = 0.8f, .roughness = roughness});
    x += 3;
  }
  setup.environment = busyEnvironment();
  return setup;
}

Picture draw(const Setup& setup) {
  Lab lab(setup);
  lab.frame();
  Picture panels = lab.read("panels");
  CHECK(lab.reports() == "");
  return panels;
}

bool isInside(const Picture& panels, std::uint32_t width, int x, int y) {
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      const int u = std::clamp(x + i, 0, static_cast<int>(width) - 1),
                v = std::clamp(y + j, 0, static_cast<int>(panels.height) - 1);
      if (panels.at(3 * width + static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v))[0] == 0)
        return false;
    }
  return true;
}

// As seen after a tone curve, so that the sun does not decide alone.
double shown(double radiance) {
  return radiance / (1 + radiance);
}

double errorAgainst(const Picture& fine, const Picture& panels) {
  double sum = 0;
  int count = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (!isInside(panels, kWidth, static_cast<int>(x), static_cast<int>(y))) continue;
      double mean = 0;
      for (std::uint32_t j = 0; j < kFine; ++j)
        for (std::uint32_t i = 0; i < kFine; ++i)
          mean += static_cast<double>(fine.at(x * kFine + i, y * kFine + j)[0]);
      mean /= kFine * kFine;
      const double error = shown(static_cast<double>(panels.at(x, y)[0])) - shown(mean);
      sum += error * error;
      ++count;
    }
  REQUIRE(count > 300);
  return std::sqrt(sum / count);
}

void compare(Setup (*setup)(std::uint32_t, bool, const char*), double factor) {
  const Picture fine = draw(setup(kFine, false, "billboard"));
  for (const char* mode : {"billboard", "icosphere"}) {
    const double with = errorAgainst(fine, draw(setup(1, true, mode))),
                 without = errorAgainst(fine, draw(setup(1, false, mode)));
    MESSAGE(std::string(mode), ": RMS error with anti-aliasing ", with, ", without ", without);
    CHECK(with < factor * without);
  }
}

}  // namespace

TEST_CASE(
    "specular anti-aliasing: less than half the error against 64 samples a pixel, under noise and a small "
    "sun") {
  compare(mirrors, 0.5);
}

TEST_CASE("specular anti-aliasing: less error on a photographed environment") {
  compare(
      [](std::uint32_t scale, bool aa, const char* mode) {
        Setup setup = mirrors(scale, aa, mode);
        weft::text::Diagnostics said;
        auto image = weft::assets::loadEnvironment(
            WEFT_SOURCE_DIR "/scenes/environments/spiaggia_di_mondello_1k.hdr", said);
        REQUIRE(image);
        setup.environment = std::make_shared<const weft::assets::ImageF>(std::move(*image));
        return setup;
      },
      0.7);
}

TEST_CASE("specular anti-aliasing: a white furnace stays white within 0.3 %, however small the spheres") {
  for (const char* mode : {"billboard", "icosphere"}) {
    Setup setup = mirrors(2, true, mode);
    setup.environment = nullptr;
    const Picture panels = draw(setup);
    double worst = 0;
    for (std::uint32_t y = 0; y < setup.height; ++y)
      for (std::uint32_t x = 0; x < setup.width; ++x)
        if (isInside(panels, setup.width, static_cast<int>(x), static_cast<int>(y)))
          worst = std::max(worst, std::abs(static_cast<double>(panels.at(x, y)[0]) - 1));
    CAPTURE(mode);
    CHECK(worst < 0.003);
  }
}

}  // namespace specular_aa_test
