// Lights of model files as lights of a scene: units, places, copies, which sun, and how they move.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "engine/scene/files/scene_file.h"
#include "engine/scene/frame/mesh_frame.h"
#include "tests/assets/models/gltf_maker.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::scene;
using weft::test::GltfMaker;
using weft::test::json;

namespace {

json lightNode(int light, json node = json::object()) {
  node["extensions"] = {{"KHR_lights_punctual", {{"light", light}}}};
  return node;
}

// A square with a sun that shines along +X, and a spot at (0, 1, 0) that shines down; each on a node of its own.
GltfMaker litSquare() {
  const double half = std::sqrt(0.5);
  GltfMaker maker;
  maker.square();
  maker.document["extensions"] = {
      {"KHR_lights_punctual",
       {{"lights",
         {{{"type", "directional"}, {"name", "day"}, {"intensity", 20000}, {"color", {1, 0.5, 0.25}}},
          {{"type", "spot"},
           {"name", "spot"},
           {"intensity", 5000},
           {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
          {{"type", "point"}, {"name", "bulb"}, {"intensity", 100}, {"range", 3}}}}}}};
  maker.document["nodes"] = {{{"mesh", 0}, {"children", {1, 2, 3}}},
                             lightNode(0, {{"rotation", {0, -half, 0, half}}}),
                             lightNode(1, {{"rotation", {-half, 0, 0, half}}, {"translation", {0, 1, 0}}}),
                             lightNode(2, {{"translation", {2, 0, 0}}})};
  return maker;
}

Scene load(const TemporaryFolder& folder, const std::string& text, std::size_t warnings = 0) {
  text::Diagnostics diagnostics;
  auto scene =
      loadScene(text.ends_with(".gltf") ? folder.at(text) : folder.write("s.json", text), diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.text());
  CHECK_MESSAGE(diagnostics.size() == warnings, diagnostics.text());
  for (const text::Diagnostic& d : diagnostics.items()) CHECK(d.code == text::Code::modelPartLeftOut);
  return std::move(*scene);
}

void checkNear(glm::vec3 a, glm::vec3 b) {
  CAPTURE(a.x);
  CAPTURE(a.y);
  CAPTURE(a.z);
  CHECK(glm::distance(a, b) < 1e-5f * std::max(1.0f, glm::length(b)));
}

}  // namespace

TEST_CASE("a model's lights are a sun in lux and lamps in candela, divided by nits, at their nodes") {
  const TemporaryFolder folder;
  folder.write("m.gltf", litSquare().gltf());
  const Scene scene = load(folder, R"({"nits": 1000, "models": {"m": {"file": "m.gltf"}}})");
  REQUIRE(scene.sun);
  checkNear(scene.sun->irradiance, {20, 10, 5});
  CHECK(scene.sun->shadow);
  REQUIRE(scene.lamps.size() == 2);
  const Lamp &spot = scene.lamps.rows()[0], &bulb = scene.lamps.rows()[1];
  CHECK(spot.name == "spot");
  checkNear(spot.intensity, glm::vec3(5));
  CHECK(spot.cosInner == doctest::Approx(std::cos(0.25)));
  CHECK(spot.cosOuter == doctest::Approx(std::cos(0.5)));
  CHECK(spot.range == doctest::Approx(std::sqrt(5 / 1e-3)));  // where a thousandth of a unit is left
  CHECK_FALSE(spot.shadow);
  CHECK(bulb.cosOuter == -1);
  CHECK(bulb.range == 3);
  MeshFrame frame;
  frame.update(scene, 1, 0, 0);
  checkNear(frame.sun()->direction, {-1, 0, 0});  // towards it: it shines along +X
  checkNear(frame.lamps()[0].position, {0, 1, 0});
  checkNear(frame.lamps()[0].direction, {0, -1, 0});
  checkNear(frame.lamps()[1].position, {2, 0, 0});
}

TEST_CASE(
    "copies of a model have lamps of their own; a scale moves them and leaves strength and range alone") {
  const TemporaryFolder folder;
  folder.write("m.gltf", litSquare().gltf());
  const Scene scene =
      load(folder, R"({"models": {"m": {"file": "m.gltf", "count": [2, 1, 1], "spacing": 10, "scale": 3,
    "rotation": [0, 90, 0], "lamp_shadows": true}}})");
  REQUIRE(scene.lamps.size() == 4);
  CHECK(scene.lamps.rows()[3].range == 3);
  CHECK(scene.lamps.rows()[3].intensity == scene.lamps.rows()[1].intensity);
  CHECK(scene.lamps.rows()[3].shadow);
  MeshFrame frame;
  frame.update(scene, 1, 0, 0);
  checkNear(frame.lamps()[0].position, {-5, 3, 0});
  checkNear(frame.lamps()[1].position, {-5, 0, -6});  // a quarter turn about Y takes +X to -Z
  checkNear(frame.lamps()[3].position, {5, 0, -6});
  checkNear(frame.sun()->direction, {0, 0, 1});
}

TEST_CASE("the sun of a scene file comes first, then that of the first model; lights can be left out") {
  const TemporaryFolder folder;
  folder.write("m.gltf", litSquare().gltf());
  const Scene own = load(folder, R"({"sun": {"direction": [0, 1, 0], "lux": 10000},
    "models": {"a": {"file": "m.gltf"}, "b": {"file": "m.gltf"}}})");
  CHECK(own.sun->direction == glm::vec3(0, 1, 0));
  CHECK(own.sun->irradiance == glm::vec3(1));
  CHECK_FALSE(own.sun->node.valid());
  CHECK(own.lamps.size() == 4);
  const Scene two = load(
      folder, R"({"models": {"a": {"file": "m.gltf"}, "b": {"file": "m.gltf", "rotation": [0, 90, 0]}}})", 1);
  MeshFrame frame;
  frame.update(two, 1, 0, 0);
  checkNear(frame.sun()->direction, {-1, 0, 0});
  const Scene dark = load(folder, R"({"models": {"a": {"file": "m.gltf", "lights": false}}})");
  CHECK_FALSE(dark.sun);
  CHECK(dark.lamps.size() == 0);
}

TEST_CASE("a model file with lights is a scene without another sun") {
  const TemporaryFolder folder;
  GltfMaker maker = litSquare();
  folder.write("day.gltf", maker.gltf());
  const Scene day = load(folder, "day.gltf");
  CHECK(day.sun->node.valid());
  CHECK(day.lamps.size() == 2);
  maker.document["nodes"][0]["children"] = {3};
  maker.document["nodes"][1] = maker.document["nodes"][2] = json::object();
  folder.write("lamp.gltf", maker.gltf());
  const Scene lamp = load(folder, "lamp.gltf");
  CHECK_FALSE(lamp.sun);
  CHECK(lamp.lamps.size() == 1);
  folder.write("none.gltf", GltfMaker().square().gltf());
  CHECK(load(folder, "none.gltf").sun->irradiance.x > 0);
}

TEST_CASE("lights go where their nodes go: by spin, velocity and animation") {
  const TemporaryFolder folder;
  GltfMaker maker = litSquare();
  maker.document["animations"] = {
      {{"name", "rise"},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 3}, {"path", "translation"}}}}}},
       {"samplers",
        {{{"input", maker.floats({0, 2}, 1)}, {"output", maker.floats({2, 0, 0, 2, 8, 0}, 3)}}}}}};
  folder.write("m.gltf", maker.gltf());
  const Scene scene = load(
      folder,
      R"({"models": {"m": {"file": "m.gltf", "animation": "rise", "spin": 90, "velocity": [0, 0, 5]}}})");
  MeshFrame frame;
  for (const double time : {0.0, 0.5, 1.0, 1.75}) {
    CAPTURE(time);
    frame.update(scene, 1, time, time - 0.1);
    const double turn = time * 3.14159265358979 / 2;
    const auto c = static_cast<float>(std::cos(turn)), s = static_cast<float>(std::sin(turn));
    const auto t = static_cast<float>(time);
    checkNear(frame.sun()->direction, {-c, 0, s});
    checkNear(frame.lamps()[0].position, {0, 1, 5 * t});
    checkNear(frame.lamps()[0].direction, {0, -1, 0});
    checkNear(frame.lamps()[1].position, {2 * c, 4 * t, 5 * t - 2 * s});
  }
  const std::uint64_t moving = frame.lightsGeneration();
  frame.update(scene, 1, 1.8, 1.75);
  CHECK(frame.lightsGeneration() != moving);
  const Scene still = load(folder, R"({"models": {"m": {"file": "m.gltf"}}})");
  frame.update(still, 2, 0, 0);
  const std::uint64_t standing = frame.lightsGeneration();
  frame.update(still, 2, 1, 0);
  CHECK(frame.lightsGeneration() == standing);
}

TEST_CASE("a model that brings more lamps than a scene may have is an error") {
  const TemporaryFolder folder;
  folder.write("m.gltf", litSquare().gltf());
  text::Diagnostics diagnostics;
  CHECK_FALSE(
      loadScene(folder.write("s.json", R"({"models": {"m": {"file": "m.gltf", "count": [200, 1, 200]}}})"),
                diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  CHECK(diagnostics.items()[0].code == text::Code::badSceneValue);
  CHECK(diagnostics.items()[0].found == "40000 copies of 2 lamps");
  GltfMaker maker = litSquare();
  for (int i = 0; i < 65540; ++i) {
    maker.document["nodes"][0]["children"].push_back(4 + i);
    maker.document["nodes"].push_back(lightNode(2));
  }
  text::Diagnostics whole;
  CHECK_FALSE(loadScene(folder.write("many.gltf", maker.gltf()), whole));
  REQUIRE_MESSAGE(whole.size() == 1, whole.text());
  CHECK(whole.items()[0].found == "65543");
}
