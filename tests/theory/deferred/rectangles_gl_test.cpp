// Lamps with a size against sums over points of the rectangle: a floor in the deferred frame and a ball in the studio, dielectric and metal,
// from smooth to rough.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/theory/mesh_scene.h"
#include "tests/theory/oracle.h"

namespace deferred_rectangles_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kWidth = 96, kHeight = 64;
constexpr double kFov = 30;

struct Rectangle {
  const char* name;
  glm::dvec3 middle, direction;
  double width, height;
};

struct Axes {
  glm::dvec3 across, up;
};
// `across` is horizontal.
Axes axesOf(const Rectangle& lamp) {
  const glm::dvec3 across = glm::normalize(glm::cross(lamp.direction, glm::dvec3(0, 1, 0)));
  return {across * (lamp.width / 2), glm::normalize(glm::cross(across, lamp.direction)) * (lamp.height / 2)};
}

struct Seen {
  glm::dvec3 position, normal;
  bool there = false;
};
// What a pixel shows of the unit ball at the origin, or of the plane z = 0.
Seen seenAt(std::uint32_t x, std::uint32_t y, glm::dvec3 eye, bool ball) {
  const glm::dvec3 ahead = glm::normalize(-eye),
                   right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0))),
                   up = glm::cross(right, ahead);
  const double scale = std::tan(kFov / 2 * kPi / 180) / (kHeight / 2.0);
  const glm::dvec3 way = glm::normalize(ahead + right * ((x + 0.5 - kWidth / 2.0) * scale) +
                                        up * ((y + 0.5 - kHeight / 2.0) * scale));
  if (!ball) return {eye - way * (eye.z / way.z), {0, 0, 1}, way.z < 0};
  const double along = -glm::dot(eye, way), inside = 1 - glm::dot(eye, eye) + along * along;
  if (inside < 0.12) return {};  // not where the edge is blended
  const glm::dvec3 at = eye + way * (along - std::sqrt(inside));
  return {at, at, true};
}

double lambda(double cosine, double alpha) {
  return (std::sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1) / 2;
}

// Radiance towards `eye` of a white dielectric or metal, per radiance of the lamp: midpoints of `steps` x `steps` parts.
double radianceOf(const Seen& seen, glm::dvec3 eye, const Rectangle& lamp, bool metal, double roughness,
                  int steps) {
  const double alpha = roughness * roughness, f0 = metal ? 1 : 0.04;
  const glm::dvec3 v = glm::normalize(eye - seen.position);
  const double nv = glm::dot(v, seen.normal);
  const Albedo albedo = directionalAlbedo(nv, roughness, 100);
  const double lost = 1 - albedo.sum(), single = f0 * albedo.scale + albedo.bias,
               average = f0 + (1 - f0) / 21;
  const double multiple = single * average * lost / (1 - lost * average);
  const double diffuse = metal ? 0 : 1 - single - multiple;
  const auto [across, up] = axesOf(lamp);
  const glm::dvec3 ahead = glm::normalize(lamp.direction);
  const double lambdaV = lambda(nv, alpha);
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const glm::dvec3 to = lamp.middle + across * ((2 * i + 1.0) / steps - 1) +
                            up * ((2 * j + 1.0) / steps - 1) - seen.position;
      const double distance2 = glm::dot(to, to);
      const glm::dvec3 l = to / std::sqrt(distance2), h = glm::normalize(l + v);
      const double nl = glm::dot(l, seen.normal), from = -glm::dot(l, ahead);
      if (nl <= 0 || from <= 0) continue;
      const double nh = glm::dot(seen.normal, h), d = nh * nh * (alpha * alpha - 1) + 1;
      const double left = 1 - glm::dot(v, h), fresnel = f0 + (1 - f0) * left * left * left * left * left;
      const double microfacets =
          alpha * alpha / (kPi * d * d) / (1 + lambda(nl, alpha) + lambdaV) / (4 * nl * nv) * fresnel;
      sum += (microfacets + (multiple + diffuse) / kPi) * nl * from / distance2;
    }
  return sum * lamp.width * lamp.height / (steps * steps);
}

double distanceTo(const Rectangle& lamp, glm::dvec3 point) {
  const auto [across, up] = axesOf(lamp);
  const glm::dvec3 to = point - lamp.middle, x = glm::normalize(across), y = glm::normalize(up);
  return glm::length(to - x * std::clamp(glm::dot(to, x), -lamp.width / 2, lamp.width / 2) -
                     y * std::clamp(glm::dot(to, y), -lamp.height / 2, lamp.height / 2));
}

scene::Scene sceneOf(glm::dvec3 eye, const Rectangle& lamp, bool ball, bool metal, double roughness,
                     float radiance) {
  MeshScene made(eye, kFov);
  const scene::Material material{.name = "",
                                 .albedo = glm::vec3(1),
                                 .metallic = metal ? 1.0f : 0.0f,
                                 .roughness = static_cast<float>(roughness)};
  if (ball)
    made.putSphere({0, 0, 0}, 1, material);
  else
    made.put(made.addSquare(40), material, {0, 0, 0});
  const auto [across, up] = axesOf(lamp);
  made.scene.lamps.add({.name = "lamp",
                        .position = lamp.middle,
                        .intensity = glm::vec3(radiance * static_cast<float>(lamp.width * lamp.height)),
                        .range = 1e4f,
                        .direction = glm::normalize(lamp.direction),
                        .cosInner = 1,
                        .cosOuter = 0,
                        .across = across,
                        .up = up});
  return made.scene;
}

// White on a white diffuser, where it is brightest; differences in steps of 255.
struct Found {
  double mean = 0, worst = 0;
};

class Judge {
 public:
  // Of `lamp` on a floor in the deferred frame, or on a ball in the studio.
  Found operator()(const Rectangle& lamp, glm::dvec3 eye, bool ball, bool metal, int step) {
    const double roughness = step / 255.0;
    std::vector<std::pair<std::size_t, double>> pixels;
    const bool is_new = lamp.name != lit_by_;
    if (is_new) brightest_ = 0, lit_by_ = lamp.name;  // the same for all materials
    for (std::uint32_t i = 0; i < kWidth * kHeight; i += 31) {
      const Seen seen = seenAt(i % kWidth, i / kWidth, eye, ball);
      if (!seen.there || distanceTo(lamp, seen.position) < 0.3 || glm::length(seen.position) > 6) continue;
      pixels.emplace_back(i, radianceOf(seen, eye, lamp, metal, roughness, step < 50 ? 160 : 64));
      if (is_new) brightest_ = std::max(brightest_, radianceOf(seen, eye, lamp, false, 1, 16));
    }
    CHECK(pixels.size() > 40);
    const double radiance = brightest_ > 0 ? 1 / brightest_ : 1;
    const scene::Scene scene = sceneOf(eye, lamp, ball, metal, roughness, static_cast<float>(radiance));
    const std::vector<float> taken = (ball ? ball_.take(scene, kBall) : floor_.take(scene, kFloor)).radiance;
    Found found;
    for (const auto& [at, truth] : pixels) {
      const double off = 255 * std::abs(std::min(static_cast<double>(taken[at * 4 + 1]), 1.0) -
                                        std::min(truth * radiance, 1.0));
      found.mean += off / static_cast<double>(pixels.size());
      found.worst = std::max(found.worst, off);
    }
    return found;
  }

 private:
  inline static const Shot kFloor{.graph = "graphs/deferred.json",
                                  .width = kWidth,
                                  .height = kHeight,
                                  .environment = 0,
                                  .sets = {{"ao", "false"}, {"mesh_shadows", "false"}}},
      kBall{.graph = "graphs/studio.json", .width = kWidth, .height = kHeight, .environment = 0};
  Camera floor_{kFloor}, ball_{kBall};
  std::string lit_by_;
  double brightest_ = 0;
};

}  // namespace

TEST_CASE("rectangles: a floor and a ball are as bright as sums over points of the lamp say") {
  const CleanScope clean;
  struct Case {
    Rectangle lamp;
    glm::dvec3 eye;
    bool ball;
    Found most;
  };
  const std::vector<Case> cases = {
      {{"above", {0, 0.6, 1.2}, {0, -0.1, -1}, 1.6, 0.8}, {0, -4, 2}, false, {3, 13}},
      {{"seen from aside", {0, 1.6, 0.8}, {0, -1, -0.3}, 1.6, 0.8}, {0, -5, 0.7}, false, {8.3, 67}},
      {{"grazing", {1.4, 0.4, 0.35}, {-1, -0.1, -0.05}, 1.5, 0.5}, {0, -4, 2}, false, {2.2, 25}},
      {{"half below the horizon", {0.2, 1.5, 0.1}, {-0.1, -1, 0.2}, 2, 1.2}, {0, -4, 2}, false, {2.4, 20}},
      {{"small", {0, 0.6, 1.2}, {0, -0.1, -1}, 0.003, 0.0005}, {0, -4, 2}, false, {3, 27}},
      {{"on the eye's side", {8, -12, 6}, {-8, 12, -6}, 0.5, 0.5}, {0, -5, 0.7}, false, {12, 26}},
      {{"turned away", {0, 0.6, 1.2}, {0, 0.1, 1}, 1.6, 0.8}, {0, -4, 2}, false, {0, 0}},
      {{"beside a ball", {1.6, 0.8, 1.2}, {-1.6, -0.8, -1.2}, 1.6, 1}, {0, 0.5, 5}, true, {1, 7}},
      {{"behind a ball", {0.6, 1.2, -1.6}, {-0.6, -1.2, 1.6}, 3, 1.5}, {0, 0.5, 5}, true, {2.8, 118}}};
  Judge judge;
  for (const Case& each : cases)
    for (const bool metal : {false, true})
      for (const int step : {26, 77, 128, 255}) {
        CAPTURE(std::string(each.lamp.name));
        CAPTURE(metal);
        CAPTURE(step);
        const Found found = judge(each.lamp, each.eye, each.ball, metal, step);
        MESSAGE(std::string(each.lamp.name), std::string(metal ? ", metal" : ", dielectric"), ", roughness ",
                step / 255.0, ": mean ", found.mean, ", worst ", found.worst);
        CHECK(found.mean <= each.most.mean);
        CHECK(found.worst <= each.most.worst);
        // The diffuse part is exact; a narrow lobe is a cosine's but for its edge.
        if (step == 26) CHECK(found.mean < 0.5);
        if (step == 26) CHECK(found.worst < 10);
      }
}

}  // namespace deferred_rectangles_test
