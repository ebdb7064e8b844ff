#include "tests/theory/neighbors/metals.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/load_image.h"

namespace weft::theory {

namespace {

std::shared_ptr<const assets::ImageF> dimmedSky() {
  text::Diagnostics said;
  const auto map =
      assets::loadImage(WEFT_SOURCE_DIR "/scenes/environments/spiaggia_di_mondello_1k.hdr", said);
  REQUIRE(map);
  const int step = map->width / 256;
  return makeEnvironment([&](int x, int y) {
    std::array<double, 3> mean{};
    for (int i = 0; i < step * step; ++i) {
      const auto at = static_cast<std::size_t>((y * step + i / step) * map->width + x * step + i % step);
      const float* texel = &map->texels[at * static_cast<std::size_t>(map->channels)];
      for (std::size_t c = 0; c < 3; ++c)
        mean[c] += double(std::min(texel[c], MetalScene::kBrightest)) / (step * step);
    }
    return mean;
  });
}

Setup metalsThatTouch() {
  return {
      .graph = "graphs/studio.json",
      .width = MetalScene::kWidth,
      .height = MetalScene::kHeight,
      .sets = {{"occlusion", "true"}},
      .balls =
          {{.center = {-4.1f, 1, 0}, .albedo = {0.95f, 0.64f, 0.54f}, .roughness = 0.3f},
           {.center = {-2.05f, 1, 0.1f}, .albedo = {0.97f, 0.96f, 0.92f}, .roughness = 0},
           {.center = {0, 1, 0}, .albedo = {1, 0.78f, 0.34f}, .roughness = 0.1f},
           {.center = {2, 1, 0}, .albedo = {0.9f, 0.2f, 0.15f}, .roughness = 0.6f},
           {.center = {3.9f, 1, 0.6f}, .albedo = {0.56f, 0.57f, 0.58f}, .roughness = 0},
           {.center = {-1, 0.6f, 1.9f}, .radius = 0.6f, .albedo = {0.2f, 0.4f, 0.9f}, .roughness = 0.3f},
           {.center = {1.3f, 0.5f, 1.4f}, .radius = 0.5f, .albedo = {0.95f, 0.93f, 0.88f}, .roughness = 0}},
      .camera = {.position = {0, 2.6f, 11}, .target = {0, 0.9f, 0}, .fovDegrees = 24, .nearPlane = 0.1},
      .environment = dimmedSky()};
}

// A plain sky with a sun of half angle 3.5 degrees, low at the left, brightest in its middle: there is one brightest texel.
std::shared_ptr<const assets::ImageF> skyWithSun() {
  constexpr double kDegree = std::numbers::pi / 180, kElevation = 11 * kDegree, kAzimuth = 160 * kDegree;
  const Vec3 sun = {std::cos(kElevation) * std::cos(kAzimuth), std::sin(kElevation),
                    std::cos(kElevation) * std::sin(kAzimuth)};
  return makeEnvironment([&](int x, int y) {
    const Vec3 to = equirectDirection(x, y, 256, 128);
    const double up = std::max(to.y, 0.0);
    const double away = std::acos(std::clamp(dot(to, sun), -1.0, 1.0)) / (3.5 * kDegree);
    const double glow = away < 1 ? 1.2 - 0.4 * away : 0;
    return std::array{0.7 - 0.45 * up + 220 * glow, 0.62 - 0.3 * up + 177 * glow,
                      0.5 - 0.05 * up + 127 * glow};
  });
}

Ball metal(glm::vec3 center, float radius, glm::vec3 albedo, float roughness) {
  return {.center = center, .radius = radius, .albedo = albedo, .roughness = roughness};
}

Ball diffuse(glm::vec3 center, float radius, glm::vec3 albedo) {
  return {.center = center, .radius = radius, .albedo = albedo, .metallic = 0, .roughness = 0.8f};
}

Setup metalsAmongLit() {
  const glm::vec3 gold = {0.75f, 0.48f, 0.12f}, straw = {0.6f, 0.42f, 0.16f}, aluminium(0.9f), white(0.85f),
                  yellow = {0.75f, 0.52f, 0.05f}, black(0.03f);
  return {
      .graph = "graphs/studio.json",
      .width = MetalScene::kWidth,
      .height = MetalScene::kHeight,
      .sets = {{"occlusion", "true"}},
      .balls = {metal({-1.75f, 0, 0}, 1.5f, gold, 0.28f), metal({1.75f, 0, 0}, 1.5f, straw, 0.2f),
                // before the first
                metal({-2.7f, -1.0f, 3.0f}, 0.6f, aluminium, 0.3f),
                diffuse({-1.6f, -0.6f, 4.7f}, 1.1f, yellow), diffuse({-3.7f, -1.2f, 2.2f}, 0.6f, white),
                // before the second
                diffuse({1.2f, -1.3f, 2.4f}, 0.5f, white), metal({0.6f, -1.2f, 3.6f}, 0.7f, aluminium, 0.3f),
                metal({2.6f, -1.2f, 2.6f}, 0.6f, gold, 0.25f), diffuse({3.4f, -0.9f, 3.6f}, 0.9f, black)},
      .camera = {.position = {0, 6, 13}, .target = {0, -0.1f, 0}, .fovDegrees = 12.5f, .nearPlane = 0.1},
      .environment = skyWithSun()};
}

}  // namespace

MetalScene::MetalScene(Stand stand) {
  setup = stand == Stand::amongLit ? metalsAmongLit() : metalsThatTouch();
  if (stand == Stand::onGround)
    setup.ground = scene::Ground{.albedo = glm::vec3(0.42f, 0.39f, 0.35f), .radius = 1e5f};
}

glm::dvec3 MetalScene::rayOf(double x, double y) const {
  const glm::dvec3 forward =
      glm::normalize(glm::dvec3(setup.camera.target) - glm::dvec3(setup.camera.position));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, {0, 1, 0})), up = glm::cross(right, forward);
  const double slope = std::tan(double(setup.camera.fovDegrees) / 360 * std::numbers::pi);
  return glm::normalize(forward + right * ((2 * x / kWidth - 1) * slope * kWidth / kHeight) +
                        up * ((2 * y / kHeight - 1) * slope));
}

int MetalScene::sphereOf(const MetalTracer& tracer, std::uint32_t x, std::uint32_t y) const {
  const glm::dvec3 eye(setup.camera.position);
  const int sphere = tracer.sphereAt(eye, rayOf(x + 0.5, y + 0.5));
  for (int corner = 0; corner < 4; ++corner)
    if (tracer.sphereAt(eye, rayOf(x + corner % 2, y + corner / 2)) != sphere) return -1;
  return sphere;
}

glm::dvec3 MetalScene::truth(const MetalTracer& tracer, std::uint32_t x, std::uint32_t y, int side,
                             std::mt19937& random) const {
  std::uniform_real_distribution<double> unit(0, 1);
  glm::dvec3 sum(0);
  for (int i = 0; i < side * side; ++i)
    sum += tracer.radiance(glm::dvec3(setup.camera.position),
                           rayOf(x + (i % side + unit(random)) / side, y + (i / side + unit(random)) / side),
                           1, random);
  return sum / double(side * side);
}

}  // namespace weft::theory
