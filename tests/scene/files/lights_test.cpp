#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "engine/scene/files/reading.h"
#include "engine/scene/files/scene_file.h"
#include "tests/scene/read_scene.h"

using namespace weft;
using namespace weft::scene;

namespace {

Scene readGood(std::string_view text) {
  text::Diagnostics diagnostics;
  auto scene = test::readScene(text, "s.json", diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.text());
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  return std::move(*scene);
}

text::Diagnostic lightsFailureOf(std::string_view text) {
  text::Diagnostics diagnostics;
  CHECK_FALSE(test::readScene(text, "s.json", diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  CHECK(diagnostics.items()[0].place.line > 0);
  return diagnostics.items()[0];
}

}  // namespace

TEST_CASE("lux and candela become scene units by nits, per channel by the color") {
  const Scene scene = readGood(R"({
    "sun": {"direction": [0, 3, 4], "lux": 100000, "color": [1, 0.5, 0.25], "angle": 2, "shadow": false},
    "lamps": {"a": {"position": [1, 2, 3], "candela": 5000, "color": [1, 0.5, 0]}}})");
  REQUIRE(scene.sun);
  CHECK(scene.nits == 10000);
  CHECK(scene.sun->irradiance == glm::vec3(10, 5, 2.5f));
  CHECK(glm::distance(scene.sun->direction, glm::vec3(0, 0.6f, 0.8f)) < 1e-6f);
  CHECK(scene.sun->angle == 2);
  CHECK_FALSE(scene.sun->shadow);
  REQUIRE(scene.lamps.size() == 1);
  const Lamp& lamp = scene.lamps.rows()[0];
  CHECK(lamp.intensity == glm::vec3(0.5f, 0.25f, 0));
  // Where its irradiance falls below a thousandth of a scene unit.
  CHECK(0.5f / (lamp.range * lamp.range) == doctest::Approx(1e-3));
  CHECK(lamp.cosOuter == -1);
  CHECK_FALSE(lamp.shadow);
  const Scene bright = readGood(R"({"nits": 500, "sun": {"direction": [0, 1, 0], "lux": 1000}})");
  CHECK(bright.sun->irradiance == glm::vec3(2));
  CHECK(bright.sun->angle == doctest::Approx(0.53));
  CHECK(bright.sun->shadow);
}

TEST_CASE("a spot has a direction and two half angles") {
  const Scene scene = readGood(R"({"lamps": {
    "a": {"position": [0, 0, 0], "candela": 1, "direction": [0, -2, 0], "inner": 20, "outer": 60, "range": 7, "shadow": true, "radius": 0.5},
    "b": {"position": [0, 0, 0], "candela": 1, "direction": [0, -2, 0]}}})");
  const Lamp &a = scene.lamps.rows()[0], &b = scene.lamps.rows()[1];
  CHECK(a.direction == glm::vec3(0, -1, 0));
  CHECK(a.cosInner == doctest::Approx(std::cos(20 * 3.14159265358979 / 180)));
  CHECK(a.cosOuter == doctest::Approx(0.5));
  CHECK(a.range == 7);
  CHECK(a.shadow);
  CHECK(a.radius == 0.5f);
  CHECK(b.cosInner == 1);
  CHECK(b.cosOuter == doctest::Approx(std::sqrt(0.5)));
}

TEST_CASE("a lamp with a size is a rectangle with level sides, wide to one side where sizes are unknown") {
  const Scene scene = readGood(R"({"lamps": {
    "box": {"position": [0, 3, 0], "candela": 1, "direction": [3, 0, -4], "size": [4, 1], "shadow": true},
    "roof": {"position": [0, 3, 0], "candela": 1, "direction": [0, -1, 0], "size": [4, 1]}}})");
  const Lamp &box = scene.lamps.rows()[0], &roof = scene.lamps.rows()[1];
  CHECK(glm::distance(box.across, glm::vec3(1.6f, 0, 1.2f)) < 1e-6f);
  CHECK(glm::distance(box.up, glm::vec3(0, 0.5f, 0)) < 1e-6f);
  CHECK(glm::dot(glm::cross(box.across, box.up), box.direction) < 0);
  CHECK(box.cosInner == 1);
  CHECK(std::abs(box.cosOuter) < 1e-6f);
  CHECK(glm::distance(roof.across, glm::vec3(2, 0, 0)) < 1e-6f);
  CHECK(glm::distance(roof.up, glm::vec3(0, 0, -0.5f)) < 1e-6f);
}

TEST_CASE("a grid of lamps takes its colors in turn") {
  const Scene scene = readGood(
      R"({"lamp_grids": {"g": {"count": [3, 1, 2], "spacing": 2, "center": [0, 5, 0], "candela": 10000,
    "colors": [[1, 0, 0], [0, 1, 0]], "range": 3}}})");
  REQUIRE(scene.lamps.size() == 6);
  CHECK(scene.lamps.rows()[0].position == glm::vec3(-2, 5, 1));
  CHECK(scene.lamps.rows()[1].position == glm::vec3(0, 5, 1));
  CHECK(scene.lamps.rows()[5].position == glm::vec3(2, 5, -1));
  CHECK(scene.lamps.rows()[0].intensity == glm::vec3(1, 0, 0));
  CHECK(scene.lamps.rows()[1].intensity == glm::vec3(0, 1, 0));
  CHECK(scene.lamps.rows()[2].intensity == glm::vec3(1, 0, 0));
  CHECK(scene.lamps.rows()[4].name == "g[4]");
  CHECK(scene.lamps.rows()[4].range == 3);
}

TEST_CASE("lights that cannot be are errors with a place") {
  using text::Code;
  CHECK(lightsFailureOf(R"({"sun": {"direction": [0, 0, 0], "lux": 1}})").code == Code::badSceneValue);
  CHECK(lightsFailureOf(R"({"sun": {"direction": [0, 1, 0]}})").code == Code::missingKey);
  CHECK(lightsFailureOf(R"({"sun": {"direction": [0, 1, 0], "lux": -1}})").code == Code::badSceneValue);
  CHECK(lightsFailureOf(R"({"sun": {"direction": [0, 1, 0], "lux": 1, "irradiance": [1, 1, 1]}})").code ==
        Code::unknownKey);
  CHECK(lightsFailureOf(R"({"nits": 0})").code == Code::badSceneValue);
  CHECK(lightsFailureOf(R"({"lamps": {"a": {"candela": 1}}})").code == Code::missingKey);
  CHECK(lightsFailureOf(R"({"lamps": {"a": {"position": [0, 0, 0], "candela": 1, "color": [2, 0, 0]}}})")
            .code == Code::badSceneValue);
  CHECK(lightsFailureOf(R"({"lamps": {"a": {"position": [0, 0, 0], "candela": 1, "outer": 30}}})")
            .hint.find("direction") != std::string::npos);
  CHECK(
      lightsFailureOf(
          R"({"lamps": {"a": {"position": [0, 0, 0], "candela": 1, "direction": [0, 1, 0], "inner": 50, "outer": 30}}})")
          .found == "50");
  CHECK(lightsFailureOf(R"({"lamps": {"a": {"position": [0, 0, 0], "candela": 1, "direction": [0, 0, 0]}}})")
            .code == Code::badSceneValue);
  CHECK(lightsFailureOf(R"({"lamps": {"a": {"position": [0, 0, 0], "candela": 1, "size": [1, 1]}}})")
            .message.find("a size but no 'direction'") != std::string::npos);
  for (const char* more : {"\"inner\": 3", "\"outer\": 30", "\"radius\": 0.1"})
    CHECK(
        lightsFailureOf(
            R"({"lamps": {"a": {"position": [0, 0, 0], "candela": 1, "direction": [0, 1, 0], "size": [1, 1], )" +
            std::string(more) + "}}}")
            .message.find("a size and also") != std::string::npos);
  for (const char* size : {"[1]", "[1, 1, 1]", "2"})
    CHECK(lightsFailureOf(
              R"({"lamps": {"a": {"position": [0, 0, 0], "candela": 1, "direction": [0, 1, 0], "size": )" +
              std::string(size) + "}}}")
              .code == Code::wrongType);
  CHECK(
      lightsFailureOf(
          R"({"lamps": {"a": {"position": [0, 0, 0], "candela": 1, "direction": [0, 1, 0], "size": [1, 0]}}})")
          .code == Code::badSceneValue);
  const text::Diagnostic many =
      lightsFailureOf(R"({"lamp_grids": {"g": {"count": [65536, 65536, 2], "candela": 1}}})");
  CHECK(many.expected == fmt::format("at most {} in all", kMaxLamps));
  CHECK(lightsFailureOf(R"({"point_lights": {}})").code == Code::unknownKey);
}
