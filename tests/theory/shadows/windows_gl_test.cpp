// Windows of the sun's map around what is near the eye, in a scene of 200 m, against rays to every triangle.
#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tests/theory/mesh_scene.h"
#include "tests/theory/shadows/rays.h"
#include "tests/theory/statistics.h"

namespace shadows_windows_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

constexpr double kFov = 42;
const glm::dvec3 kEye(0, 1.5, 4);

// A plain with two towers far away, and near the eye what `add` puts there. The sun is behind all that.
class Plain {
 public:
  explicit Plain(float degrees, glm::vec3 sun = {-0.35f, 0.6f, -0.5f}) : made_(kEye, kFov) {
    addBox({0, -0.1f, 0}, {100, 0.1f, 100});
    addBox({30, 8, -70}, {3, 8, 3});
    addBox({-40, 12, -80}, {4, 12, 4});
    made_.scene.sun = scene::Sun{.direction = glm::normalize(sun), .angle = degrees};
    made_.scene.sun->irradiance = glm::vec3(3);
  }
  void addBox(glm::vec3 at, glm::vec3 half) {
    made_.put(made_.addBox(half), {.name = "", .albedo = glm::vec3(0.6f), .metallic = 0, .roughness = 1}, at,
              maskOf(scene::DrawList::opaque) | maskOf(scene::DrawList::shadow_casters));
  }
  const scene::Scene& scene() const { return made_.scene; }

 private:
  MeshScene made_;
};

struct Point {
  double away = 0, truth = 0, error = 0;
};

// Of the pixels that show the plain and nothing else: what is left of the sun there against `rays` rays to its disc. With a `sky`, that is
// where it is.
std::vector<Point> compare(const scene::Scene& scene, const std::string& graph, int maps, int rays,
                           const std::shared_ptr<const assets::ImageF>& sky = nullptr) {
  Frame frame = {graph, {}, {{"sun_maps", std::to_string(maps)}}};
  if (graph == "graphs/deferred.json") frame.sets.push_back({"ao", "false"});
  scene::Scene shown = scene;
  if (sky) shown.sun.reset();
  const auto around = sky ? sky : constantEnvironment(0, 0, 0);
  const std::vector<float> with = radianceOf(frame, shown, true, around),
                           without = radianceOf(frame, shown, false, around);
  std::mt19937 random(21);
  const glm::dvec3 axis(scene.sun->direction);
  const Triangles triangles(scene);
  const auto metAt = [&](double px, double py) {
    const glm::dvec3 forward = glm::normalize(-kEye), right = glm::normalize(glm::cross(forward, {0, 1, 0}));
    const double slope = std::tan(kFov / 720 * kTurn);
    const double u = (2 * px / kWide - 1) * slope * kWide / kHigh, v = (2 * py / kHigh - 1) * slope;
    const glm::dvec3 way = glm::normalize(forward + right * u + glm::cross(right, forward) * v);
    return kEye + way * std::min(triangles.meet(kEye, way).distance, 1e6);
  };
  std::vector<bool> on_plain;  // corners of pixels
  for (std::uint32_t y = 0; y <= kHigh; ++y)
    for (std::uint32_t x = 0; x <= kWide; ++x) on_plain.push_back(std::abs(metAt(x, y).y) < 1e-6);
  const auto onPlain = [&](std::uint32_t x, std::uint32_t y) {
    return on_plain[std::size_t{y} * (kWide + 1) + x];
  };
  std::vector<Point> points;
  for (std::uint32_t y = 0; y < kHigh; ++y)
    for (std::uint32_t x = 0; x < kWide; ++x) {
      if (!onPlain(x, y) || !onPlain(x + 1, y) || !onPlain(x, y + 1) || !onPlain(x + 1, y + 1)) continue;
      const glm::dvec3 at = metAt(x + 0.5, y + 0.5) + glm::dvec3(0, 1e-5, 0);
      int open = 0;
      for (int i = 0; i < rays; ++i)
        open += !triangles.meetsAny(at, inCone(axis, double(scene.sun->angle) / 720 * kTurn, random));
      const std::size_t texel = 4 * (std::size_t{y} * kWide + x);
      const double truth = double(open) / rays;
      points.push_back(
          {glm::length(at - kEye), truth, std::abs(double(with[texel]) / double(without[texel]) - truth)});
    }
  std::ranges::sort(points, {}, &Point::away);
  return points;
}

double meanErrorOf(std::span<const Point> points) {
  std::vector<double> errors;
  for (const Point& point : points) errors.push_back(point.error);
  return meanOf(errors);
}

}  // namespace

TEST_CASE(
    "windows of the sun's map: a fence near the eye casts its pickets' shadows, in the sky's sun, too") {
  const CleanScope clean;
  // A texel of the sky, 1.4 degrees wide.
  const double around = (39.5 / 256 - 0.5) * kTurn, above = (0.25 - 32.5 / 256) * kTurn;
  const glm::vec3 towards(std::cos(above) * std::cos(around), std::sin(above),
                          std::cos(above) * std::sin(around));
  const auto sky = makeEnvironment([](int x, int y) {
    const double value = x == 39 && y == 32 ? 3000 : 0;
    return std::array{value, value, value};
  });
  Plain plain(0.53f), below_sky(1.5f, towards);
  for (Plain* each : {&plain, &below_sky})
    for (int i = 0; i < 24; ++i)
      each->addBox({-1.7f + 0.14f * static_cast<float>(i), 0.5f, 1.3f}, {0.035f, 0.5f, 0.0125f});
  const auto nearThird = [&](const char* graph, int maps, bool in_sky) {
    const std::vector<Point> points =
        in_sky ? compare(below_sky.scene(), graph, maps, 16, sky) : compare(plain.scene(), graph, maps, 16);
    CHECK(points.size() > 6000);
    const double mean = meanErrorOf(std::span(points).first(points.size() / 3));
    MESSAGE(std::string(graph), std::string(in_sky ? ", the sky's sun, " : ", "), maps, " maps, nearer than ",
            points[points.size() / 3].away, ": mean ", mean);
    return mean;
  };
  for (const bool in_sky : {false, true}) {
    CHECK(nearThird("graphs/deferred.json", 1, in_sky) > 0.3);  // so coarse is one map here
    for (const char* graph : {"graphs/deferred.json", "graphs/studio.json"})
      CHECK(nearThird(graph, 3, in_sky) < 0.07);
  }
}

// The shadows of beams go through all rims. In rings of as many points around the eye, of which few have rims in them, the
// error is the same.
TEST_CASE("windows of the sun's map: no seam where they meet") {
  const CleanScope clean;
  Plain plain(2);
  for (int i = 0; i < 9; ++i) plain.addBox({-4 + 0.8f * static_cast<float>(i), 3, -38}, {0.1f, 0.05f, 42});
  const std::vector<Point> points = compare(plain.scene(), "graphs/deferred.json", 4, 100);
  constexpr std::size_t kRing = 150;
  double worst = 0, highest = 0;
  for (std::size_t i = 0; i + kRing <= points.size(); i += kRing) {
    const std::span<const Point> ring = std::span(points).subspan(i, kRing);
    worst = std::max(worst, meanErrorOf(ring));
    if (ring.back().away < 10) highest = std::max(highest, std::ranges::max(ring, {}, &Point::error).error);
  }
  MESSAGE(points.size(), " points, worst ring: mean ", worst, ", highest nearer than 10 m: ", highest);
  CHECK(points.size() > 6000);
  CHECK(worst < 0.04);
  CHECK(highest < 0.25);
}

// A board so high that its penumbra is as wide as the finest window allows, and just beyond its rim. A filter that left the
// window would not find it.
TEST_CASE("windows of the sun's map: a wide penumbra goes on before a rim") {
  const CleanScope clean;
  Plain plain(2, {0, 0.6f, -0.5f});
  plain.addBox({0, 25, -22.6f}, {6, 0.05f, 0.5f});
  const std::vector<Point> points = compare(plain.scene(), "graphs/deferred.json", 4, 100);
  constexpr std::size_t kRing = 150;
  double worst = 0;
  for (std::size_t i = 0; i + kRing <= points.size() && points[i].away < 10; i += kRing)
    worst = std::max(worst, meanErrorOf(std::span(points).subspan(i, kRing)));
  MESSAGE("worst ring: mean ", worst);
  CHECK(worst < 0.08);
}

TEST_CASE("windows of the sun's map: none of a sun without shadows") {
  const CleanScope clean;
  scene::Scene scene = Plain(0.53f).scene();
  scene.sun->shadow = false;
  const auto dark = constantEnvironment(0, 0, 0);
  const Frame frame = {"graphs/deferred.json", {}, {{"sun_maps", "3"}}};
  CHECK(radianceOf(frame, scene, true, dark) == radianceOf(frame, scene, false, dark));
}

}  // namespace shadows_windows_test
