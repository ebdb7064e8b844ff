// White furnace: in a constant white environment a surface of albedo 1 that loses nothing is invisible. Metals, every roughness, every
// angle; with compensation off they show the single-scattering albedo. Also: resolution decides nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

namespace furnace_test {

using namespace weft::theory;

namespace {

constexpr double kDistance = 30, kFov = 6;

// Unit spheres along x, one per roughness, seen from far away on the z axis.
Setup row(std::initializer_list<float> roughnesses, float metallic, bool compensation) {
  Setup setup{.graph = "tests/theory/furnace.json"};
  setup.height = 96;
  setup.width = 96 * static_cast<std::uint32_t>(roughnesses.size());
  float x = -1.5f * (static_cast<float>(roughnesses.size()) - 1);
  for (const float roughness : roughnesses) {
    setup.balls.push_back({.center = {x, 0, 0}, .metallic = metallic, .roughness = roughness});
    x += 3;
  }
  setup.camera = {.position = {0, 0, kDistance}, .target = {0, 0, 0}, .fovDegrees = kFov, .nearPlane = 0.1};
  setup.sets = {{"compensation", compensation ? "true" : "false"}};
  return setup;
}

// What the ray through a pixel's center meets: the ball and the cosine between its normal and the ray; ball -1: nothing.
struct Hit {
  int ball = -1;
  double cosine = 0;
};

Hit hitAt(const Setup& setup, std::uint32_t x, std::uint32_t y) {
  const double slope = std::tan(kFov * std::numbers::pi / 360), aspect = double(setup.width) / setup.height;
  const Vec3 ray{((x + 0.5) / setup.width * 2 - 1) * slope * aspect,
                 ((y + 0.5) / setup.height * 2 - 1) * slope, -1};
  for (std::size_t i = 0; i < setup.balls.size(); ++i) {
    const Vec3 to{setup.balls[i].center.x, 0, -kDistance};
    const double along = dot(to, ray), root2 = along * along - dot(ray, ray) * (dot(to, to) - 1);
    if (root2 >= 0) return {static_cast<int>(i), std::sqrt(root2 / dot(ray, ray))};
  }
  return {};
}

struct Range {
  double low = 1e9, high = -1e9;
};

// The unpremultiplied radiance of each ball.
std::vector<Range> rangesOf(const Setup& setup) {
  Lab lab(setup);
  lab.frame();
  const Picture picture = lab.read("hdr");
  std::vector<Range> ranges(setup.balls.size());
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const float* texel = picture.at(x, y);
      if (texel[3] < 0.05f) continue;
      Range& range = ranges[x * setup.balls.size() / picture.width];
      for (int c = 0; c < 3; ++c) {
        range.low = std::min<double>(range.low, texel[c] / texel[3]);
        range.high = std::max<double>(range.high, texel[c] / texel[3]);
      }
    }
  CHECK(lab.reports() == "");
  return ranges;
}

void checkInvisible(const Setup& setup) {
  const std::vector<Range> ranges = rangesOf(setup);
  double worst = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    CAPTURE(setup.balls[i].roughness);
    CHECK(ranges[i].low > 0.9993);
    CHECK(ranges[i].high < 1.0007);
    worst = std::max({worst, 1 - ranges[i].low, ranges[i].high - 1});
  }
  MESSAGE("worst difference from 1: ", worst);
}

}  // namespace

TEST_CASE("white furnace: compensated metals give 1 within 0.3 % from roughness 0 to 1") {
  checkInvisible(
      row({0.0f, 0.03f, 0.1f, 0.2f, 0.25f, 0.37f, 0.5f, 0.61f, 0.75f, 0.9f, 0.97f, 1.0f}, 1, true));
}

TEST_CASE("white furnace: compensated dielectrics neither lose nor gain") {
  checkInvisible(row({0.0f, 0.3f, 0.7f, 1.0f}, 0, true));
}

TEST_CASE("white furnace: a partial metal is the mix of metal and dielectric, within 0.5 %") {
  for (const float roughness : {0.1f, 0.6f}) {
    std::vector<Picture> pictures;
    for (const float metallic : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
      Setup setup = row({roughness}, metallic, true);
      setup.balls[0].albedo = glm::vec3(0.8f, 0.5f, 0.2f);
      Lab lab(setup);
      lab.frame();
      pictures.push_back(lab.read("hdr"));
      CHECK(lab.reports() == "");
    }
    double worst = 0;
    int seen = 0;
    for (std::uint32_t y = 0; y < 96; ++y)
      for (std::uint32_t x = 0; x < 96; ++x) {
        if (pictures[0].at(x, y)[3] < 0.999f) continue;
        ++seen;
        for (std::size_t i = 1; i < 4; ++i)
          for (int c = 0; c < 3; ++c) {
            const double ends[] = {pictures[0].at(x, y)[c], pictures[4].at(x, y)[c]};
            const double mix = ends[0] + 0.25 * static_cast<double>(i) * (ends[1] - ends[0]);
            worst = std::max(worst, std::abs(pictures[i].at(x, y)[c] / mix - 1));
          }
      }
    CAPTURE(roughness);
    CHECK(seen > 2000);
    MESSAGE("worst difference from the mix: ", worst);
    CHECK(worst < 0.001);
  }
}

TEST_CASE("white furnace: without compensation metals show the directional albedo within 0.5 %") {
  const Setup setup = row({0.05f, 0.1f, 0.2f, 0.3f, 0.45f, 0.6f, 0.8f, 0.95f, 1.0f}, 1, false);
  Lab lab(setup);
  lab.frame();
  const Picture picture = lab.read("hdr");
  double worst = 0;
  int seen = 0;
  for (std::uint32_t x = 0; x < picture.width; x += 5) {
    const float* texel = picture.at(x, picture.height / 2);
    const Hit hit = hitAt(setup, x, picture.height / 2);
    if (hit.ball < 0 || texel[3] < 0.999f) continue;
    const float roughness = setup.balls[static_cast<std::size_t>(hit.ball)].roughness;
    const double truth = directionalAlbedo(hit.cosine, roughness, 360).sum();
    CAPTURE(roughness);
    CAPTURE(hit.cosine);
    CHECK(texel[0] == doctest::Approx(truth).epsilon(0.005));
    worst = std::max(worst, std::abs(texel[0] / truth - 1));
    ++seen;
  }
  CHECK(seen > 90);
  MESSAGE("worst relative error ", worst);
}

TEST_CASE("white furnace: roughness 1 seen from above is 1 - ln 2") {
  Setup setup = row({1.0f}, 1, false);
  setup.width = setup.height = 97;  // a pixel at the center
  Lab lab(setup);
  lab.frame();
  CHECK(lab.read("hdr").at(48, 48)[0] == doctest::Approx(1 - std::numbers::ln2).epsilon(0.005));
}

TEST_CASE("a sphere's radiance does not depend on the resolution it is drawn at") {
  float value[2][3];
  for (int i = 0; i < 2; ++i) {
    Setup setup = row({0.02f}, 1, true);
    setup.environment = constantEnvironment(0.25f, 0.5f, 2.0f);
    setup.width = setup.height = i ? 388 : 97;
    Lab lab(setup);
    lab.frame();
    const Picture picture = lab.read("hdr");
    for (int c = 0; c < 3; ++c) value[i][c] = picture.at(picture.width / 2, picture.height / 2)[c];
  }
  for (int c = 0; c < 3; ++c) CHECK(value[0][c] == doctest::Approx(value[1][c]).epsilon(0.002));
}

}  // namespace furnace_test
