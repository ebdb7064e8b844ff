// Ray-traced spheres, triangles of spheres and glass under many lamps, in the deferred frame and in the studio: with clusters
// against a loop over all lamps. Not a bit may differ, because lamps are added in the same order and those left out give exactly
// nothing.
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "tests/theory/mesh_scene.h"

namespace deferred_forward_lamps_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

constexpr std::uint32_t kWidth = 150, kHeight = 77;  // neither is a multiple of a tile

// A wall, panes at two depths, and spheres from specks of less than a pixel to one that reaches beyond the picture; lamps all
// among them, every third a spot, every seventh a rectangle.
scene::Scene sceneOf(int lamps, float reach) {
  MeshScene made({0, 0.5, 9}, 60);
  const scene::MeshId square = made.addSquare(9);
  made.put(square, {.name = "", .albedo = {0.8f, 0.8f, 0.8f}, .roughness = 0.9f}, {0, 0, -6});
  for (const float z : {-2.0f, 3.0f})
    made.put(square,
             {.name = "", .albedo = {0.3f, 0.5f, 0.7f}, .roughness = 0.4f, .alpha = 0.4f, .blend = true},
             {9 + z / 2, 2, z}, scene::maskOf(scene::DrawList::transparent));
  std::mt19937 random(5);
  const auto number = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() % 65536) / 65536;
  };
  for (int i = 0; i < 60; ++i)
    made.putSphere({number(-6, 6), number(-4, 4), number(-5, 6)}, i % 3 ? number(0.3f, 0.9f) : 0.01f,
                   {.name = "", .albedo = {0.9f, 0.5f, 0.3f}, .roughness = 0.5f});
  made.scene.ground = scene::Ground{.height = -4.5f, .albedo = glm::vec3(0.6f, 0.5f, 0.4f)};
  made.putSphere({7, -5, 2}, 4, {.name = "", .albedo = {0.7f, 0.7f, 0.7f}, .roughness = 0.6f});
  for (int i = 0; i < lamps; ++i) {
    scene::Lamp lamp{.name = "lamp",
                     .position = {number(-7, 7), number(-5, 5), number(-6, 8)},
                     .intensity = {number(0.1f, 1), number(0.1f, 1), number(0.1f, 1)},
                     .range = reach * number(0.5f, 1.5f)};
    if (i % 3 == 1) {
      lamp.direction = glm::normalize(glm::vec3(number(-1, 1), -1, number(-1, 1)));
      lamp.cosOuter = number(0.2f, 0.95f);
      lamp.cosInner = (1 + lamp.cosOuter) / 2;
    } else if (i % 7 == 2) {
      lamp.across = {number(0.2f, 1), 0, 0};
      lamp.up = {0, 0, -number(0.2f, 1)};
    }
    made.scene.lamps.add(lamp);
  }
  return made.scene;
}

struct Way {
  std::string graph;
  std::vector<graph::Setting> sets;
};

class Renders {
 public:
  explicit Renders(const Way& way)
      : shot_{.graph = way.graph, .width = kWidth, .height = kHeight, .environment = 0.1, .sets = way.sets},
        camera_(shot_) {}
  std::vector<float> operator()(const scene::Scene& scene, std::vector<graph::Disable> disables) {
    shot_.disables = std::move(disables);
    return camera_.take(scene, shot_).radiance;
  }

 private:
  Shot shot_;
  Camera camera_;
};

const Way kDeferred{"graphs/deferred.json", {{"ao", "false"}}};

}  // namespace

TEST_CASE("clustered lamps: spheres and glass too are those of a loop over all lamps, to the bit") {
  const CleanScope clean;
  const std::vector<Way> ways = {
      kDeferred, {"graphs/studio.json", {}}, {"graphs/studio.json", {{"draw", "icosphere"}}}};
  for (const Way& way : ways) {
    CAPTURE(way.graph);
    Renders render(way);
    const std::vector<float> dark = render(sceneOf(0, 1), {});
    for (const int lamps : {1, 100, 1000}) {
      CAPTURE(lamps);
      const scene::Scene scene = sceneOf(lamps, lamps == 1 ? 30 : 1.5f);
      const std::vector<float> clustered = render(scene, {});
      CHECK(clustered == render(scene, {std::string("light_clusters")}));
      CHECK(clustered != dark);
    }
  }
}

TEST_CASE("clustered lamps: with tiles or slices disabled spheres and glass are the same") {
  const CleanScope clean;
  const scene::Scene scene = sceneOf(300, 1.5f);
  for (const Way& way : {kDeferred, Way{"graphs/studio.json", {}}}) {
    CAPTURE(way.graph);
    Renders render(way);
    const std::vector<float> whole = render(scene, {});
    for (const char* pass : {"lamps_in_tiles", "lamps_in_columns", "lamps_in_slices"})
      CHECK(whole == render(scene, {std::string(pass)}));
  }
}

TEST_CASE("ground: under a point, a spot and a rectangle it has what they send by the inverse square") {
  const CleanScope clean;
  constexpr double kPi = std::numbers::pi;
  const glm::dvec3 eye(0, 4, 6), middle(0.4, 1.5, -0.3);
  const double half = 0.7;  // of the rectangle's sides
  const auto cosineOver2 = [](glm::dvec3 to) { return to.y / std::pow(glm::dot(to, to), 1.5); };
  const scene::Lamp point{
      .name = "lamp", .position = glm::vec3(middle), .intensity = glm::vec3(3), .range = 1e6f};
  scene::Lamp spot = point, rectangle = point;
  spot.direction = rectangle.direction = {0, -1, 0};
  spot.cosOuter = 0.8f, spot.cosInner = 0.81f;
  rectangle.across = {half, 0, 0}, rectangle.up = {0, 0, -half};
  // Irradiance for an intensity of 1; below 0: not asked.
  using Sent = std::function<double(glm::dvec3)>;
  const Sent byPoint = [&](glm::dvec3 at) { return cosineOver2(middle - at); };
  const Sent bySpot = [&](glm::dvec3 at) {
    const double cosine = glm::normalize(middle - at).y;
    return cosine > 0.815 ? byPoint(at) : cosine < 0.795 ? 0 : -1;
  };
  const Sent byRectangle = [&](glm::dvec3 at) {
    constexpr int kSteps = 40;
    double sum = 0;
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const double x = (i % kSteps + 0.5) / kSteps * 2 - 1, z = (i / kSteps + 0.5) / kSteps * 2 - 1;
      const glm::dvec3 to = middle + half * glm::dvec3(x, 0, z) - at;
      sum += cosineOver2(to) * glm::normalize(to).y / (kSteps * kSteps);
    }
    return sum;
  };
  for (const char* graph : {"graphs/studio.json", "graphs/deferred.json"}) {
    CAPTURE(graph);
    const Shot shot{.graph = graph, .environment = 0};
    Camera camera(shot);
    for (const auto& [lamp, sent] : {std::pair{point, byPoint}, {spot, bySpot}, {rectangle, byRectangle}}) {
      MeshScene made(eye, 40);
      made.scene.ground = scene::Ground{.albedo = glm::vec3(0.5f), .radius = 1e5f};
      made.scene.lamps.add(lamp);
      const Taken taken = camera.take(made.scene, shot);
      const glm::dvec3 ahead = glm::normalize(-eye), up = glm::cross(glm::dvec3(1, 0, 0), ahead);
      double worst = 0, most = 0;
      for (std::uint32_t y = 0; y < shot.height; ++y)
        for (std::uint32_t x = 0; x < shot.width; ++x) {
          const double slope = std::tan(20 * kPi / 180) / (shot.height / 2.0);
          const glm::dvec3 ray = ahead + slope * ((x + 0.5 - shot.width / 2.0) * glm::dvec3(1, 0, 0) +
                                                  (y + 0.5 - shot.height / 2.0) * up);
          const double truth = 3 * 0.5 / kPi * sent(eye - ray * (eye.y / ray.y));
          if (truth < 0) continue;
          worst = std::max(worst, std::abs(double(taken.radiance[(y * shot.width + x) * 4]) - truth));
          most = std::max(most, truth);
        }
      MESSAGE("worst ", worst, " of ", most);
      CHECK(most > 0.1);
      CHECK(worst < 0.002 * most);
    }
  }
}

}  // namespace deferred_forward_lamps_test
