// KHR_lights_punctual: values by hand and against Assimp, what is left out, and files that lie.
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <functional>

#include "tests/assets/models/failure.h"
#include "tests/assets/models/loading.h"

using namespace weft;
using namespace weft::assets;
using text::Code;
using weft::test::GltfMaker;
using weft::test::json;
using weft::test::make;

namespace {

// A square, and a row of lights, each on a node of its own.
GltfMaker withLights(const json& lights) {
  GltfMaker maker;
  maker.square();
  maker.document["extensionsUsed"] = {"KHR_lights_punctual"};
  maker.document["extensions"] = {{"KHR_lights_punctual", {{"lights", lights}}}};
  for (std::size_t i = 0; i < lights.size(); ++i) {
    maker.document["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    maker.document["scenes"][0]["nodes"].push_back(i + 1);
  }
  return maker;
}

json spot(json cone) {
  return {{"type", "spot"}, {"intensity", 3}, {"spot", std::move(cone)}};
}

text::Diagnostic failureWith(const json& lights, const std::function<void(json&)>& change = {}) {
  GltfMaker maker = withLights(lights);
  if (change) change(maker.document);
  const TemporaryFolder folder;
  return test::failureOf(folder, "m.gltf", maker.gltf());
}

}  // namespace

TEST_CASE("every value of a light arrives, and what a file leaves out is what the extension says") {
  const Model model = make(withLights({{{"type", "directional"}, {"name", "day"}, {"intensity", 5000}},
                                       {{"type", "point"}, {"color", {1, 0.5, 0}}, {"range", 7}},
                                       spot({{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}),
                                       {{"type", "spot"}}}));
  REQUIRE(model.lights.size() == 4);
  const ModelLight &day = model.lights[0], &lamp = model.lights[1], &aimed = model.lights[2],
                   &plain = model.lights[3];
  CHECK(day.kind == ModelLightKind::sun);
  CHECK(day.name == "day");
  CHECK(day.intensity == 5000);
  CHECK(day.color == glm::vec3{1, 1, 1});
  CHECK(lamp.kind == ModelLightKind::point);
  CHECK(lamp.name == "light 1");
  CHECK(lamp.color == glm::vec3{1, 0.5f, 0});
  CHECK(lamp.intensity == 1);
  CHECK(lamp.range == 7);
  CHECK(aimed.kind == ModelLightKind::spot);
  CHECK(aimed.intensity == 3);
  CHECK(aimed.range == 0);
  CHECK(aimed.inner == 0.25f);
  CHECK(aimed.outer == 0.5f);
  CHECK(plain.inner == 0);
  CHECK(plain.outer == doctest::Approx(0.78539816));
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(model.nodes[model.lights[i].node].name == "node " + std::to_string(i + 1));
}

TEST_CASE("lights are those that Assimp reads, at the same nodes") {
  GltfMaker maker =
      withLights({{{"type", "directional"}, {"intensity", 30000}, {"color", {1, 0.8, 0.6}}},
                  {{"type", "point"}, {"name", "bulb"}, {"intensity", 800}, {"color", {0.2, 0.4, 1}}},
                  spot({{"innerConeAngle", 0.3}, {"outerConeAngle", 0.9}})});
  json& nodes = maker.document["nodes"];
  // The spot on a node below another, which turns and scales it.
  nodes[1]["rotation"] = {0.5, 0.5, -0.5, 0.5};
  nodes[2]["translation"] = {1, 2, 3};
  nodes[2]["rotation"] = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};
  nodes[2]["scale"] = {2, 2, 2};
  nodes[2]["children"] = {3};
  nodes[3]["translation"] = {0, 0, 1};
  nodes[3]["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  maker.document["scenes"][0]["nodes"] = {0, 1, 2};
  const TemporaryFolder folder;
  const std::string path = folder.write("m.gltf", maker.gltf());
  const Model model = test::loadGood(path);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, 0);
  REQUIRE(scene);
  REQUIRE(scene->mNumLights == model.lights.size());
  int compared = 0;
  for (unsigned l = 0; l < scene->mNumLights; ++l) {
    const aiLight& other = *scene->mLights[l];
    const aiLightSourceType kinds[] = {aiLightSource_DIRECTIONAL, aiLightSource_POINT, aiLightSource_SPOT};
    for (const ModelLight& mine : model.lights) {
      if (kinds[static_cast<int>(mine.kind)] != other.mType) continue;
      ++compared;
      for (int c = 0; c < 3; ++c)
        CHECK(mine.color[c] * mine.intensity ==
              doctest::Approx(other.mColorDiffuse[static_cast<unsigned>(c)]));
      if (mine.kind == ModelLightKind::spot) {
        CHECK(mine.inner == doctest::Approx(other.mAngleInnerCone));
        CHECK(mine.outer == doctest::Approx(other.mAngleOuterCone));
      }
      // Assimp's light is in the coordinates of the node of its name.
      aiMatrix4x4 world;
      for (const aiNode* node = scene->mRootNode->FindNode(other.mName); node; node = node->mParent)
        world = node->mTransformation * world;
      const aiVector3D at = world * other.mPosition, to = (aiMatrix3x3(world) * other.mDirection).Normalize();
      const glm::mat4 m = test::worldOf(model, mine.node);
      const double length = std::hypot(m[2][0], m[2][1], m[2][2]);
      for (int c = 0; c < 3; ++c) {
        CHECK(m[3][c] == doctest::Approx(at[static_cast<unsigned>(c)]).scale(1));
        if (mine.kind != ModelLightKind::point)
          CHECK(-m[2][c] / length == doctest::Approx(to[static_cast<unsigned>(c)]).epsilon(1e-5).scale(1));
      }
      if (mine.kind == ModelLightKind::spot) {
        // By hand: (1, 2, 3) and what a quarter turn makes of (0, 0, 2); it shines down.
        CHECK(m[3][0] == doctest::Approx(3));
        CHECK(-m[2][1] / length == doctest::Approx(-1));
      }
    }
  }
  CHECK(compared == 3);
}

TEST_CASE("one light on several nodes is several; none where no scene shows the node") {
  GltfMaker maker = withLights({{{"type", "point"}}});
  json& nodes = maker.document["nodes"];
  nodes.push_back(nodes[1]);
  nodes.push_back(nodes[1]);
  maker.document["scenes"][0]["nodes"] = {0, 1, 2};
  CHECK(make(maker).lights.size() == 2);
  // Lights that no node names, however wrong they are, stand nowhere.
  maker.document["extensions"]["KHR_lights_punctual"]["lights"].push_back({{"intensity", -1}});
  CHECK(make(maker).lights.size() == 2);
  maker.document["extensionsRequired"] = {"KHR_lights_punctual"};
  CHECK(make(maker).lights.size() == 2);
}

TEST_CASE("of several directional lights the brightest is the sun; lights of an unknown type are left out") {
  const Model model =
      make(withLights({{{"type", "directional"}, {"name", "fill"}, {"intensity", 100}},
                       {{"type", "directional"}, {"name", "key"}, {"intensity", 900}},
                       {{"type", "directional"}, {"intensity", 1000}, {"color", {0.5, 0.5, 0.5}}},
                       {{"type", "area"}, {"intensity", -1}}}),
           3);
  REQUIRE(model.lights.size() == 1);
  CHECK(model.lights[0].name == "key");
  CHECK(model.nodes[model.lights[0].node].name == "node 2");
}

TEST_CASE("lights that lie are one error at their place") {
  const json point = {{"type", "point"}};
  for (const json& index : {json(1), json(-1), json(0.5), json("0"), json(1e300)}) {
    const text::Diagnostic d = failureWith(json::array({point}), [&](json& document) {
      document["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = index;
    });
    CHECK(d.code == Code::badModelValue);
    CHECK(d.pointer == "/nodes/1/extensions/KHR_lights_punctual/light");
    CHECK(d.expected == "an index from 0 to 0");
  }
  CHECK(failureWith(json::array({point}), [](json& document) { document.erase("extensions"); }).expected ==
        "none: the file has no 'lights'");
  for (const auto& [key, value] : std::initializer_list<std::pair<const char*, json>>{{"intensity", -1},
                                                                                      {"intensity", "bright"},
                                                                                      {"intensity", 1e300},
                                                                                      {"range", -1},
                                                                                      {"range", 0},
                                                                                      {"color", {1, -0.5, 1}},
                                                                                      {"color", {1, 1}},
                                                                                      {"color", {1, 1, "x"}},
                                                                                      {"color", 1e300}}) {
    CAPTURE(key);
    json light = point;
    light[key] = value;
    const text::Diagnostic d = failureWith(json::array({light}));
    CHECK(d.code == Code::badModelValue);
    CHECK(d.pointer == std::string("/extensions/KHR_lights_punctual/lights/0/") + key);
    CHECK_FALSE(d.expected.empty());
    CHECK_FALSE(d.found.empty());
  }
  for (const json& cone :
       {json{{"innerConeAngle", 0.5}, {"outerConeAngle", 0.25}}, json{{"innerConeAngle", -0.1}},
        json{{"outerConeAngle", 2}}, json{{"innerConeAngle", 0.8}}})
    CHECK(failureWith(json::array({spot(cone)})).code == Code::badModelValue);
  // No JSON writes what is no number; a node that stands at none was refused before.
  const TemporaryFolder folder;
  std::string text = withLights({{{"type", "point"}, {"intensity", 12345}}}).gltf();
  text.replace(text.find("12345"), 5, "NaN");
  CHECK(test::failureOf(folder, "m.gltf", text).code == Code::notJson);
}
