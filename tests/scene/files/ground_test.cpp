#include <doctest/doctest.h>

#include "engine/scene/files/scene_file.h"
#include "tests/scene/read_scene.h"

using namespace weft;
using namespace weft::scene;
using text::Code;

namespace {

text::Diagnostic failureOf(std::string_view text) {
  text::Diagnostics diagnostics;
  CHECK_FALSE(test::readScene(text, "s.json", diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  CHECK(diagnostics.items()[0].place.line > 0);
  return diagnostics.items()[0];
}

std::optional<Ground> groundOf(std::string_view text) {
  text::Diagnostics diagnostics;
  const auto scene = test::readScene(text, "s.json", diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.text());
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  return scene->ground;
}

}  // namespace

TEST_CASE("a scene has a ground when its file says so: one that shows the environment, or a surface") {
  CHECK_FALSE(groundOf("{}"));
  const auto plain = groundOf(R"({"ground": {}})");
  REQUIRE(plain);
  CHECK(plain->height == 0);
  CHECK_FALSE(plain->albedo);
  const auto surface = groundOf(R"({"ground": {"height": -1.5, "albedo": [0.25, 0.5, 1], "radius": 30}})");
  REQUIRE(surface);
  CHECK(surface->height == -1.5f);
  CHECK(surface->albedo == glm::vec3(0.25f, 0.5f, 1));
  CHECK(surface->radius == 30);
  CHECK(groundOf(R"({"ground": {"albedo": [0, 0, 0]}})")->radius == 100);
}

TEST_CASE("what is wrong with a ground is said with its place") {
  CHECK(failureOf(R"({"ground": 3})").code == Code::wrongType);
  CHECK(failureOf(R"({"ground": {"level": 3}})").code == Code::unknownKey);
  CHECK(failureOf(R"({"ground": {"albedo": [0, 2, 0]}})").code == Code::badSceneValue);
  CHECK(failureOf(R"({"ground": {"albedo": [0, 1, 0], "radius": 0}})").code == Code::badSceneValue);
  CHECK(failureOf(R"({"ground": {"height": 1e12}})").code == Code::badSceneValue);
  const text::Diagnostic alone = failureOf(R"({"ground": {"radius": 5}})");
  CHECK(alone.code == Code::badSceneValue);
  CHECK_FALSE(alone.expected.empty());
  CHECK_FALSE(alone.found.empty());
  CHECK_FALSE(alone.hint.empty());
}
