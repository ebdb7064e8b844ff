// What ray-traced spheres hide of the sky from a floor of triangles, in the deferred frame, against rays over the hemisphere.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "tests/theory/mesh_scene.h"

namespace deferred_occluding_spheres_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

constexpr std::uint32_t kWidth = 320, kHeight = 240;
const glm::dvec3 kCenter(0, 0, 1);  // of a sphere of radius 1 that stands on the plane z = 0

std::vector<float> panelsOf(double elevation, bool sphere, const char* method) {
  const double up = elevation * std::numbers::pi / 180;
  MeshScene made({0, -9 * std::cos(up), 9 * std::sin(up)}, 45);
  made.put(made.addSquare(40), {.name = "", .metallic = 0, .roughness = 1}, {0, 0, 0});
  if (sphere) made.putSphere(kCenter, 1, {.name = "", .metallic = 0, .roughness = 1});
  runtime::test::Stage stage("tests/theory/deferred/occluding_spheres.json", kWidth, kHeight);
  stage.world.setScene(made.scene);
  stage.settings.sets = {{"ao_method", method}, {"ao_radius", "20"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  return stage.read("panels");
}

const float* texelOf(const std::vector<float>& panels, std::uint32_t panel, std::uint32_t x,
                     std::uint32_t y) {
  return &panels[4 * (std::size_t{4 * kWidth} * y + panel * kWidth + x)];
}

// The share of directions over the plane, weighted by their cosine, whose rays from a point of it miss the sphere.
double shareOfSky(double x, double y) {
  constexpr int kSide = 32;
  const glm::dvec3 to = kCenter - glm::dvec3(x, y, 0);
  int missed = 0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const double u = (i + 0.5) / kSide, turn = 2 * std::numbers::pi * (j + 0.5) / kSide;
      const glm::dvec3 ray(std::sqrt(u) * std::cos(turn), std::sqrt(u) * std::sin(turn), std::sqrt(1 - u));
      const double along = glm::dot(ray, to);
      missed += along <= 0 || glm::dot(to, to) - along * along > 1;
    }
  return static_cast<double>(missed) / (kSide * kSide);
}

struct Errors {
  double low = 0, high = 0, sum = 0;
  int count = 0;
};

// Of the points of the floor before the sphere and, farther from it, beside it: behind it nothing is known of what it hides.
Errors errorsOf(const std::vector<float>& panels) {
  Errors errors;
  for (std::uint32_t y = 0; y < kHeight; y += 2)
    for (std::uint32_t x = 0; x < kWidth; x += 2) {
      if (texelOf(panels, 2, x, y)[0] <= 0) continue;
      const float* at = texelOf(panels, 1, x, y);
      const double away = std::hypot(at[0], at[1]);
      const bool before = -at[1] > 0.383 * away;  // 22.5 degrees
      if (away > 4 || away < (before ? 1.25 : 2) || at[1] > 0.383 * away) continue;
      const double error = texelOf(panels, 0, x, y)[0] - shareOfSky(at[0], at[1]);
      errors.low = std::min(errors.low, error);
      errors.high = std::max(errors.high, error);
      errors.sum += std::abs(error);
      ++errors.count;
    }
  return errors;
}

}  // namespace

TEST_CASE("ambient occlusion: ray-traced spheres take of the sky over a mesh what rays say") {
  for (const double elevation : {15.0, 30.0, 60.0}) {
    const CleanScope clean;
    CAPTURE(elevation);
    const Errors errors = errorsOf(panelsOf(elevation, true, "horizon"));
    CHECK(errors.count > 2000);
    CHECK(errors.low > -0.05);
    CHECK(errors.high < 0.05);
    CHECK(errors.sum / errors.count < 0.015);
    MESSAGE(elevation, " degrees: ", errors.low, " to ", errors.high, ", mean ", errors.sum / errors.count,
            " of ", errors.count);
  }
}

TEST_CASE("ambient occlusion: without spheres a mesh that is a plane sees all of the sky, by both methods") {
  for (const char* method : {"horizon", "hemisphere"}) {
    const CleanScope clean;
    CAPTURE(method);
    const std::vector<float> alone = panelsOf(30, false, method), beside = panelsOf(30, true, method);
    int floors = 0, darker = 0, hidden = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        floors += texelOf(alone, 2, x, y)[0] > 0;
        darker += texelOf(alone, 0, x, y)[0] != 1;
        hidden += texelOf(beside, 0, x, y)[0] < 0.9f;
      }
    CHECK(floors > 20000);
    CHECK(darker == 0);
    CHECK(hidden > 1000);
  }
}

TEST_CASE("spheres that are not drawn hide no light from meshes, and throw none on them") {
  const auto floorOf = [](bool sphere, std::vector<graph::Disable> disables) {
    const CleanScope clean;
    MeshScene made({0, -8, 4}, 45);
    made.put(made.addSquare(40), {.name = "", .metallic = 0, .roughness = 1}, {0, 0, 0});
    if (sphere)
      made.putSphere(
          {0, 0, 1}, 1, {.name = "", .metallic = 0, .roughness = 1},
          scene::maskOf(scene::DrawList::spheres) | scene::maskOf(scene::DrawList::shadow_casters));
    made.scene.sun =
        scene::Sun{.direction = glm::normalize(glm::vec3(1, 0.5f, 1)), .irradiance = glm::vec3(2)};
    made.scene.lamps.add(
        {.name = "lamp", .position = {-3, -2, 4}, .intensity = glm::vec3(20), .shadow = true});
    return take(made.scene, {.graph = "graphs/deferred_gi.json", .disables = std::move(disables)}).radiance;
  };
  const std::vector<float> drawn = floorOf(true, {}), without = floorOf(true, {"lit.spheres"}),
                           never = floorOf(false, {});
  float worst = 0;
  int darker = 0;
  for (std::size_t i = 0; i < never.size(); ++i) {
    worst = std::max(worst, std::abs(without[i] - never[i]));
    darker += drawn[i] < never[i] - 0.1f;
  }
  MESSAGE("not drawn: worst ", worst, "; drawn: ", darker, " values darker");
  CHECK(worst < 0.002f);  // a step of a half between 1 and 2 is 0.001
  CHECK(darker > 200);
}

}  // namespace deferred_occluding_spheres_test
