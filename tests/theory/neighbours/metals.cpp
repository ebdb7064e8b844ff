#include "tests/theory/neighbours/metals.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::theory {

namespace {

std::shared_ptr<const assets::ImageF> dimmedSky() {
  base::Diagnostics said;
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

}  // namespace

MetalScene::MetalScene(Stand stand) {
  setup = {
      .graph = "graphs/studio.json",
      .width = kWidth,
      .height = kHeight,
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
