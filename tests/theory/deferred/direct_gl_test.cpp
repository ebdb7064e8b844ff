// Light from one direction: Cook-Torrance and Blinn-Phong against their formulas in double precision, and what they add up to.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

namespace deferred_direct_test {

using namespace weft::theory;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kWidth = 96, kHeight = 64;
constexpr double kIrradiance[] = {2, 1, 0.5};
const double kAlbedo[] = {1, 0.21586050011, 0};  // steps 255, 128 and 0 of sRGB

Vec3 unit(Vec3 a) {
  const double length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

Setup floorUnderTheSun(const std::string& mro, const std::string& model) {
  Setup setup{.graph = "tests/theory/deferred/lighting.json"};
  setup.width = kWidth;
  setup.height = kHeight;
  setup.camera = {.position = {0, 3, 4}, .target = {0, 0, 0}, .fovDegrees = 50, .nearPlane = 0.1};
  setup.sets = {{"floor_mro", mro},
                {"floor_albedo", "[1, 0.2158605, 0]"},
                {"model", model},
                {"direction", "[0.3, 1, -0.8]"}};
  return setup;
}

// Calls check(pixel, N.L, N.V, N.H, V.H) for the floor's pixels that `every` picks.
template <class Check>
void forFloor(const Picture& panels, const Setup& setup, std::uint32_t every, const Check& check) {
  const Vec3 l = unit({0.3, 1, -0.8});
  int seen = 0;
  for (std::uint32_t i = 0; i < kWidth * kHeight; i += every) {
    const std::uint32_t x = i % kWidth, y = i / kWidth;
    const float* at = panels.at(kWidth + x, y);
    if (at[3] == 0) continue;
    const auto& eye = setup.camera.position;
    const Vec3 v = unit({eye.x - at[0], eye.y - at[1], eye.z - at[2]});
    const Vec3 h = unit({v.x + l.x, v.y + l.y, v.z + l.z});
    check(panels.at(x, y), l.y, v.y, h.y, dot(v, h));
    ++seen;
  }
  CHECK(seen > 30);
}

double lambda(double cosine, double alpha) {
  return (std::sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1) / 2;
}

}  // namespace

TEST_CASE(
    "Cook-Torrance under one sun is GGX, Smith, Schlick and the layers of the environment's light within 0.5 "
    "%") {
  double worst = 0;
  for (const int metallic : {0, 1})
    for (const int step : {51, 102, 204}) {  // of roughness, of 255
      const double roughness = step / 255.0, alpha = roughness * roughness;
      Setup setup = floorUnderTheSun(
          "[" + std::to_string(metallic) + ", " + std::to_string(roughness) + ", 1, 0]", "material");
      setup.sets.push_back({"angle", "0"});
      Lab lab(setup);
      lab.frame();
      forFloor(lab.read("panels"), setup, 149,
               [&](const float* color, double nl, double nv, double nh, double vh) {
                 const double d = nh * nh * (alpha * alpha - 1) + 1,
                              distribution = alpha * alpha / (kPi * d * d);
                 const double masking = 1 / (1 + lambda(nl, alpha) + lambda(nv, alpha));
                 const Albedo albedo = directionalAlbedo(nv, roughness, 200);
                 const double lost = 1 - albedo.sum();
                 for (int c = 0; c < 3; ++c) {
                   const double f0 = metallic ? kAlbedo[c] : 0.04;
                   const double single = f0 * albedo.scale + albedo.bias, average = f0 + (1 - f0) / 21;
                   const double multiple = single * average * lost / (1 - lost * average);
                   const double diffuse = metallic ? 0 : kAlbedo[c] * (1 - single - multiple);
                   const double fresnel = f0 + (1 - f0) * std::pow(1 - vh, 5);
                   const double truth =
                       kIrradiance[c] * nl *
                       (distribution * masking * fresnel / (4 * nl * nv) + (multiple + diffuse) / kPi);
                   // Halves in the table of the environment's light leave 5e-4 of what is lost between microfacets.
                   CHECK(std::abs(color[c] - truth) < 0.004 * truth + 5e-4);
                   worst = std::max(worst, std::abs(color[c] - truth) - 0.004 * truth);
                 }
               });
      CHECK(lab.reports() == "");
    }
  MESSAGE("worst difference beyond 0.4 %: ", worst);
}

TEST_CASE("a highlight of the sun is the mean of those of all points of its disc") {
  constexpr int kPoints = 600;
  const Vec3 l = unit({0.3, 1, -0.8}), across = unit({0.8, 0, 0.3}),
             along = {l.y * across.z - l.z * across.y, l.z * across.x - l.x * across.z,
                      l.x * across.y - l.y * across.x};
  for (const double angle : {0.53, 5.0})
    for (const int step : {13, 26, 51, 102}) {  // of roughness, of 255
      const double roughness = step / 255.0, alpha = roughness * roughness, radius = angle * kPi / 360;
      Setup setup = floorUnderTheSun("[1, " + std::to_string(roughness) + ", 1, 0]", "material");
      setup.sets.push_back({"angle", std::to_string(angle)});
      Lab lab(setup);
      lab.frame();
      const Picture panels = lab.read("panels");
      double off = 0, all = 0, sum = 0, most = 0, brightest = 0;
      for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
        const std::uint32_t x = i % kWidth, y = i / kWidth;
        const float* at = panels.at(kWidth + x, y);
        if (at[3] == 0) continue;
        const auto& eye = setup.camera.position;
        const Vec3 v = unit({eye.x - at[0], eye.y - at[1], eye.z - at[2]});
        double truth = 0;
        for (int k = 0; k < kPoints; ++k) {
          const double r = radius * std::sqrt((k + 0.5) / kPoints), turn = 2.39996323 * k,
                       a = r * std::cos(turn), b = r * std::sin(turn);
          const Vec3 to = unit({l.x + a * across.x + b * along.x, l.y + a * across.y + b * along.y,
                                l.z + a * across.z + b * along.z});
          const Vec3 h = unit({v.x + to.x, v.y + to.y, v.z + to.z});
          const double d = h.y * h.y * (alpha * alpha - 1) + 1,
                       masking = 1 / (1 + lambda(to.y, alpha) + lambda(v.y, alpha));
          truth += kIrradiance[0] * alpha * alpha / (kPi * d * d) * masking / (4 * v.y) / kPoints;
        }
        const double is = panels.at(x, y)[0];
        off += std::abs(is - truth);
        all += truth;
        sum += is;
        most = std::max(most, is);
        brightest = std::max(brightest, truth);
      }
      CHECK(lab.reports() == "");
      CAPTURE(angle);
      CAPTURE(roughness);
      MESSAGE("angle ", angle, ", roughness ", roughness, ": off ", off / all, ", light ", sum / all,
              ", peak ", most / brightest);
      CHECK(std::abs(sum / all - 1) < 0.12);
      CHECK(std::abs(most / brightest - 1) < 0.21);
      CHECK(off / all < 0.25);
    }
}

TEST_CASE(
    "Blinn-Phong under one sun is its formula within 0.5 %, for the materials that say so and for all") {
  double worst = 0;
  for (const int metallic : {0, 1})
    for (const bool by_material : {true, false}) {
      // Step 153 of 255 is the exponent 2^6. For all materials alike it comes from roughness: 2 / alpha^2 - 2.
      const double roughness = 102 / 255.0, exponent = by_material ? 64 : 2 / std::pow(roughness, 4) - 2;
      const Setup setup = floorUnderTheSun("[" + std::to_string(metallic) + ", " + std::to_string(roughness) +
                                               ", 1, " + (by_material ? "0.6" : "0") + "]",
                                           by_material ? "material" : "blinn_phong");
      Lab lab(setup);
      lab.frame();
      const double whole =
          (exponent + 2) * (exponent + 4) / (8 * kPi * (std::pow(2, -exponent / 2) + exponent));
      forFloor(lab.read("panels"), setup, 17, [&](const float* color, double nl, double, double nh, double) {
        for (int c = 0; c < 3; ++c) {
          const double specular = metallic ? kAlbedo[c] : 0.04;
          const double diffuse = metallic ? 0 : kAlbedo[c] * (1 - specular);
          const double truth =
              kIrradiance[c] * nl * (diffuse / kPi + specular * whole * std::pow(nh, exponent));
          CHECK(std::abs(color[c] - truth) <= 0.005 * truth);
          if (truth > 0) worst = std::max(worst, std::abs(color[c] / truth - 1));
        }
      });
    }
  MESSAGE("worst relative difference: ", worst);
}

TEST_CASE(
    "direct light from everywhere: Cook-Torrance loses and gains nothing, Blinn-Phong nothing from above and "
    "gains nowhere") {
  Setup setup{.graph = "tests/theory/deferred/brdf.json"};
  // All of ibl.json but the table.
  setup.disables = {"luminance_rows", "luminance_sum",     "brightest_spot", "cell_means",
                    "irradiance_map", "without_brightest", "rest_mips",      "specular_prefilter"};
  Lab lab(setup);
  lab.frame();
  const Picture sums = lab.read("sums");
  double worst = 0;
  for (std::uint32_t y = 0; y < 8; ++y)
    for (std::uint32_t x = 0; x < 8; ++x) {
      const float* sum = sums.at(x, y);
      CAPTURE(x);
      CAPTURE(y);
      CHECK(sum[0] == doctest::Approx(1).epsilon(0.01));
      CHECK(sum[2] == doctest::Approx(1).epsilon(0.01));
      CHECK(sum[1] < 1.01);
      CHECK(sum[3] < 1.01);
      if (x > 0) CHECK(sum[1] > sums.at(x - 1, y)[1]);  // less and less towards grazing angles
      if (x == 7) {
        CHECK(sum[1] == doctest::Approx(1).epsilon(0.01));
        CHECK(sum[3] == doctest::Approx(1).epsilon(0.01));
      }
      worst = std::max({worst, std::abs(sum[0] - 1.0), std::abs(sum[2] - 1.0)});
    }
  CHECK(lab.reports() == "");
  MESSAGE("Cook-Torrance: worst difference from 1: ", worst);
}

TEST_CASE("occlusion takes from the environment's light alone; emissive light is added") {
  Setup setup = floorUnderTheSun("[0, 1, 1, 0]", "material");
  setup.sets[3] = {"source", "none"};
  const auto render = [&](const char* name, const char* value) {
    Setup other = setup;
    other.balls = {{.center = {0, 1, 0}, .albedo = {0, 0, 0}, .metallic = 0, .roughness = 1}};
    other.sets.push_back({name, value});
    Lab lab(other);
    lab.frame();
    return lab.read("panels");
  };
  const Picture open = render("seen", "1"), half = render("seen", "0.5"),
                glowing = render("glow", "[0.5, 2, 0.25]");
  int floors = 0, balls = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float* at = open.at(kWidth + x, y);
      if (at[3] == 0) continue;
      const bool ball = std::abs(at[1]) > 1e-3;
      const float glow[] = {0.5f, 2, 0.25f};
      for (int c = 0; c < 3; ++c) {
        // Roughness 1: the occlusion of the lobe is nearly that of the hemisphere.
        if (!ball && c == 0) CHECK(half.at(x, y)[c] == doctest::Approx(0.5 * open.at(x, y)[c]).epsilon(0.02));
        if (ball) CHECK(glowing.at(x, y)[c] == doctest::Approx(open.at(x, y)[c] + glow[c]).epsilon(1e-4));
      }
      (ball ? balls : floors) += 1;
    }
  CHECK(floors > 2000);
  CHECK(balls > 300);

  // The sun does not care.
  setup.sets[3] = {"source", "sun"};
  const Picture lit = render("seen", "1"), lit_half = render("seen", "0.5");
  for (std::uint32_t x = 0; x < kWidth; ++x) CHECK(lit.at(x, 5)[0] == lit_half.at(x, 5)[0]);
}

}  // namespace deferred_direct_test
