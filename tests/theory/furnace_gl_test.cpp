// White furnace: in a constant white environment a surface of albedo 1 that loses nothing is invisible. Metals, every roughness, every
// angle; with compensation off they show the single-scattering albedo. Also: nothing but the roughness decides it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

using namespace weft::theory;

namespace {

constexpr std::uint32_t kSize = 96;

Setup oneBall(float roughness, float metallic, bool compensation) {
  Setup setup{.graph = "tests/theory/furnace.json", .width = kSize, .height = kSize};
  setup.balls = {{.metallic = metallic, .roughness = roughness}};
  setup.camera = {.position = {0, 0, 4}, .target = {0, 0, 0}, .fovDegrees = 40, .nearPlane = 0.1};
  setup.sets = {{"compensation", compensation ? "true" : "false"}};
  return setup;
}

// Cosine between the normal and the direction to the eye where the ray through a pixel's centre meets the unit sphere at
// the origin, seen from (0, 0, 4); negative when it misses.
double cosineAt(std::uint32_t x, std::uint32_t y) {
  const double slope = std::tan(20.0 * 3.14159265358979 / 180);
  const double sx = ((x + 0.5) / kSize * 2 - 1) * slope, sy = ((y + 0.5) / kSize * 2 - 1) * slope;
  const double length2 = sx * sx + sy * sy + 1, along = 4;  // -(origin . direction) with direction (sx, sy, -1)
  const double root2 = along * along - length2 * 15;
  if (root2 < 0) return -1;
  return std::sqrt(root2) / std::sqrt(length2);
}

struct Range {
  double low = 1e9, high = -1e9;
};

Range furnace(float roughness, float metallic, bool compensation) {
  Lab lab(oneBall(roughness, metallic, compensation));
  lab.frame();
  const Picture picture = lab.read("hdr");
  Range range;
  for (std::uint32_t y = 0; y < kSize; ++y)
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const float* texel = picture.at(x, y);
      if (texel[3] < 0.05f) continue;
      for (int c = 0; c < 3; ++c) {
        range.low = std::min<double>(range.low, texel[c] / texel[3]);
        range.high = std::max<double>(range.high, texel[c] / texel[3]);
      }
    }
  CHECK(lab.complaints() == "");
  return range;
}

}  // namespace

TEST_CASE("white furnace: compensated metals give 1 within 0.3 % from roughness 0 to 1") {
  for (const float roughness : {0.0f, 0.05f, 0.13f, 0.25f, 0.37f, 0.5f, 0.61f, 0.75f, 0.9f, 1.0f}) {
    const Range range = furnace(roughness, 1, true);
    CAPTURE(roughness);
    CHECK(range.low > 0.997);
    CHECK(range.high < 1.003);
  }
}

TEST_CASE("white furnace: compensated dielectrics neither lose nor gain") {
  for (const float roughness : {0.0f, 0.3f, 0.7f, 1.0f}) {
    const Range range = furnace(roughness, 0, true);
    CAPTURE(roughness);
    CHECK(range.low > 0.997);
    CHECK(range.high < 1.003);
  }
}

TEST_CASE("white furnace: without compensation metals show the directional albedo within 0.5 %") {
  double worst = 0;
  for (const float roughness : {0.1f, 0.3f, 0.45f, 0.6f, 0.8f, 1.0f}) {
    Lab lab(oneBall(roughness, 1, false));
    lab.frame();
    const Picture picture = lab.read("hdr");
    for (std::uint32_t x = kSize / 2; x < kSize; x += 3) {
      const float* texel = picture.at(x, kSize / 2);
      const double cosine = cosineAt(x, kSize / 2);
      if (texel[3] < 0.999f || cosine < 0.05) continue;
      const double truth = directionalAlbedo(cosine, roughness, 360).sum();
      worst = std::max(worst, std::abs(texel[0] / truth - 1));
      CAPTURE(roughness);
      CAPTURE(cosine);
      CHECK(texel[0] == doctest::Approx(truth).epsilon(0.005));
    }
  }
  MESSAGE("worst relative error ", worst);
}

TEST_CASE("white furnace: roughness 1 seen from above is 1 - ln 2") {
  Setup setup = oneBall(1, 1, false);
  setup.width = setup.height = 97;  // a pixel at the centre
  Lab lab(setup);
  lab.frame();
  const float value = lab.read("hdr").at(48, 48)[0];
  CHECK(value == doctest::Approx(1 - std::log(2.0)).epsilon(0.005));
}

TEST_CASE("a sphere's radiance does not depend on the resolution it is drawn at") {
  // Same roughness, sixteen times the pixels, same environment: the middle of the sphere shows the same.
  Setup setup = oneBall(0.02f, 1, true);
  setup.environment = constantEnvironment(0.25f, 0.5f, 2.0f);
  float value[2][3];
  for (int i = 0; i < 2; ++i) {
    setup.width = setup.height = i ? 388 : 97;
    Lab lab(setup);
    lab.frame();
    const Picture picture = lab.read("hdr");
    for (int c = 0; c < 3; ++c) value[i][c] = picture.at(picture.width / 2, picture.height / 2)[c];
  }
  for (int c = 0; c < 3; ++c) CHECK(value[0][c] == doctest::Approx(value[1][c]).epsilon(0.002));
}
