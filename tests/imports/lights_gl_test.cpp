// Shadow maps of the sun and of lamps, against rays that are followed to the spheres by hand.
#include <array>
#include <cmath>
#include <optional>

#include "engine/scene/light_views.h"
#include "tests/runtime/stage.h"

namespace lights_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

struct Ball {
  glm::vec3 center;
  float radius;
};
const std::vector<Ball> kBalls = {{{2, 0, 0}, 0.7f},  {{0, 3, 1}, 1.0f},    {{-2, -1, 3}, 0.8f},
                                  {{1, 1, -4}, 1.5f}, {{3, 0.5f, 0.4f}, 1}, {{0, -3, 0}, 0.5f}};
const std::array<glm::vec3, 2> kLamps = {glm::vec3(0, 0, 0), glm::vec3(1, -1.5f, 2)};
const glm::vec3 kSun = glm::normalize(glm::vec3(1, 3, 2));

scene::Scene sceneOf(float velocity = 0) {
  scene::Scene scene;
  scene.cameras.add({.name = "front"});
  for (const Ball& ball : kBalls)
    scene.spheres.add({.center = ball.center,
                       .radius = ball.radius,
                       .velocity = {velocity, 0, 0},
                       .material = scene.materials.add({.name = ""}),
                       .lists = scene::maskOf(scene::DrawList::shadow_casters)});
  scene.lamps.add({.name = "a", .position = kLamps[0], .range = 20, .shadow = true});
  scene.lamps.add({.name = "dark", .position = {9, 9, 9}, .range = 20});
  scene.lamps.add({.name = "b", .position = kLamps[1], .range = 50, .shadow = true});
  scene.sun = scene::Sun{.direction = kSun};
  return scene;
}

// Distance along a unit ray to the nearest sphere; `grown` more than their radii.
std::optional<float> hitAt(glm::vec3 from, glm::vec3 direction, float grown, float moved = 0) {
  std::optional<float> nearest;
  for (const Ball& ball : kBalls) {
    const glm::vec3 away = ball.center + glm::vec3(moved, 0, 0) - from;
    const float radius = ball.radius + grown, along = glm::dot(away, direction);
    const float inside = radius * radius - (glm::dot(away, away) - along * along);
    if (inside < 0) continue;
    const float t = along - std::sqrt(inside);
    if (t > 0 && (!nearest || t < *nearest)) nearest = t;
  }
  return nearest;
}

// World direction of the center of a texel of a face: OpenGL 4.5 core, table 8.19, turned round.
glm::vec3 directionOf(int face, float s, float t) {
  switch (face) {
    case 0:
      return glm::normalize(glm::vec3(1, -t, -s));
    case 1:
      return glm::normalize(glm::vec3(-1, -t, s));
    case 2:
      return glm::normalize(glm::vec3(s, 1, t));
    case 3:
      return glm::normalize(glm::vec3(s, -1, -t));
    case 4:
      return glm::normalize(glm::vec3(s, -t, 1));
    default:
      return glm::normalize(glm::vec3(-s, -t, -1));
  }
}

struct Drawn {
  explicit Drawn(scene::Scene scene) : stage("tests/imports/graphs/shadow_maps.json", 1, 1) {
    stage.world.setScene(std::move(scene));
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  }
  Stage stage;
};

}  // namespace

TEST_CASE("each texel of a lamp's cube has the depth of what the ray through it meets") {
  context();
  const CleanScope scope;
  Drawn drawn(sceneOf());
  drawn.stage.run(0);
  const gl::TextureRef maps = drawn.stage.texture("maps");
  REQUIRE(maps.desc.layers == 12);
  int compared = 0, hits = 0;
  for (int lamp = 0; lamp < 2; ++lamp)
    for (int face = 0; face < 6; ++face) {
      const std::vector<float> depths = gl::readFloats(maps, 0, static_cast<std::uint32_t>(lamp * 6 + face));
      for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
          const float s = (static_cast<float>(x) + 0.5f) / 32 - 1,
                      t = (static_cast<float>(y) + 0.5f) / 32 - 1;
          const glm::vec3 direction = directionOf(face, s, t), from = kLamps[static_cast<std::size_t>(lamp)];
          // At silhouettes triangles and spheres differ.
          const auto inner = hitAt(from, direction, -0.03f), outer = hitAt(from, direction, 0.03f);
          if (inner.has_value() != outer.has_value() || (inner && *inner - *outer > 0.25f)) continue;
          const float depth = depths[static_cast<std::size_t>(y * 64 + x)];
          ++compared;
          if (!inner) {
            REQUIRE(depth == 0);
            continue;
          }
          ++hits;
          const float major = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
          const float near = scene::nearPlaneOf({.range = lamp == 0 ? 20.0f : 50.0f});
          const float distance = near / depth / major;
          REQUIRE(distance >= *outer - 1e-3f);
          REQUIRE(distance <= *inner + 1e-3f);
        }
    }
  CHECK(compared > 45000);
  CHECK(hits > 3000);
}

TEST_CASE("a point is deeper than the sun's map where a ray towards the sun meets a sphere, and only there") {
  context();
  const CleanScope scope;
  Drawn drawn(sceneOf());
  int shadowed = 0, lit = 0;
  for (int i = 0; i < 90; ++i) {
    const auto at = [&](int axis) {
      return std::fmod(static_cast<float>(i) * (0.37f + 0.21f * static_cast<float>(axis)), 1.0f) * 5 - 2.5f;
    };
    const glm::vec3 point{at(0), at(1) - 1, at(2)};
    const auto inner = hitAt(point, kSun, -0.12f), outer = hitAt(point, kSun, 0.12f);
    if (inner.has_value() != outer.has_value()) continue;
    bool inside = false;
    for (const Ball& ball : kBalls) inside = inside || glm::length(point - ball.center) < ball.radius + 0.1f;
    if (inside) continue;
    graph::Value value{graph::Value::Type::list, 3, {point.x, point.y, point.z}, {}};
    drawn.stage.settings.sets = {{"look.at", value, graph::Origin::command_line}};
    REQUIRE_MESSAGE(drawn.stage.apply(), drawn.stage.diagnostics.text());
    drawn.stage.run(static_cast<std::uint32_t>(i));
    const float deeper = drawn.stage.value();
    CAPTURE(i);
    if (inner)
      CHECK(deeper > 0);
    else
      CHECK(deeper < 0);
    ++(inner ? shadowed : lit);
  }
  CHECK(shadowed > 10);
  CHECK(lit > 20);
}

TEST_CASE(
    "shadow maps are drawn again when what casts moves, and else not; a scene without lights has none") {
  context();
  const CleanScope scope;
  {
    Drawn still(sceneOf());
    still.stage.run(0);
    CHECK(still.stage.ran("lamp_maps[1,3]"));
    still.stage.run(1);
    CHECK_FALSE(still.stage.ran("lamp_maps[1,3]"));
    CHECK_FALSE(still.stage.ran("sun_map"));
  }
  Drawn moving(sceneOf(1));
  moving.stage.run(0);
  moving.stage.run(1);
  CHECK(moving.stage.ran("lamp_maps[1,3]"));
  CHECK(moving.stage.ran("sun_map"));
  // A lamp on a node that turns; the spheres stand still.
  scene::Scene turning = sceneOf();
  const scene::NodeId arm = turning.nodes.add({.name = "arm", .parent = {}, .spin = {0, 1, 0}});
  turning.lamps.edit(turning.lamps.idOf(2)).node = arm;
  Drawn lamp(std::move(turning));
  lamp.stage.run(0);
  const std::vector<float> before = gl::readFloats(lamp.stage.texture("maps"), 0, 6);
  lamp.stage.run(1);
  CHECK(lamp.stage.ran("lamp_maps[1,3]"));
  CHECK_FALSE(lamp.stage.ran("sun_map"));
  lamp.stage.run(30);
  CHECK(gl::readFloats(lamp.stage.texture("maps"), 0, 6) != before);
  scene::Scene dark = sceneOf();
  dark.sun.reset();
  dark.lamps = {};
  moving.stage.world.setScene(std::move(dark));
  CHECK_FALSE(moving.stage.load());  // what is read without `?` is missing
}

}  // namespace lights_test
