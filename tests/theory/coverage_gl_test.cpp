// The sphere layer's alpha sums to the area of the projected sphere, and the eye may be anywhere.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

namespace coverage_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 480, kHeight = 360;

struct Sum {
  double alpha = 0;
  double border = 0;  // alpha on the picture's rim
  bool finite = true;
};

Sum sumOf(const Picture& picture) {
  Sum sum;
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const float* texel = picture.at(x, y);
      sum.alpha += texel[3];
      for (int c = 0; c < 4; ++c) sum.finite = sum.finite && std::isfinite(texel[c]) && texel[c] >= 0;
      if (x == 0 || y == 0 || x + 1 == picture.width || y + 1 == picture.height) sum.border += texel[3];
    }
  return sum;
}

Setup scene(std::vector<Ball> balls, double fov) {
  Setup setup{
      .graph = "tests/theory/coverage.json", .width = kWidth, .height = kHeight, .balls = std::move(balls)};
  setup.camera = {.position = {0, 0, 0}, .target = {0, 0, -1}, .fovDegrees = fov, .nearPlane = 0.1};
  return setup;
}

}  // namespace

TEST_CASE("coverage: alpha sums to the projected area within 0.2 %") {
  struct Case {
    double x, y, z, radius, fov;
  };
  // Centered, towards the corners (strongly stretched), close, and down to a few pixels.
  const Case cases[] = {{0, 0, 20, 1, 60},        {0.013, 0.02, 20, 1, 60}, {9, 6, 20, 1, 60},
                        {6, -5, 14, 1, 60},       {0.1, 0.2, 1.8, 1, 90},   {2.5, 1.2, 3.5, 1, 100},
                        {5, -3.9, 5.2, 0.7, 120}, {0.31, 0.7, 60, 1, 60},   {-11.3, 7.1, 100, 1, 60},
                        {100, 50, 2000, 40, 60}};
  double worst = 0;
  for (const Case& c : cases) {
    const Ball ball{.center = {c.x, c.y, -c.z}, .radius = static_cast<float>(c.radius)};
    Lab lab(scene({ball}, c.fov));
    lab.frame();
    const Sum sum = sumOf(lab.read("hdr"));
    const double f = kHeight / 2.0 / std::tan(c.fov * std::numbers::pi / 360);
    const double area = projectedSphereArea(f, c.radius, std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z), c.z);
    CAPTURE(c.x);
    CAPTURE(c.z);
    CAPTURE(area);
    REQUIRE(sum.border == 0);  // wholly in frame
    CHECK(sum.finite);
    CHECK(sum.alpha == doctest::Approx(area).epsilon(0.002));
    worst = std::max(worst, std::abs(sum.alpha / area - 1));
    CHECK(lab.reports() == "");
  }
  MESSAGE("worst relative error ", worst);
}

TEST_CASE("coverage: small spheres keep their area wherever in a pixel they lie") {
  // 20 x 20 spheres of one size, 16.08 pixels apart, far away before a narrow view.
  const double pixel = 2 * 200 * std::tan(std::numbers::pi / 72) / kHeight;
  for (const double radius :
       {0.05, 0.2, 0.4, 0.577, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.35, 1.5, 1.65, 1.79, 1.81, 2.0}) {
    std::vector<Ball> balls;
    for (int i = 0; i < 400; ++i)
      balls.push_back({.center = {(i % 20 - 9.5) * 16.08 * pixel, (i / 20 - 9.5) * 16.08 * pixel, -200},
                       .radius = static_cast<float>(radius * pixel)});
    Lab lab(scene(std::move(balls), 5));
    lab.frame();
    const Picture picture = lab.read("hdr");
    double worst = 0, mean = 0;
    float greatest = 0;
    for (int i = 0; i < 400; ++i) {
      const int x0 = static_cast<int>(kWidth / 2 + (i % 20 - 9.5) * 16.08) - 7,
                y0 = static_cast<int>(kHeight / 2 + (i / 20 - 9.5) * 16.08) - 7;
      double alpha = 0;
      for (int y = y0; y < y0 + 15; ++y)
        for (int x = x0; x < x0 + 15; ++x) {
          const float here = picture.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))[3];
          greatest = std::max(greatest, here);
          alpha += here;
        }
      const double share = alpha / (std::numbers::pi * radius * radius);
      worst = std::max(worst, std::abs(share - 1));
      mean += share / 400;
    }
    CAPTURE(radius);
    MESSAGE("radius ", radius, ": mean ", mean, ", worst ", worst);
    CHECK(worst < (radius <= 0.8 ? 0.002 : 0.015));
    CHECK(mean == doctest::Approx(1).epsilon(0.002));
    CHECK(greatest <= 1);
  }
}

TEST_CASE("coverage: two spheres side by side, each with its own area") {
  const Ball left{.center = {-3, 0, -12}}, right{.center = {3, 1, -15}, .radius = 1.5f};
  Lab lab(scene({left, right}, 60));
  lab.frame();
  const double f = kHeight / 2.0 / std::tan(std::numbers::pi / 6);
  const double area = projectedSphereArea(f, 1, std::sqrt(9.0 + 144), 12) +
                      projectedSphereArea(f, 1.5, std::sqrt(9.0 + 1 + 225), 15);
  CHECK(sumOf(lab.read("hdr")).alpha == doctest::Approx(area).epsilon(0.002));
}

// The judge is 16 x 16 rays a pixel.
TEST_CASE(
    "coverage: where silhouettes touch, the pixels that both pass through are covered as independent edges "
    "cover them") {
  constexpr int kPairs = 12 * 9, kCell = 40, kRays = 16;
  constexpr double kOff = 16.0 / 255;
  const double pixel = 2 * std::tan(std::numbers::pi / 72) / kHeight;  // of the slope
  std::mt19937 random(1);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  for (const bool outside : {true, false}) {  // one beside the other, or before it and within its silhouette
    std::vector<Ball> balls;
    for (int i = 0; i < kPairs; ++i) {
      const double large = between(6, 9), small = outside ? between(4, 9) : between(3, 5),
                   turn = between(0, 6.2831853);
      const double apart = (outside ? large + small : large - small) + between(-0.5, 0.5);
      const double x = (i % 12 - 5.5) * kCell + between(-0.5, 0.5),
                   y = (i / 12 - 4.0) * kCell + between(-0.5, 0.5);
      const double share = outside ? 0.5 : 0.0, far = between(210, 240), near = 200;
      balls.push_back({.center = {(x - share * apart * std::cos(turn)) * pixel * far,
                                  (y - share * apart * std::sin(turn)) * pixel * far, -far},
                       .radius = static_cast<float>(large * pixel * far)});
      balls.push_back({.center = {(x + (1 - share) * apart * std::cos(turn)) * pixel * near,
                                  (y + (1 - share) * apart * std::sin(turn)) * pixel * near, -near},
                       .radius = static_cast<float>(small * pixel * near)});
    }
    Lab lab(scene(balls, 5));
    lab.frame();
    const Picture picture = lab.read("hdr");
    int both = 0, wrong = 0, wrong_of_one = 0;
    double worst = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const std::size_t pair = x / kCell + 12 * (y / kCell);
        int hits[2] = {}, any = 0;
        for (int ray = 0; ray < kRays * kRays; ++ray) {
          const double across = (x + (ray % kRays + 0.5) / kRays - kWidth / 2.0) * pixel,
                       up = (y + (ray / kRays + 0.5) / kRays - kHeight / 2.0) * pixel;
          bool hit = false;
          for (std::size_t k = 0; k < 2; ++k) {
            const Ball& ball = balls[2 * pair + k];
            const glm::dvec3 c = ball.center;  // in floats a distance of 200 would lose a tenth of a pixel
            const double cv = c[0] * across + c[1] * up - c[2], vv = across * across + up * up + 1;
            const double r = ball.radius, cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
            const bool here = cv * cv >= vv * (cc - r * r);
            hits[k] += here;
            hit = hit || here;
          }
          any += hit;
        }
        const double all = kRays * kRays, a = hits[0] / all, b = hits[1] / all, drawn = picture.at(x, y)[3];
        const bool meet = a > 0 && a < 1 && b > 0 && b < 1;
        const double off = std::abs(drawn - any / all);
        both += meet;
        const double product = std::abs(drawn - (1 - (1 - a) * (1 - b)));
        wrong += meet && product > kOff;
        wrong_of_one += !meet && off > kOff;
        worst = std::max(worst, meet ? product : off);
      }
    MESSAGE((outside ? "beside: " : "within: "), kPairs, " pairs, ", both, " pixels with both edges, ", wrong,
            " of them off by more than 16 of 255, worst ", worst * 255, "; others off ", wrong_of_one);
    CHECK(both > kPairs);
    CHECK(wrong_of_one == 0);
    CHECK(wrong == 0);
    CHECK(worst < 12.0 / 255);
    CHECK(lab.reports() == "");
  }
}

TEST_CASE("coverage: the eye inside, the sphere behind, across the eye's plane, and degenerate ones") {
  const double whole = kWidth * kHeight;
  const auto alphaOf = [&](Ball ball) {
    Lab lab(scene({ball}, 60));
    lab.frame();
    const Sum sum = sumOf(lab.read("hdr"));
    CHECK(sum.finite);
    CHECK(lab.reports() == "");
    return sum.alpha;
  };
  CHECK(alphaOf({.center = {0.2, 0.1, 0.3}, .radius = 2}) == whole);  // inside: its inner surface everywhere
  CHECK(alphaOf({.center = {0, 0, 5}, .radius = 2}) == 0);            // behind
  CHECK(alphaOf({.center = {0, 0, -0.02}, .radius = 0.05f}) == 0);    // wholly before the near plane
  CHECK(alphaOf({.center = {0, 0, -5}, .radius = 0}) == 0);           // no extent
  CHECK(alphaOf({.center = {300, 0, -5}, .radius = 2}) == 0);         // outside the frame
  CHECK(alphaOf({.center = {0, 0, -1.05f}, .radius = 1}) ==
        whole);  // near hit before the near plane: inside seen

  // Beside the eye and across its plane: the silhouette is a hyperbola. Covered is what lies right of a curve: between
  // nothing and half of the picture, and symmetric about the horizontal.
  Lab lab(scene({{.center = {1.5, 0, -0.5}, .radius = 1}}, 90));
  lab.frame();
  const Picture picture = lab.read("hdr");
  const Sum sum = sumOf(picture);
  CHECK(sum.finite);
  CHECK(sum.alpha > 0.05 * whole);
  CHECK(sum.alpha < 0.5 * whole);
  for (std::uint32_t y = 0; y < kHeight / 2; ++y)
    for (std::uint32_t x = 0; x < kWidth; x += 7)
      CHECK(std::abs(picture.at(x, y)[3] - picture.at(x, kHeight - 1 - y)[3]) < 2e-3);
}

TEST_CASE("depth: near / distance along the view axis at the sphere's front") {
  Lab lab(scene({{.center = {0, 0, -10}, .radius = 2}}, 60));
  lab.frame();
  const Picture depth = lab.read("depth");
  CHECK(depth.at(kWidth / 2, kHeight / 2)[0] == doctest::Approx(0.1 / 8).epsilon(1e-3));
  CHECK(depth.at(2, 2)[0] == 0);  // infinity
}

TEST_CASE("octagons draw what rectangles draw, byte for byte") {
  const auto texelsOf = [](std::vector<Ball> balls, double fov, bool octagon) {
    Setup setup = scene(std::move(balls), fov);
    setup.sets = {{"octagon", octagon ? "true" : "false"}};
    Lab lab(setup);
    lab.frame();
    CHECK(lab.reports() == "");
    return lab.read("hdr").texels;
  };
  // Many at once; stretched and cut by the picture's border; the eye inside, beside and almost touching;
  // sizes below a pixel.
  std::vector<Ball> crowd;
  for (int i = 0; i < 60; ++i)
    crowd.push_back({.center = {9 * std::sin(i * 2.4), 7 * std::cos(i * 3.7), -6.0 - i * 0.4},
                     .radius = 0.2f + 0.02f * static_cast<float>(i)});
  std::vector<std::vector<Ball>> scenes{crowd};
  for (const Ball& ball : {Ball{.center = {2.5, 1.2, -1.5}}, Ball{.center = {0.2, 0.1, -0.3}},
                           Ball{.center = {1.05, 0, 0}}, Ball{.center = {0, -1.2, -0.8}},
                           Ball{.center = {0.7, 0.7, -0.72}}, Ball{.center = {1, 2, -300}, .radius = 0.3f}})
    scenes.push_back({ball});
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (const double fov : {30.0, 90.0, 140.0}) {
      CAPTURE(i);
      CAPTURE(fov);
      CHECK(texelsOf(scenes[i], fov, true) == texelsOf(scenes[i], fov, false));
    }
}

}  // namespace coverage_test
