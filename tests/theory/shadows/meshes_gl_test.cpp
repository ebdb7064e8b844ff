// Shadows of meshes in the studio and in the deferred frame against rays to every triangle: what is left of the sun, of the environment's
// brightest spots and of the sky.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/theory/mesh_scene.h"
#include "tests/theory/shadows/rays.h"
#include "tests/theory/statistics.h"

namespace shadows_meshes_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

constexpr double kFov = 42;
const glm::dvec3 kEye(1.5, 2.6, 4.1);
const glm::dvec3 kBall(1.15, 0.4, 0.1);  // a ray-traced sphere that casts no shadow into maps
constexpr double kBallRadius = 0.3;

struct Place {
  glm::vec3 at, half;
};
// A table on a leg, a box on the table, a box on the ground and one in the air.
const std::vector<Place> kBoxes = {{{0, 0.95f, 0}, {0.8f, 0.05f, 0.6f}},
                                   {{0, 0.45f, 0}, {0.12f, 0.45f, 0.12f}},
                                   {{-0.3f, 1.2f, 0.1f}, {0.15f, 0.2f, 0.15f}},
                                   {{-1.7f, 0.3f, 0.4f}, {0.3f, 0.3f, 0.4f}},
                                   {{0.9f, 1.5f, -1.3f}, {0.35f, 0.25f, 0.2f}}};

scene::Scene furniture(std::optional<scene::Sun> sun) {
  MeshScene made(kEye, kFov);
  constexpr auto kLists =
      static_cast<std::uint8_t>(maskOf(scene::DrawList::opaque) | maskOf(scene::DrawList::shadow_casters));
  for (const Place& box : kBoxes)
    made.put(made.addBox(box.half), {.name = "", .albedo = glm::vec3(0.6f), .metallic = 0, .roughness = 1},
             box.at, kLists);
  made.putSphere(glm::vec3(kBall), static_cast<float>(kBallRadius),
                 {.name = "", .albedo = glm::vec3(0.6f), .metallic = 0, .roughness = 1});
  made.scene.ground = scene::Ground{.albedo = glm::vec3(1), .radius = 1e5f};
  made.scene.sun = sun;
  return made.scene;
}

Hit meetBall(glm::dvec3 from, glm::dvec3 way) {
  const glm::dvec3 to = kBall - from;
  const double along = glm::dot(to, way),
               under = kBallRadius * kBallRadius - glm::dot(to, to) + along * along;
  if (under < 0 || along - std::sqrt(under) <= 0) return {};
  const double distance = along - std::sqrt(under);
  return {distance, glm::normalize(from + way * distance - kBall)};
}

// How far shares may be off on average: on the ground, on meshes, on the sphere.
constexpr std::array<double, 3> kSmallSun = {2e-4, 1.7e-3, 7e-3}, kLargeSun = {1.2e-3, 1.5e-3, 0.0105},
                                kSpot = {3e-3, 2.4e-3, 1.9e-3}, kSpotBeside = {7.5e-3, 2.4e-3, 1.9e-3};
constexpr double kGlossy = 6.5e-3;  // of four spots, whose gloss the truth leaves out

const Frame kStudio = {"graphs/studio.json", {kGround, kMesh, kSphere}},
            kDeferred = {"graphs/deferred.json", {kMesh, kSphere}, {{"ao", "false"}}};

struct Seen {
  glm::dvec3 at, normal;
  Kind kind = kGround;
};

// What a pixel's center shows; empty at edges, where neighbors show something else, and in the sky.
std::optional<Seen> seenAt(const Triangles& triangles, double x, double y) {
  const auto shown = [&](double px, double py) -> std::optional<Seen> {
    const glm::dvec3 forward = glm::normalize(-kEye), right = glm::normalize(glm::cross(forward, {0, 1, 0}));
    const double slope = std::tan(kFov / 720 * kTurn);
    const double u = (2 * px / kWide - 1) * slope * kWide / kHigh, v = (2 * py / kHigh - 1) * slope;
    const glm::dvec3 way = glm::normalize(forward + right * u + glm::cross(right, forward) * v);
    const Hit mesh = triangles.meet(kEye, way), ball = meetBall(kEye, way);
    const double ground = way.y < 0 ? -kEye.y / way.y : 1e29;
    const double nearest = std::min({mesh.distance, ball.distance, ground});
    if (nearest > 1e20) return {};
    if (nearest == ground) return Seen{kEye + way * ground, {0, 1, 0}, kGround};
    return nearest == mesh.distance ? Seen{kEye + way * nearest, mesh.normal, kMesh}
                                    : Seen{kEye + way * nearest, ball.normal, kSphere};
  };
  const std::optional<Seen> here = shown(x + 0.5, y + 0.5);
  if (!here) return {};
  for (const glm::dvec2 beside : {glm::dvec2(-1, 0), {2, 0}, {0, -1}, {0, 2}}) {
    const std::optional<Seen> other = shown(x + beside.x, y + beside.y);
    if (!other || other->kind != here->kind || glm::dot(other->normal, here->normal) < 0.9) return {};
  }
  return here;
}

bool isHidden(const Triangles& triangles, const Seen& seen, glm::dvec3 way) {
  return triangles.meetsAny(seen.at + seen.normal * 1e-5, way);
}

struct Errors {
  std::array<std::vector<double>, 3> all;
  std::array<int, 3> dark{};
};

// The share of `rays` directions that meet nothing.
double openShare(const Triangles& triangles, const Seen& seen, int rays,
                 const std::function<glm::dvec3()>& direction) {
  int open = 0;
  for (int i = 0; i < rays; ++i) open += !isHidden(triangles, seen, direction());
  return double(open) / rays;
}

// The share that shadows leave of the radiance without them, against the truth; `axes` go to the lights.
Errors compare(const Frame& frame, const Triangles& triangles, const std::vector<float>& with,
               const std::vector<float>& without, const std::vector<glm::dvec3>& axes,
               const std::function<double(const Seen&)>& truthOf) {
  Errors errors;
  for (std::uint32_t y = 1; y < kHigh - 1; ++y)
    for (std::uint32_t x = 1; x < kWide - 1; ++x) {
      const std::size_t texel = 4 * (std::size_t{y} * kWide + x);
      const std::optional<Seen> seen = seenAt(triangles, x, y);
      if (!seen || !std::ranges::count(frame.shown, seen->kind)) continue;
      if (std::ranges::any_of(axes, [&](glm::dvec3 axis) {
            // On the ground, where the ray-traced sphere takes nothing by itself.
            return glm::dot(seen->normal, axis) < 0.1 ||
                   (seen->kind == kGround &&
                    glm::length(glm::cross(kBall - seen->at, axis)) < kBallRadius + 0.15);
          }))
        continue;
      if (seen->kind == kGround && (x + y) % 4 != 0) continue;  // there is plenty of it
      REQUIRE(without[texel] > 0);
      const double truth = truthOf(*seen);
      errors.dark[seen->kind] += truth < 0.1;
      errors.all[seen->kind].push_back(std::abs(double(with[texel]) / double(without[texel]) - truth));
    }
  return errors;
}

// Of a place in an environment of 256 x 128 texels.
glm::dvec3 towards(double x, double y) {
  const double turn = kTurn * (x / 256 - 0.5), down = kTurn / 2 * y / 128;
  return glm::dvec3(std::sin(down) * std::cos(turn), std::cos(down), std::sin(down) * std::sin(turn));
}

}  // namespace

TEST_CASE("mesh shadows: what is left of the sun's disc on ground, meshes and spheres") {
  const CleanScope clean;
  std::mt19937 random(11);
  for (const float degrees : {0.53f, 5.0f}) {
    scene::Sun sun{.direction = glm::normalize(glm::vec3(-0.45f, 0.75f, 0.35f)), .angle = degrees};
    sun.irradiance = glm::vec3(3);
    const scene::Scene scene = furniture(sun);
    const Triangles triangles(scene);
    const auto dark = constantEnvironment(0, 0, 0);
    const glm::dvec3 axis(sun.direction);
    const auto direction = [&] { return inCone(axis, double(degrees) / 720 * kTurn, random); };
    for (const Frame& frame : {kStudio, kDeferred}) {
      Errors errors = compare(frame, triangles, radianceOf(frame, scene, true, dark),
                              radianceOf(frame, scene, false, dark), {axis},
                              [&](const Seen& seen) { return openShare(triangles, seen, 64, direction); });
      for (const Kind kind : frame.shown) {
        std::vector<double>& all = errors.all[kind];
        const double mean = meanOf(all), high = percentileOf(all, 0.99);
        MESSAGE(frame.graph, ", ", degrees, " degrees, ", int(kind), ": ", all.size(), " points, ",
                errors.dark[kind], " dark, mean ", mean, ", 99 % below ", high);
        CHECK(all.size() > 100);
        CHECK(errors.dark[kind] > 15);
        CHECK(mean < (degrees < 1 ? kSmallSun : kLargeSun)[kind]);
      }
    }
  }
}

TEST_CASE("mesh shadows: what is left of the environment's brightest spot") {
  const CleanScope clean;
  std::mt19937 random(12);
  // Three texels by three, 4.2 degrees, over the left of the eye; the cells that the irradiance is summed over are four wide, and the two lie otherwise in them.
  struct Corner {
    int left, top;
  };
  for (const Corner corner : {Corner{214, 36}, Corner{212, 41}}) {
    const int left = corner.left, top = corner.top;
    const auto lit = makeEnvironment([&](int x, int y) {
      const double value = x >= left && x < left + 3 && y >= top && y < top + 3 ? 3000 : 0;
      return std::array{value, value, value};
    });
    std::uniform_real_distribution<double> share(0, 3);
    const scene::Scene scene = furniture({});
    const Triangles triangles(scene);
    const auto direction = [&] { return towards(left + share(random), top + share(random)); };
    for (const Frame& frame : {kStudio, kDeferred}) {
      Errors errors = compare(frame, triangles, radianceOf(frame, scene, true, lit),
                              radianceOf(frame, scene, false, lit), {towards(left + 1.5, top + 1.5)},
                              [&](const Seen& seen) { return openShare(triangles, seen, 64, direction); });
      for (const Kind kind : frame.shown) {
        std::vector<double>& all = errors.all[kind];
        const double mean = meanOf(all), high = percentileOf(all, 0.99);
        MESSAGE(frame.graph, ", ", int(kind), ": ", all.size(), " points, ", errors.dark[kind],
                " dark, mean ", mean, ", 99 % below ", high);
        CHECK(all.size() > 100);
        CHECK((errors.dark[kind] > 1 || corner.left != 214));
        CHECK(mean < (corner.left == 214 ? kSpot : kSpotBeside)[kind]);
      }
    }
  }
}

// The light of each texel of the map, times its solid angle and the cosine, where rays to places in it meet nothing.
TEST_CASE("mesh shadows: of four windows each casts its own, as a sum over all texels says") {
  const CleanScope clean;
  struct Window {
    int left, top;
    double radiance;
  };
  const std::array<Window, 4> windows = {{{214, 36, 3000}, {150, 30, 2500}, {20, 40, 2000}, {90, 36, 2200}}};
  const auto windowAt = [&](int x, int y) {
    std::size_t i = 0;
    while (i < windows.size() &&
           (x < windows[i].left || x >= windows[i].left + 3 || y < windows[i].top || y >= windows[i].top + 3))
      ++i;
    return i;
  };
  const auto map = makeEnvironment([&](int x, int y) {
    const std::size_t i = windowAt(x, y);
    const double value = i < windows.size() ? windows[i].radiance : 0;
    return std::array{value, value, value};
  });
  std::vector<glm::dvec3> axes;
  for (const Window& window : windows) axes.push_back(towards(window.left + 1.5, window.top + 1.5));

  const scene::Scene scene = furniture({});
  const Triangles triangles(scene);
  std::vector<std::size_t> missing;  // on the ground: the window whose light is missing, if it is one alone
  const auto truthOf = [&](const Seen& seen) {
    double all = 0, left = 0;
    std::array<int, 4> open{};
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 256; ++x) {
        const std::size_t i = windowAt(x, y);
        if (i == windows.size()) continue;  // black
        const double solid = std::sin(kTurn / 2 * (y + 0.5) / 128);
        for (const double down : {1 / 6.0, 0.5, 5 / 6.0})
          for (const double aside : {1 / 6.0, 0.5, 5 / 6.0}) {
            const glm::dvec3 way = towards(x + aside, y + down);
            const double light = windows[i].radiance * solid * std::max(glm::dot(seen.normal, way), 0.0);
            const bool past = !isHidden(triangles, seen, way);
            all += light;
            left += past ? light : 0;
            open[i] += past;
          }
      }
    std::size_t which = windows.size(), hidden = 0;
    for (std::size_t i = 0; i < windows.size(); ++i)
      if (open[i] < 81) which = open[i] == 0 ? i : which, ++hidden;
    if (seen.kind == kGround) missing.push_back(hidden == 1 ? which : windows.size());
    return left / all;
  };
  Errors errors = compare(kStudio, triangles, radianceOf(kStudio, scene, true, map),
                          radianceOf(kStudio, scene, false, map), axes, truthOf);
  std::vector<double>& all = errors.all[kGround];  // others have a gloss, too
  const double mean = meanOf(all), high = percentileOf(all, 0.99);
  MESSAGE(all.size(), " points, mean ", mean, ", 99 % below ", high);
  CHECK(all.size() > 2000);
  CHECK(mean < kSpot[kGround]);
  Errors deferred = compare(kDeferred, triangles, radianceOf(kDeferred, scene, true, map),
                            radianceOf(kDeferred, scene, false, map), axes, truthOf);
  MESSAGE("deferred, meshes with a gloss: mean ", meanOf(deferred.all[kMesh]));
  CHECK(deferred.all[kMesh].size() > 200);
  CHECK(meanOf(deferred.all[kMesh]) < kGlossy);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    std::vector<double> without;
    for (std::size_t point = 0; point < missing.size(); ++point)
      if (missing[point] == i) without.push_back(errors.all[kGround][point]);
    MESSAGE("window ", i, " alone is hidden from ", without.size(), " points, mean ", meanOf(without));
    CHECK(without.size() > 15);
    CHECK(meanOf(without) < kSpot[kGround]);
  }
}

TEST_CASE("mesh shadows: what is left of the sky on the ground") {
  const CleanScope clean;
  std::mt19937 random(13);
  std::uniform_real_distribution<double> share(0, 1);
  const scene::Scene scene = furniture({});
  const Triangles triangles(scene);
  const auto white = constantEnvironment(1, 1, 1);
  Errors errors = compare(kStudio, triangles, radianceOf(kStudio, scene, true, white),
                          radianceOf(kStudio, scene, false, white), {{0, 1, 0}}, [&](const Seen& seen) {
                            return openShare(triangles, seen, 400, [&] {
                              const double radius2 = share(random), turn = kTurn * share(random);
                              return glm::dvec3(std::sqrt(radius2) * std::cos(turn), std::sqrt(1 - radius2),
                                                std::sqrt(radius2) * std::sin(turn));
                            });
                          });
  std::vector<double>& all = errors.all[kGround];
  const double mean = meanOf(all), high = percentileOf(all, 0.99);
  MESSAGE(all.size(), " points, mean ", mean, ", 99 % below ", high);
  CHECK(all.size() > 400);
  CHECK(mean < 0.014);
  CHECK(high < 0.085);
}

}  // namespace shadows_meshes_test
