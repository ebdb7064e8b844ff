// Ray-traced spheres under a sun, a lamp and a spot, and in the shadow of a square, against meshes of spheres at the same places: in the
// studio, and in the deferred frame, where the meshes come through the G-buffer.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/theory/mesh_scene.h"

namespace deferred_sphere_lights_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

constexpr std::uint32_t kWidth = 192, kHeight = 96;
constexpr float kPi = std::numbers::pi_v<float>;

struct Ball {
  glm::vec3 center;
  scene::Material material;
};
const std::vector<Ball> kBalls = {
    {{-1.3f, 0, 0}, {.name = "", .albedo = {0.8f, 0.5f, 0.3f}, .metallic = 0, .roughness = 0.6f}},
    {{1.3f, 0, 0}, {.name = "", .albedo = {0.9f, 0.8f, 0.5f}, .metallic = 1, .roughness = 0.5f}}};

scene::Scene sceneOf(bool meshes) {
  MeshScene made({0, 0, 6}, 26);
  const scene::MeshId ball = made.addBall(), square = made.addSquare(1);
  const auto casts = scene::maskOf(scene::DrawList::shadow_casters);
  const auto with = [&](scene::DrawList list) {
    return static_cast<std::uint8_t>(scene::maskOf(list) | casts);
  };
  for (const Ball& each : kBalls) {
    if (meshes)
      made.put(ball, each.material, each.center, with(scene::DrawList::opaque));
    else
      made.putSphere(each.center, 1, each.material, with(scene::DrawList::spheres));
  }
  // Between the sun and the upper half of the left sphere; nobody sees it.
  made.put(square, {.name = "", .doubleSided = true}, {-1.3f, 2.5f, 2.5f}, casts);
  scene::Scene& scene = made.scene;
  scene.sun = scene::Sun{.direction = glm::normalize(glm::vec3(0, 1, 1)), .irradiance = {2, 1.8f, 1.5f}};
  scene.lamps.add(
      {.name = "lamp", .position = {0, -1.5f, 2}, .intensity = {1, 2, 4}, .range = 20, .shadow = true});
  scene.lamps.add({.name = "spot",
                   .position = {3, 1, 3},
                   .intensity = {12, 3, 3},
                   .range = 20,
                   .direction = glm::normalize(glm::vec3(-1.7f, -0.8f, -2.4f)),
                   .cosInner = std::cos(0.1f),
                   .cosOuter = std::cos(0.25f)});
  return scene;
}

std::vector<float> render(const std::string& graph, bool meshes, std::vector<graph::Setting> sets) {
  return take(sceneOf(meshes),
              {.graph = graph, .width = kWidth, .height = kHeight, .environment = 0, .sets = std::move(sets)})
      .radiance;
}

// Whether a pixel shows a sphere well inside its silhouette.
bool isInside(std::uint32_t x, std::uint32_t y) {
  const float scale = std::tan(13 * kPi / 180) / (kHeight / 2.0f);
  const glm::vec3 eye(0, 0, 6),
      way = glm::normalize(glm::vec3((static_cast<float>(x) + 0.5f - kWidth / 2.0f) * scale,
                                     (static_cast<float>(y) + 0.5f - kHeight / 2.0f) * scale, -1));
  return std::ranges::any_of(kBalls, [&](const Ball& ball) {
    const glm::vec3 to = ball.center - eye;
    return glm::length(to - glm::dot(to, way) * way) < 0.9f;
  });
}

struct Found {
  int pixels = 0, lit = 0, apart = 0;
  double mean = 0, worst = 0, brightest = 0;
};

Found compare(const std::vector<float>& spheres, const std::vector<float>& meshes) {
  Found found;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (!isInside(x, y)) continue;
      ++found.pixels;
      double difference = 0, value = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i = (std::size_t{y} * kWidth + x) * 4 + c;
        difference = std::max(difference, std::abs(double(spheres[i]) - double(meshes[i])));
        value = std::max(value, double(meshes[i]));
      }
      found.mean += difference;
      found.worst = std::max(found.worst, difference);
      found.brightest = std::max(found.brightest, value);
      found.lit += value > 0.05;
      found.apart += difference > 0.02 + 0.02 * value;
    }
  found.mean /= found.pixels;
  return found;
}

}  // namespace

TEST_CASE("ray-traced spheres get the light of sun, lamp and spot that meshes of spheres get") {
  const CleanScope clean;
  const std::vector<std::pair<std::string, std::vector<graph::Setting>>> ways = {
      {"graphs/studio.json", {{"mesh_shadows", "false"}}},
      {"graphs/studio.json", {{"draw", "icosphere"}, {"subdivision", "5"}, {"mesh_shadows", "false"}}},
      {"graphs/deferred.json", {{"ao", "false"}, {"mesh_shadows", "false"}, {"lamp_shadows", "0"}}},
      {"graphs/deferred.json", {{"ao", "false"}}}};
  std::vector<double> sums;
  for (const auto& [graph, sets] : ways) {
    std::string label = graph;
    for (const graph::Setting& set : sets) label += " " + graph::sourceOf(set);
    CAPTURE(label);
    const std::vector<float> spheres = render(graph, false, sets), meshes = render(graph, true, sets);
    const Found found = compare(spheres, meshes);
    MESSAGE(label << ": mean difference " << found.mean << ", worst " << found.worst << " of "
                  << found.brightest << ", " << found.apart << " of " << found.pixels << " pixels apart, "
                  << found.lit << " lit");
    CHECK(found.pixels > 5000);
    CHECK(found.lit > found.pixels / 2);
    CHECK(found.brightest > 0.5);
    CHECK(found.mean < 0.004);
    CHECK(found.apart < found.pixels / 100);
    double sum = 0;
    for (const float each : spheres) sum += double(each);
    sums.push_back(sum);
  }
  CHECK(sums[3] < 0.97 * sums[2]);  // the square's shadow
}

}  // namespace deferred_sphere_lights_test
