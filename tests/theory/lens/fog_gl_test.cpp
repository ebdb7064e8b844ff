// Fog at silhouettes: a pixel that a sphere covers in part is the mean of the same frame at eight times the size, in radiance. So what is
// behind has the fog before it, not that of the sphere, and no line shows. In pixels in which the silhouettes of two spheres
// pass, these edges have nothing to do with each other.
// And in reflections: a white metal under a white sky shows the fog that the rays of its lobe go through.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/theory/lab.h"

namespace lens_fog_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 90, kFiner = 8;

// White spheres at 5, 20 and 60 before a sky as white, each partly before the next: without fog nothing is seen of them.
Setup setupOf(const std::string& graph, bool fog, std::uint32_t finer) {
  Setup setup{.graph = graph, .width = kWidth * finer, .height = kHeight * finer};
  setup.sets = {{"curve", "linear"},
                {"composite.white", "1.25"},
                {"dither", "false"},
                {"bloom", "false"},
                {"fxaa", "false"},
                {"fog_density", "0.06"},
                {"fog_sky", "0"},
                {"fog_color", "[0, 0.3, 0.6]"},
                {"fog", fog ? "true" : "false"}};
  for (int i = 0; i < 5; ++i) {
    const float x = float(i - 2), step = 0.27f * float(i % 3);
    setup.balls.push_back({.center = {x * 1.3f, step - 0.6f, 15}, .radius = 0.5f});
    setup.balls.push_back({.center = {x * 4.9f + 1.1f, 2 - 3 * step, 0}, .radius = 2});
    setup.balls.push_back({.center = {x * 19 - 4, 5 - 9 * step, -40}, .radius = 9});
  }
  return setup;
}

// Radiance of what the graph presents, without a curve.
std::vector<double> shown(const Setup& setup, std::uint32_t finer) {
  Lab lab(setup);
  lab.frame(0);
  const Picture picture = lab.read("post.ldr");
  CHECK(lab.reports() == "");
  std::vector<double> result(std::size_t{kWidth} * kHeight * 3);
  for (std::uint32_t y = 0; y < setup.height; ++y)
    for (std::uint32_t x = 0; x < setup.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const double encoded = double(picture.at(x, y)[c]),
                     linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        result[(std::size_t{y / finer} * kWidth + x / finer) * 3 + c] += 1.25 * linear / (finer * finer);
      }
  return result;
}

// The share of 24 x 24 rays from the camera, at 20 on the z axis, through a pixel and `around` pixels of it, that meet a sphere.
double shareOf(const Setup& setup, const Ball& ball, std::size_t x, std::size_t y, double around) {
  constexpr int kRays = 24;
  const double height =
      2 * std::tan(setup.camera.fovDegrees * 3.14159265358979 / 360);  // of the picture, at 1
  int met = 0;
  for (int i = 0; i < kRays * kRays; ++i) {
    const auto at = [&](int ray) { return (ray + 0.5) * (1 + 2 * around) / kRays - around; };
    const double right = (double(x) + at(i % kRays) - 0.5 * kWidth) / kHeight * height,
                 up = (double(y) + at(i / kRays) - 0.5 * kHeight) / kHeight * height;
    const glm::dvec3 ray = glm::normalize(glm::dvec3{right, up, -1}),
                     to = glm::dvec3{ball.center} - glm::dvec3{0, 0, 20};
    met += glm::length(glm::cross(ray, to)) < double(ball.radius);
  }
  return double(met) / (kRays * kRays);
}

// How many silhouettes pass through a pixel or within a quarter of a pixel of it, hidden ones too.
int silhouettes(const Setup& setup, std::size_t x, std::size_t y) {
  int found = 0;
  for (const Ball& ball : setup.balls) {
    const double share = shareOf(setup, ball, x, y, 0.25);
    found += share > 0 && share < 1;
  }
  return found;
}

// Red of a pixel if the edges in it had nothing to do with each other: from the farthest to the nearest each sphere covers its share
// of all that is behind. The fog has no red.
double ifIndependent(const Setup& setup, std::size_t x, std::size_t y) {
  std::vector<std::pair<double, double>> layers;  // minus the distance of the rim, share
  for (const Ball& ball : setup.balls) {
    const glm::dvec3 to = glm::dvec3{ball.center} - glm::dvec3{0, 0, 20};
    layers.emplace_back(-std::sqrt(glm::dot(to, to) - double(ball.radius) * double(ball.radius)),
                        shareOf(setup, ball, x, y, 0));
  }
  std::sort(layers.begin(), layers.end());
  double red = 1;
  for (const auto& [far, share] : layers) red += share * (std::exp(0.06 * far) - red);
  return red;
}

}  // namespace

TEST_CASE(
    "fog: on silhouettes the pixels are those of a picture of eight times the size, in the studio and "
    "deferred") {
  for (const std::string graph : {"graphs/studio.json", "graphs/deferred.json"}) {
    const Setup fog = setupOf(graph, true, 1);
    const auto clear = shown(setupOf(graph, false, 1), 1), once = shown(fog, 1),
               often = shown(setupOf(graph, true, kFiner), kFiner);
    double mean = 0, unseen = 0;
    std::size_t edges = 0, off = 0, crossings = 0, independent = 0;
    for (std::size_t y = 1; y < kHeight; ++y)
      for (std::size_t x = 1; x < kWidth; ++x) {
        const std::size_t i = (y * kWidth + x) * 3;
        const double difference = std::abs(once[i] - often[i]);
        unseen = std::max(unseen, std::abs(clear[i] - 1));
        const bool cross = difference > 0.001 && silhouettes(fog, x, y) > 1;
        if (cross)  // there it is also right that each sphere covers its share of all that is behind
          crossings += difference > 0.02 && std::abs(once[i] - ifIndependent(fog, x, y)) > 0.02;
        else
          off += difference > 0.02;
        mean += cross ? 0 : difference / (kWidth * kHeight);
        const bool edge = std::max(std::abs(often[i] - often[i - 3]),
                                   std::abs(often[i] - often[i - std::size_t{kWidth} * 3])) > 0.1;
        edges += edge;
        if (edge && silhouettes(fog, x, y) > 1)
          independent += std::abs(often[i] - ifIndependent(fog, x, y)) > 0.02;
      }
    MESSAGE(graph, ": mean ", mean, ", off by more than 0.02: ", off, " of ", edges, " at edges, and ",
            crossings, " at crossings; ", independent, " of independent edges");
    CHECK(unseen < 0.01);
    CHECK(edges > 800);
    CHECK(mean < 0.0003);
    CHECK(off == 0);
    CHECK(crossings == 0);
    CHECK(independent > 10);  // the picture has crossings that tell
  }
}

// What passes the fog of the lobe of a rough white metal: microfacets of GGX, each a mirror, with Smith's masking; a grid of them.
static double lobePasses(const glm::dvec3& normal, const glm::dvec3& to_eye, double alpha, double depth) {
  constexpr int kGrid = 96;
  const glm::dvec3 aside = glm::normalize(glm::cross(normal, glm::dvec3{0.31, 0.2, 0.93})),
                   third = glm::cross(normal, aside);
  const auto masking = [&](double cosine) {
    return 2 * cosine / (cosine + std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine));
  };
  double passes = 0, all = 0;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const double u = (i % kGrid + 0.5) / kGrid, turn = 2 * 3.14159265358979 * (i / kGrid + 0.5) / kGrid;
    const double cosine = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u)),
                 sine = std::sqrt(1 - cosine * cosine);
    const glm::dvec3 half = cosine * normal + sine * (std::cos(turn) * aside + std::sin(turn) * third);
    const double vh = glm::dot(to_eye, half);
    const glm::dvec3 light = 2 * vh * half - to_eye;
    const double nl = glm::dot(normal, light), nv = glm::dot(normal, to_eye);
    if (vh <= 0 || nl <= 0) continue;
    const double weight = masking(nl) * masking(nv) * vh / (nv * cosine);
    all += weight;
    passes += weight * std::exp(-depth / std::max(std::abs(light.y), 1e-9));
  }
  return passes / all;
}

TEST_CASE(
    "fog: a metal shows as much of the sky as the fog on the way there lets through, in the studio and "
    "deferred") {
  constexpr double kDensity = 0.03, kLayer = 4, kHalf = 0.5773502691896258;  // tan 30 degrees
  for (const std::string graph : {"graphs/studio.json", "graphs/deferred.json"})
    for (const float roughness : {0.0f, 0.3f}) {
      Setup setup{.graph = graph, .width = 96, .height = 96};
      setup.sets = {{"dither", "false"}, {"bloom", "false"},         {"fxaa", "false"},
                    {"fog", "true"},     {"fog_color", "[0, 0, 0]"}, {"fog_density", "0.03"},
                    {"fog_layer", "4"},  {"fog_base", "8"}};
      setup.balls = {{.center = {0, 0, 0}, .radius = 8, .roughness = roughness}};
      Lab lab(setup);
      lab.frame(0);
      const Picture picture = lab.read("hdr");
      CHECK(lab.reports() == "");
      double mean = 0, worst = 0;
      int count = 0;
      for (std::uint32_t y = 0; y < 96; y += 5)
        for (std::uint32_t x = 0; x < 96; x += 5) {
          const glm::dvec3 ray =
              glm::normalize(glm::dvec3{(x + 0.5) / 48 - 1, (y + 0.5) / 48 - 1, -1 / kHalf});
          const double along = -20 * ray.z, from = 400 - along * along;  // squared, to the middle of the ball
          if (from > 55) continue;                                       // its rim: other tests
          const double far = along - std::sqrt(64 - from);
          const glm::dvec3 normal = (glm::dvec3{0, 0, 20} + far * ray) / 8.0;
          const double alpha = std::max(double(roughness) * double(roughness), 1e-4);
          const double expected =
              std::exp(-kDensity * far) * lobePasses(normal, -ray, alpha, kDensity * kLayer);
          const double off = std::abs(double(picture.at(x, y)[0]) - expected);
          mean += off;
          worst = std::max(worst, off);
          ++count;
        }
      MESSAGE(graph, ", roughness ", roughness, ": mean ", mean / count, ", worst ", worst, " of ", count);
      CHECK(count > 80);
      CHECK(mean / count < (roughness > 0 ? 0.03 : 0.002));
    }
}

TEST_CASE("fog: what is below the horizon is seen through the fog above the ground, from any height") {
  constexpr double kDensity = 0.05, kFalloff = 0.25, kBase = -2;
  for (const std::string graph : {"graphs/studio.json", "graphs/deferred.json"})
    for (const float height : {12.0f, 30.0f}) {
      Setup setup{.graph = graph, .width = 96, .height = 96};
      setup.camera.position = {0, height, 20};
      setup.sets = {
          {"dither", "false"},     {"bloom", "false"}, {"fxaa", "false"},          {"fog", "true"},
          {"fog_falloff", "0.25"}, {"fog_base", "-2"}, {"fog_color", "[0, 0, 0]"}, {"fog_density", "0.05"}};
      Lab lab(setup);
      lab.frame(0);
      const Picture picture = lab.read("hdr");
      CHECK(lab.reports() == "");
      const glm::dmat4 back = glm::inverse(glm::dmat4(lab.view().projection) * glm::dmat4(lab.view().view));
      double worst = 0, least = 1, most = 0;
      for (std::uint32_t y = 0; y < 96; y += 5) {
        const glm::dvec4 far = back * glm::dvec4{0.5 / 48, (y + 0.5) / 48 - 1, 1e-6, 1};
        const glm::dvec3 ray = glm::normalize(glm::dvec3(far) / far.w - glm::dvec3(setup.camera.position));
        if (ray.y > -0.05) continue;
        const double length = (double(height) - kBase) / -ray.y;
        double depth = 0;
        for (int i = 0; i < 2000; ++i) {
          const double up = double(height) + ray.y * length * (i + 0.5) / 2000;
          depth += kDensity * std::exp(-kFalloff * (up - kBase)) * length / 2000;
        }
        worst = std::max(worst, std::abs(double(picture.at(48, y)[0]) - std::exp(-depth)));
        least = std::min(least, std::exp(-depth));
        most = std::max(most, std::exp(-depth));
      }
      MESSAGE(graph, ", from ", height, ": worst ", worst, ", of ", least, " to ", most);
      CHECK(worst < 0.002);
      CHECK(most - least > 0.15);
    }
}

}  // namespace lens_fog_test
