#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <stop_token>

#include "engine/scene/files/scene_file.h"
#include "engine/scene/frame/mesh_frame.h"
#include "tests/assets/models/gltf_maker.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::scene;

namespace {

const std::string kTop = WEFT_SOURCE_DIR "/";

Scene loadGood(const std::string& path) {
  text::Diagnostics diagnostics;
  auto scene = loadScene(path, diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.text());
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  return std::move(*scene);
}

// One triangle of 1 x 1 in the plane z = 0.
void writeTriangle(const TemporaryFolder& folder) {
  folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

text::Diagnostics failuresOf(const TemporaryFolder& folder, std::string_view text) {
  text::Diagnostics diagnostics;
  CHECK_FALSE(loadScene(folder.write("s.json", text), diagnostics));
  return diagnostics;
}

}  // namespace

TEST_CASE("the scenes with models that come with Weft") {
  const Scene helmet = loadGood(kTop + "scenes/helmet_alone.json");
  CHECK(helmet.meshes.size() == 6);
  CHECK(helmet.meshInstances.size() == 6);
  CHECK(helmet.textures.size() == 15);  // 15 images, two materials that share theirs
  REQUIRE(helmet.meshData);
  CHECK(helmet.meshData->skin.empty());
  CHECK(helmet.lamps.size() == 2);
  CHECK(helmet.files.size() == 18);  // the scene, the .gltf, its .bin and 15 images
  int transparent = 0;
  for (const MeshInstance& instance : helmet.meshInstances.rows())
    transparent += instance.lists == maskOf(DrawList::transparent) ? 1 : 0;
  CHECK(transparent == 1);  // the lenses

  const Scene fox = loadGood(kTop + "scenes/fox.json");
  REQUIRE(fox.animations.size() == 1);
  CHECK(fox.animations.rows()[0].tracks->name == "Walk");
  CHECK(fox.skins.size() == 1);
  CHECK(fox.meshData->skin.size() == fox.meshData->vertices.size());

  const Scene crowd = loadGood(kTop + "scenes/crowd.json");
  CHECK(crowd.meshInstances.size() == 100000);
  CHECK(crowd.meshes.size() == 1);
  CHECK(crowd.nodes.size() == 100000);  // one each
  CHECK(crowd.meshData->indices.size() == 60);
}

TEST_CASE("a model file is a scene: framed, with cameras all round") {
  for (const char* file :
       {"scenes/models/FlightHelmet/FlightHelmet.gltf", "scenes/models/Fox.glb", "scenes/models/rock.obj"}) {
    const Scene scene = loadGood(kTop + file);
    CHECK_FALSE(scene.sun);
    CHECK(scene.cameras.size() == 6);
    CHECK(findCamera(scene, "")->name == "front");
    MeshFrame frame;
    frame.update(scene, 1, 0, 0);
    // Every corner of the box is in every camera's picture.
    const Box box = frame.sceneBounds();
    for (const Camera& camera : scene.cameras.rows())
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                           corner & 4 ? box.high.z : box.low.z);
        const glm::dvec4 clip = projectionMatrix(camera.pose.fovDegrees, 1, camera.pose.nearPlane) *
                                (viewMatrix(camera.pose) * glm::dvec4(p, 1));
        CHECK(clip.w > camera.pose.nearPlane);
        CHECK(std::abs(clip.x) <= clip.w * 1.0001);
        CHECK(std::abs(clip.y) <= clip.w * 1.0001);
      }
  }
  text::Diagnostics diagnostics;
  const auto top = loadScene(kTop + "scenes/models/rock.obj", diagnostics, nullptr, {.camera = "top"});
  REQUIRE(top);
  CHECK(findCamera(*top, "")->name == "top");
  CHECK(top->cameras.size() == 6);
  // Kerbs far apart, lower than a pixel from the front, however many of them turn to it.
  const TemporaryFolder folder;
  std::string kerbs;
  for (int i = 0; i < 40; ++i)
    for (const char* corner : {"-50 0 ", "50 0 ", "50 0.3 ", "-50 0.3 "})
      kerbs += "v " + std::string(corner) + std::to_string(10 * i) + "\n";
  for (int i = 0; i < 40; ++i)
    kerbs += fmt::format("f {} {} {} {}\n", 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 4);
  kerbs += "f 1 157 158 2\n";
  const auto low = loadScene(folder.write("kerbs.obj", kerbs), diagnostics);
  REQUIRE(low);
  CHECK(findCamera(*low, "")->name == "top");
  // A ruler that lies is seen from above, a shoe box from the front, a stick along z from the side.
  const auto firstOf = [&](const std::string& w, const std::string& h, const std::string& d) {
    std::string box;
    for (const std::string& z : {std::string("0"), d})
      box += "v 0 0 " + z + "\nv " + w + " 0 " + z + "\nv " + w + " " + h + " " + z + "\nv 0 " + h + " " + z +
             "\n";
    box += "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";
    const auto scene = loadScene(folder.write("box.obj", box), diagnostics);
    REQUIRE(scene);
    return findCamera(*scene, "")->name;
  };
  CHECK(firstOf("31", "0.17", "3.4") == "top");
  CHECK(firstOf("30", "10", "20") == "front");
  CHECK(firstOf("2.5", "8.5", "69") == "left");
  CHECK_FALSE(loadScene(kTop + "scenes/models/rock.obj", diagnostics, nullptr, {.camera = "tpo"}));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].hint == "did you mean 'top'?");
}

TEST_CASE("a model is placed, turned, copied, and given lists and a material") {
  const TemporaryFolder folder;
  writeTriangle(folder);
  const Scene scene = loadGood(folder.write("s.json", R"({
    "materials": {"red": {"albedo": [1, 0, 0]}},
    "models": {
      "one": {"file": "t.obj", "position": [10, 0, 0], "rotation": [0, 90, 0], "scale": 2},
      "many": {"file": "t.obj", "count": [3, 1, 2], "spacing": 4, "material": "red", "lists": ["opaque"]},
      "odd": {"file": "t.obj", "material": {"albedo": [0, 0, 1]}, "velocity": [0, 3, 0], "spin": 180}
    }})"));
  CHECK(scene.meshes.size() == 1);  // read once
  CHECK(scene.meshData->vertices.size() == 3);
  REQUIRE(scene.meshInstances.size() == 8);
  CHECK(Members(DrawList::opaque, scene).count(scene.meshInstances) == 8);
  CHECK(Members(DrawList::shadow_casters, scene).count(scene.meshInstances) == 2);
  MeshFrame frame;
  frame.update(scene, 1, 1, 0.5);
  const std::span<const MeshRow> rows = frame.rows(DrawList::opaque);
  REQUIRE(rows.size() == 8);
  // 90 degrees about +Y take +X to -Z.
  CHECK(glm::distance(rows[0].transform * glm::vec4(1, 0, 0, 1), glm::vec4(10, 0, -2, 1)) < 1e-5f);
  CHECK(glm::distance(rows[1].transform[3], glm::vec4(-4, 0, 2, 1)) < 1e-5f);  // left in front
  CHECK(glm::distance(rows[6].transform[3], glm::vec4(4, 0, -2, 1)) < 1e-5f);
  CHECK(scene.materials.rows()[rows[1].material].name == "red");
  CHECK(scene.materials.rows()[rows[7].material].albedo == glm::vec3(0, 0, 1));
  CHECK(glm::distance(rows[7].transform * glm::vec4(1, 0, 0, 1), glm::vec4(-1, 3, 0, 1)) < 1e-5f);
  CHECK(glm::distance(rows[7].previous_transform * glm::vec4(1, 0, 0, 1), glm::vec4(0, 1.5f, -1, 1)) < 1e-5f);
}

TEST_CASE("what a file says lets light through is drawn as transmissive alone, also where it blends") {
  const TemporaryFolder folder;
  for (const auto& [transmission, mode, list] : {std::tuple(1, "OPAQUE", DrawList::transmissive),
                                                 {1, "BLEND", DrawList::transmissive},
                                                 {0, "BLEND", DrawList::transparent}}) {
    weft::test::GltfMaker maker;
    maker.square().document["meshes"][0]["primitives"][0]["material"] = 0;
    maker.document["materials"] = {
        {{"alphaMode", mode},
         {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}},
         {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", transmission}}}}}}};
    const Scene scene = loadGood(folder.write("m.gltf", maker.gltf()));
    REQUIRE(scene.meshInstances.size() == 1);
    CHECK(scene.meshInstances.rows()[0].lists == maskOf(list));
  }
}

TEST_CASE("what is wrong with a model of a scene has a place") {
  const TemporaryFolder folder;
  writeTriangle(folder);
  const auto codeOf = [&](const std::string& model) {
    const text::Diagnostics d = failuresOf(folder, "{\"models\": {\"m\": " + model + "}}");
    REQUIRE_MESSAGE(d.size() == 1, d.text());
    REQUIRE(d.items()[0].place.file);
    CHECK(d.items()[0].place.file->ends_with("/s.json"));
    CHECK(d.items()[0].place.line == 1);
    return d.items()[0].code;
  };
  CHECK(codeOf(R"({"file": "missing.obj"})") == text::Code::unreadableModel);
  CHECK(codeOf(R"({"file": "s.json"})") == text::Code::unreadableModel);
  CHECK(codeOf(R"({"flie": "t.obj", "file": "t.obj"})") == text::Code::unknownKey);
  CHECK(codeOf(R"({})") == text::Code::missingKey);
  CHECK(codeOf(R"({"file": "t.obj", "scale": 0})") == text::Code::badSceneValue);
  CHECK(codeOf(R"({"file": "t.obj", "lists": ["opaqe"]})") == text::Code::unknownSceneList);
  CHECK(codeOf(R"({"file": "t.obj", "material": "gold"})") == text::Code::unknownMaterial);
  CHECK(codeOf(R"({"file": "t.obj", "animation": "Walk"})") == text::Code::unknownAnimation);
  CHECK(codeOf(R"({"file": "t.obj", "count": [65536, 65536, 1]})") == text::Code::badSceneValue);
  std::filesystem::copy(kTop + "scenes/models/Fox.glb", folder.at("Fox.glb"));
  const text::Diagnostics walk = failuresOf(
      folder,
      R"({"models": {"f": {"file": "Fox.glb", "animation": "Wlak"}, "g": {"file": "Fox.glb", "animation": 3}}})");
  REQUIRE_MESSAGE(walk.size() == 2, walk.text());
  CHECK(walk.items()[0].hint == "did you mean 'Walk'?");
  CHECK(walk.items()[1].expected == "Survey, Walk, Run");
}

TEST_CASE("every file of a scene's models is watched, also after errors") {
  const TemporaryFolder folder;
  folder.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  text::Diagnostics diagnostics;
  std::vector<std::string> files;
  const std::string path =
      folder.write("s.json", R"({"models": {"m": {"file": "m.obj"}, "n": {"file": "gone.glb"}}})");
  CHECK_FALSE(loadScene(path, diagnostics, &files));
  CHECK(files == std::vector{path, folder.at("m.obj"), folder.at("m.mtl"), folder.at("gone.glb")});
}

TEST_CASE("loading can be stopped") {
  text::Diagnostics diagnostics;
  std::stop_source source;
  source.request_stop();
  CHECK_FALSE(loadScene(kTop + "scenes/helmet_alone.json", diagnostics, nullptr, {}, source.get_token()));
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
}

TEST_CASE("spheres and models have the names and tags of the scene file, models those of their nodes, too") {
  const TemporaryFolder folder;
  writeTriangle(folder);
  const Scene scene = loadGood(folder.write("s.json", R"({
    "spheres": [ { "center": [0, 0, 0], "material": { "albedo": [1, 1, 1] }, "name": "ball", "tags": ["toy", "round"] },
                 { "center": [0, 0, 0], "material": { "albedo": [1, 1, 1] } } ],
    "models": { "rock": { "file": "t.obj", "count": [2, 1, 1], "tags": ["stone"] } } })"));
  CHECK(scene.labels.find(scene.spheres.rows()[0].label)->names == std::vector<std::string>{"ball"});
  CHECK(scene.labels.find(scene.spheres.rows()[0].label)->tags == std::vector<std::string>{"toy", "round"});
  CHECK(scene.labels.find(scene.spheres.rows()[1].label) == nullptr);
  REQUIRE(scene.meshInstances.size() == 2);
  CHECK(scene.meshInstances.rows()[0].label == scene.meshInstances.rows()[1].label);
  const Label& rock = *scene.labels.find(scene.meshInstances.rows()[0].label);
  CHECK(rock.names.front() == "rock");
  CHECK(rock.tags == std::vector<std::string>{"stone"});
  Selection lenses;
  lenses.name = "Lenses*";
  const Scene helmet = loadGood(kTop + "scenes/helmet_alone.json");
  CHECK(Members(lenses, helmet).count(helmet.meshInstances) == 1);
  for (const auto& [tag, code] :
       {std::pair("1", text::Code::wrongType), {R"("two words")", text::Code::badSceneValue}})
    CHECK(failuresOf(folder,
                     fmt::format(R"({{ "models": {{ "rock": {{ "file": "t.obj", "tags": [{}] }} }} }})", tag))
              .contains(code));
}
