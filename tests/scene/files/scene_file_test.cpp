#include "engine/scene/files/scene_file.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>

#include "engine/text/files/file.h"
#include "tests/scene/read_scene.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::scene;

namespace {

Scene loadedScene(const std::string& path) {
  text::Diagnostics diagnostics;
  auto scene = loadScene(path, diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.text());
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  return std::move(*scene);
}

Scene readGoodScene(std::string_view text) {
  text::Diagnostics diagnostics;
  auto scene = test::readScene(text, "s.json", diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.text());
  return std::move(*scene);
}

text::Diagnostic sceneFailureOf(std::string_view text) {
  text::Diagnostics diagnostics;
  CHECK_FALSE(test::readScene(text, "s.json", diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 1, text << "\n" << diagnostics.text());
  return diagnostics.items()[0];
}

const char* kTwoMaterials =
    R"("materials": {"a": {"albedo": [1, 0, 0]}, "b": {"albedo": [0, 1, 0], "metallic": 1, "roughness": 0.1}})";

std::string withMaterials(const std::string& rest) {
  return std::string("{") + kTwoMaterials + ", " + rest + "}";
}

}  // namespace

TEST_CASE("spheres.json: 10 x 10 in the XY plane, first material top left, going right then down") {
  const Scene scene = loadedScene(WEFT_SOURCE_DIR "/scenes/spheres.json");
  REQUIRE(scene.spheres.size() == 100);
  const auto spheres = scene.spheres.rows();
  CHECK(spheres[0].center == glm::vec3(-11.25f, 11.25f, 0));
  CHECK(spheres[1].center == glm::vec3(-8.75f, 11.25f, 0));
  CHECK(spheres[10].center == glm::vec3(-11.25f, 8.75f, 0));
  CHECK(spheres[99].center == glm::vec3(11.25f, -11.25f, 0));
  glm::vec3 sum(0);
  for (std::size_t i = 0; i < 100; ++i) {
    sum += spheres[i].center;
    CHECK(spheres[i].radius == 1);
    CHECK(scene.materials.find(spheres[i].material)->name == scene.materials.rows()[i].name);
  }
  CHECK(glm::length(sum) < 1e-4f);
  const Camera* camera = findCamera(scene, "");
  REQUIRE(camera);
  CHECK(camera->name == "front");
  CHECK(camera->pose.position == glm::dvec3(0, 0, 20));
  CHECK(camera->pose.target == glm::dvec3(0, 0, 0));
  CHECK(camera->pose.fovDegrees == 60);
  for (const char* name : {"left", "right", "top", "bottom"}) CHECK(findCamera(scene, name));
  CHECK(scene.files.size() == 2);
  CHECK_FALSE(isMoving(scene, DrawList::spheres));
}

TEST_CASE("every scene of the folder loads") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WEFT_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".json") continue;  // beside them: environments
    loadedScene(entry.path().string());
    ++count;
  }
  CHECK(count >= 3);
}

TEST_CASE("the example of docs/scenes.md loads") {
  text::Diagnostics diagnostics;
  const auto page = text::readFile(WEFT_SOURCE_DIR "/docs/scenes.md", diagnostics);
  REQUIRE(page);
  const std::size_t begin = page->find("```json") + 7, end = page->find("```", begin);
  const auto scene = test::readScene(std::string_view(*page).substr(begin, end - begin),
                                     WEFT_SOURCE_DIR "/scenes/example.json", diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.text());
  CHECK(scene->cameras.size() == 3);
  CHECK(scene->spheres.size() == 102);
}

TEST_CASE("a grid of any shape is centered; materials repeat; layers go away from the viewer") {
  const Scene scene = readGoodScene(withMaterials(
      R"("grid": {"count": [3, 2, 4], "spacing": 2, "radius": 0.5, "center": [10, 0, 0], "velocity": [0, 1, 0], "materials": ["a", "b"], "lists": ["spheres", "shadow_casters"]})"));
  REQUIRE(scene.spheres.size() == 24);
  const auto spheres = scene.spheres.rows();
  CHECK(spheres[0].center == glm::vec3(8, 1, 3));
  CHECK(spheres[5].center == glm::vec3(12, -1, 3));
  CHECK(spheres[23].center == glm::vec3(12, -1, -3));
  CHECK(scene.materials.find(spheres[0].material)->name == "a");
  CHECK(scene.materials.find(spheres[3].material)->name == "b");
  CHECK(Members(DrawList::shadow_casters, scene).count(scene.spheres) == 24);
  CHECK(Members(DrawList::opaque, scene).count(scene.spheres) == 0);
  CHECK(isMoving(scene, DrawList::spheres));
}

TEST_CASE("a million spheres") {
  const Scene scene =
      readGoodScene(withMaterials(R"("grid": {"count": [100, 100, 100], "materials": ["a", "b"]})"));
  CHECK(scene.spheres.size() == 1000000);
  CHECK(sizeof(Sphere) <= 40);
  std::vector<Instance> instances;
  fillInstances(scene, DrawList::spheres, 0, 0, instances);
  CHECK(instances.size() == 1000000);
  CHECK(instances.back().center == glm::vec3(123.75f, -123.75f, -123.75f));
}

TEST_CASE("spheres, cameras, lights and the sun, with comments") {
  const Scene scene = readGoodScene(withMaterials(R"(
    // three ways to say a material
    "spheres": [
      {"center": [1, 2, 3], "radius": 2, "material": "b"},
      {"center": [0, 0, 0], "material": {"albedo": [0.5, 0.5, 0.5]}, "velocity": [1, 0, 0], "lists": ["transparent_spheres"]}
    ],
    "cameras": {
      "turn": {"position": [0, 0, 5], "orbit": 30, "near": 0.25},
      "fly": {"path": [{"time": 0, "position": [0, 0, 9]}, {"time": 2, "position": [0, 4, 9], "target": [0, 1, 0], "fov": 30}]}
    },
    "lamps": {"key": {"position": [0, 5, 0], "candela": 20000, "color": [1, 0.5, 0.25], "range": 20, "shadow": true}},
    "sun": {"direction": [0, 3, 4], "lux": 30000, "color": [1, 1, 0.5]})"));
  REQUIRE(scene.spheres.size() == 2);
  CHECK(scene.spheres.rows()[0].radius == 2);
  CHECK(scene.materials.find(scene.spheres.rows()[0].material)->name == "b");
  CHECK(scene.materials.find(scene.spheres.rows()[1].material)->albedo == glm::vec3(0.5f));
  CHECK(scene.materials.find(scene.spheres.rows()[1].material)->roughness == 0.5f);
  CHECK(isMoving(scene, DrawList::transparent_spheres));
  CHECK_FALSE(isMoving(scene, DrawList::spheres));
  CHECK(findCamera(scene, "turn")->orbitDegreesPerSecond == 30);
  CHECK(findCamera(scene, "turn")->pose.nearPlane == 0.25);
  CHECK(poseAt(*findCamera(scene, "fly"), 1).position == glm::dvec3(0, 2, 9));
  CHECK(poseAt(*findCamera(scene, "fly"), 1).fovDegrees == 45);
  REQUIRE(scene.lamps.size() == 1);
  CHECK(scene.lamps.rows()[0].shadow);
  CHECK(scene.lamps.rows()[0].intensity == glm::vec3(2, 1, 0.5f));
  REQUIRE(scene.sun);
  CHECK(scene.sun->direction.y == doctest::Approx(0.6));
}

TEST_CASE("a library names materials too, and is read once") {
  const TemporaryFolder folder;
  folder.write(
      "m.json",
      R"([{"name": "x", "albedo": [1, 1, 1], "metallic": 0, "roughness": 0}, {"name": "y", "albedo": [0, 0, 0], "metallic": 0, "roughness": 0}])");
  const Scene scene = loadedScene(folder.write("s.json", R"({"library": "m.json",
    "grid": {"count": [2, 1, 1], "materials": "./m.json"}, "spheres": [{"center": [0, 0, 0], "material": "y"}]})"));
  CHECK(scene.materials.size() == 2);
  CHECK(scene.spheres.rows()[2].material == scene.spheres.rows()[1].material);
  CHECK(scene.files == std::vector<std::string>{folder.at("s.json"), folder.at("m.json")});
}

TEST_CASE("an empty scene has the default camera and its file's name") {
  const Scene scene = readGoodScene("{}");
  CHECK(scene.name == "s");
  CHECK(findCamera(scene, "")->pose.position == glm::dvec3(0, 0, 20));
  CHECK(scene.spheres.size() == 0);
}

TEST_CASE("every mistake has its code and place") {
  using text::Code;
  CHECK(sceneFailureOf("").code == Code::notJson);
  CHECK(sceneFailureOf("[]").code == Code::wrongType);
  const text::Diagnostic graph = sceneFailureOf(R"({ "resources": {}, "passes": [], "present": "x" })");
  CHECK(graph.code == Code::wrongType);
  CHECK(graph.message == "this file has \"passes\": it is a graph, not a scene");
  // Which materials a library that is not there holds is not known.
  CHECK(sceneFailureOf(R"({ "library": "none.json", "spheres": [{ "center": [0, 0, 0], "material": "a" }] })")
            .code == Code::unreadableFile);
  CHECK(sceneFailureOf(R"({ "extends": "g.json", "set": { "a": 1 } })").code == Code::wrongType);
  const text::Diagnostic key = sceneFailureOf("{\n  \"sphere\": []\n}");
  CHECK(key.code == Code::unknownKey);
  CHECK(key.place.line == 2);
  CHECK(key.place.column == 3);
  CHECK(key.hint == "did you mean 'spheres'?");
  CHECK(sceneFailureOf(R"({"cameras": {"a": {"position": [0, 0, 1], "fovv": 3}}})").hint ==
        "did you mean 'fov'?");
  CHECK(sceneFailureOf(R"({"cameras": {"a": {}}})").code == Code::missingKey);
  CHECK(sceneFailureOf(R"({"cameras": {"a": {"position": [0, 0, 0]}}})").message.find("target") !=
        std::string::npos);
  CHECK(sceneFailureOf(R"({"cameras": {"a": {"position": [0, 0, 1], "fov": 180}}})").code ==
        Code::badSceneValue);
  CHECK(sceneFailureOf(R"({"cameras": {"a": {"position": [0, 0, 1], "near": 0}}})").code ==
        Code::badSceneValue);
  CHECK(sceneFailureOf(R"({"cameras": {"a": {"path": []}}})").code == Code::badSceneValue);
  CHECK(sceneFailureOf(R"({"cameras": {"a": {"orbit": 1, "path": [{"time": 0, "position": [0, 0, 1]}]}}})")
            .code == Code::badSceneValue);
  CHECK(
      sceneFailureOf(
          R"({"cameras": {"a": {"path": [{"time": 1, "position": [0, 0, 1]}, {"time": 1, "position": [0, 0, 2]}]}}})")
          .code == Code::badSceneValue);
  CHECK(sceneFailureOf(R"({"materials": {"a": {"albedo": [0, 0, 2]}}})").code == Code::badMaterialValue);
  CHECK(sceneFailureOf(R"({"grid": {"count": [1, 1, 1], "materials": "nowhere.json"}})").code ==
        Code::unreadableFile);
  CHECK(sceneFailureOf(withMaterials(R"("grid": {"count": [1, 1, 1]})")).code == Code::missingKey);
  CHECK(sceneFailureOf(withMaterials(R"("grid": {"count": [0, 1, 1], "materials": ["a"]})")).code ==
        Code::badSceneValue);
  CHECK(sceneFailureOf(withMaterials(R"("grid": {"count": [1.5, 1, 1], "materials": ["a"]})")).code ==
        Code::badSceneValue);
  CHECK(
      sceneFailureOf(withMaterials(R"("grid": {"count": [60000, 60000, 60000], "materials": ["a"]})")).code ==
      Code::badSceneValue);
  CHECK(sceneFailureOf(withMaterials(R"("grid": {"count": [1, 1, 1], "radius": -1, "materials": ["a"]})"))
            .code == Code::badSceneValue);
  CHECK(sceneFailureOf(withMaterials(R"("grid": {"count": [1, 1, 1], "materials": []})")).code ==
        Code::unknownMaterial);
  const text::Diagnostic material =
      sceneFailureOf(withMaterials(R"("grid": {"count": [1, 1, 1], "materials": ["c"]})"));
  CHECK(material.code == Code::unknownMaterial);
  CHECK(material.hint.find("a, b") != std::string::npos);
  CHECK(sceneFailureOf(R"({"spheres": [{"center": [0, 0, 0], "material": "gold"}]})").code ==
        Code::unknownMaterial);
  CHECK(sceneFailureOf(R"({"spheres": [{"center": [0, 0, 0], "material": 3}]})").code == Code::wrongType);
  CHECK(sceneFailureOf(R"({"spheres": [3]})").code == Code::wrongType);
  const text::Diagnostic list = sceneFailureOf(
      R"({"spheres": [{"center": [0, 0, 0], "material": {"albedo": [1, 1, 1]}, "lists": ["sphere"]}]})");
  CHECK(list.code == Code::unknownSceneList);
  CHECK(list.hint == "did you mean 'spheres'?");
  CHECK(sceneFailureOf(R"({"lamps": {"a": {"position": [0, 0, 0], "candela": -1}}})").code ==
        Code::badSceneValue);
  CHECK(sceneFailureOf(R"({"sun": {"direction": [0, 0, 0], "lux": 1}})").code == Code::badSceneValue);
  CHECK(sceneFailureOf(R"({"sun": 3})").code == Code::wrongType);
  CHECK(sceneFailureOf(R"({"sun": {"direction": [0, 1, 0], "direction": [0, 1, 0], "lux": 1}})").code ==
        Code::duplicateKey);
}

TEST_CASE("a name in both the library and the scene, a broken library, a missing scene, a directory") {
  const TemporaryFolder folder;
  folder.write("m.json", R"([{"name": "x", "albedo": [1, 1, 1], "metallic": 0, "roughness": 0}])");
  folder.write("broken.json", R"([{"name": "x", "albedo": [1, 1, 7], "metallic": 0, "roughness": 0}])");
  text::Diagnostics diagnostics;
  CHECK_FALSE(
      loadScene(folder.write("a.json", R"({"library": "m.json", "materials": {"x": {"albedo": [0, 0, 0]}}})"),
                diagnostics));
  CHECK(diagnostics.contains(text::Code::duplicateMaterial));
  diagnostics.clear();
  std::vector<std::string> files;
  CHECK_FALSE(loadScene(folder.write("b.json", R"({"library": "broken.json"})"), diagnostics, &files));
  CHECK(files == std::vector{folder.at("b.json"), folder.at("broken.json")});
  REQUIRE(diagnostics.size() == 1);
  CHECK(*diagnostics.items()[0].place.file == folder.at("broken.json"));
  diagnostics.clear();
  CHECK_FALSE(loadScene(folder.at("missing.json"), diagnostics, &files));
  CHECK(files == std::vector{folder.at("missing.json")});
  CHECK_FALSE(loadScene(folder.at(""), diagnostics));
  CHECK(diagnostics.errorCount() == 2);
}

TEST_CASE("a camera and a material library chosen from outside the file") {
  const TemporaryFolder folder;
  const std::string library =
      folder.write("m.json", R"([{"name": "x", "albedo": [0.5, 1, 1], "metallic": 0, "roughness": 0}])");
  const std::string path = folder.write("s.json", R"({
    "materials": {"a": {"albedo": [1, 0, 0]}},
    "cameras": {"front": {"position": [0, 0, 9]}, "top": {"position": [0, 9, 0]}, "side": {"position": [9, 0, 0]}},
    "grid": {"count": [2, 1, 1], "materials": ["a"]}})");
  text::Diagnostics diagnostics;
  std::vector<std::string> files;
  const auto scene = loadScene(path, diagnostics, &files, {.camera = "top", .materials = library});
  REQUIRE_MESSAGE(scene, diagnostics.text());
  CHECK(files == std::vector{path, library});
  CHECK(findCamera(*scene, "")->name == "top");
  CHECK(scene->cameras.size() == 3);
  for (const Sphere& sphere : scene->spheres.rows())
    CHECK(scene->materials.find(sphere.material)->name == "x");

  CHECK_FALSE(loadScene(path, diagnostics, nullptr, {.camera = "tpo"}));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == text::Code::badSceneValue);
  CHECK(diagnostics.items()[0].hint == "did you mean 'top'?");
  diagnostics.clear();
  CHECK_FALSE(
      loadScene(folder.write("e.json", "{}"), diagnostics, nullptr, {.camera = "c", .materials = library}));
  CHECK(diagnostics.contains(text::Code::badSceneValue));
  CHECK(diagnostics.contains(text::Code::unknownMaterial));
  diagnostics.clear();
  CHECK_FALSE(loadScene(path, diagnostics, nullptr, {.materials = folder.at("missing.json")}));
  CHECK(diagnostics.contains(text::Code::unreadableFile));
}

TEST_CASE("everything wrong is reported at once") {
  text::Diagnostics diagnostics;
  CHECK_FALSE(test::readScene(
      R"({"nam": "x", "sun": 3, "spheres": [{"center": [0, 0], "material": "q"}], "grid": {"count": [1, 1, 1], "materials": "no.json"}})",
      "s.json", diagnostics));
  CHECK(diagnostics.errorCount() == 4);  // 'q' may be a material of no.json
}
