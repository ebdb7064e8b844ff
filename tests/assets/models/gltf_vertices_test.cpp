// Vertex colors, and morph targets by the weights that a file begins with, or that move.
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <limits>

#include "tests/assets/models/failure.h"
#include "tests/assets/models/loading.h"

using namespace weft;
using namespace weft::assets;
using text::Code;
using weft::test::GltfMaker;
using weft::test::json;
using weft::test::make;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

json& primitive(GltfMaker& maker) {
  return maker.document["meshes"][0]["primitives"][0];
}

GltfMaker squareModel() {
  GltfMaker maker;
  maker.square();
  return maker;
}

// The square with its last accessor as its colors.
GltfMaker colored(GltfMaker maker, int accessor, bool normalized = false) {
  if (normalized) maker.document["accessors"].back()["normalized"] = true;
  primitive(maker)["attributes"]["COLOR_0"] = accessor;
  return maker;
}

// The square, of which target 0 moves corner 2 by (0, 0, 1) and turns its normal, and target 1 all by (1, 0, 0).
GltfMaker morphed() {
  GltfMaker maker = squareModel();
  const int up = maker.floats({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, 3);
  const int turned = maker.floats({0, 0, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0}, 3);
  const int aside = maker.floats({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, 3);
  primitive(maker)["targets"] = {{{"POSITION", up}, {"NORMAL", turned}}, {{"POSITION", aside}}};
  return maker;
}

text::Diagnostic failureOf(const GltfMaker& maker) {
  const TemporaryFolder folder;
  return test::failureOf(folder, "m.gltf", maker.gltf());
}

}  // namespace

TEST_CASE(
    "vertex colors: floats, bytes and shorts, of three and four channels; white where a mesh has none") {
  CHECK(make(squareModel()).colors.empty());
  GltfMaker maker = squareModel();
  // Floats are clamped, as glTF 2.0, 3.7.2.1 says.
  const Model floats = make(colored(maker, maker.floats({1, 0, 0, 0, 0.5, 0, 2, -1, 0.25f, 1, 1, 1}, 3)));
  CHECK(floats.colors ==
        std::vector<glm::vec4>{{1, 0, 0, 1}, {0, 0.5f, 0, 1}, {1, 0, 0.25f, 1}, {1, 1, 1, 1}});

  maker = squareModel();
  const std::vector<std::uint8_t> bytes = {255, 0, 51, 255, 0, 255, 0, 0, 102, 102, 102, 153, 0, 0, 0, 255};
  const int four = maker.accessor(bytes, 4, "VEC4", 5121);
  const Model small = make(colored(maker, four, true));
  REQUIRE(small.colors.size() == 4);
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t c = 0; c < 4; ++c)
      CHECK(small.colors[v][c] == doctest::Approx(bytes[4 * v + c] / 255.0));

  maker = squareModel();
  const std::vector<std::uint16_t> shorts = {65535, 0, 13107, 0, 65535, 0, 26214, 26214, 26214, 0, 0, 1};
  const int three = maker.accessor(shorts, 3, "VEC3", 5123);
  const Model wide = make(colored(maker, three, true));
  REQUIRE(wide.colors.size() == 4);
  for (std::size_t v = 0; v < 4; ++v) {
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(wide.colors[v][c] == doctest::Approx(shorts[3 * v + c] / 65535.0).epsilon(1e-7));
    CHECK(wide.colors[v][3] == 1);
  }

  // A second mesh before and after has none of its own.
  maker = colored(squareModel(), 0);
  json plain = maker.document["meshes"][0];
  plain["primitives"][0]["attributes"].erase("COLOR_0");
  maker.document["meshes"] = {plain, maker.document["meshes"][0], plain};
  maker.document["nodes"] = {{{"mesh", 0}}, {{"mesh", 1}}, {{"mesh", 2}}};
  maker.document["scenes"][0]["nodes"] = {0, 1, 2};
  const Model mixed = make(maker);
  REQUIRE(mixed.colors.size() == 12);
  for (std::size_t v = 0; v < 12; ++v)
    CHECK(mixed.colors[v] == (v / 4 == 1
                                  ? glm::vec4{mixed.vertices[v].position[0], mixed.vertices[v].position[1],
                                              mixed.vertices[v].position[2], 1}
                                  : glm::vec4{1, 1, 1, 1}));
}

TEST_CASE("vertex colors are those that Assimp reads, also where vertices are taken apart") {
  GltfMaker maker = squareModel();
  const int colors = maker.floats({1, 0, 0, 1, 0, 1, 0, 0.5, 0, 0, 1, 0.25, 0.5, 0.5, 0.5, 0}, 4);
  maker = colored(maker, colors);
  for (const bool flat : {false, true}) {
    if (flat) primitive(maker)["attributes"].erase("NORMAL");
    const TemporaryFolder folder;
    const std::string path = folder.write("m.gltf", maker.gltf());
    const Model model = test::loadGood(path);
    CHECK(model.vertices.size() == (flat ? 6 : 4));
    REQUIRE(model.colors.size() == model.vertices.size());
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(path, 0);
    REQUIRE(scene);
    const aiMesh& other = *scene->mMeshes[0];
    REQUIRE(other.HasVertexColors(0));
    for (unsigned f = 0; f < other.mNumFaces; ++f)
      for (unsigned i = 0; i < 3; ++i) {
        const aiColor4D& theirs = other.mColors[0][other.mFaces[f].mIndices[i]];
        const glm::vec4& mine = model.colors[model.indices[3 * f + i]];
        CHECK(mine == glm::vec4{theirs.r, theirs.g, theirs.b, theirs.a});
      }
  }
}

TEST_CASE("vertex colors that lie") {
  GltfMaker maker = squareModel();
  CHECK(failureOf(colored(maker, maker.floats({1, 0, 0, 0, kNan, 0, 1, 0, 0, 1, 1, 1}, 3))).message ==
        "'COLOR_0' of vertex 1 is no number that can be used");
  maker = squareModel();
  CHECK(failureOf(colored(maker, maker.floats({1, 0, 0}, 3))).found == "1");
  maker = squareModel();
  CHECK(failureOf(colored(maker, maker.floats({1, 0, 0, 0}, 1))).code == Code::badModelValue);
  CHECK(failureOf(colored(squareModel(), 99)).code == Code::badModelValue);
  CHECK(failureOf(colored(squareModel(), -1)).code == Code::badModelValue);
  // Bytes that are not normalized say nothing: left out, with a warning.
  maker = squareModel();
  const int bytes = maker.accessor(std::vector<std::uint8_t>(16, 200), 4, "VEC4", 5121);
  CHECK(make(colored(maker, bytes), 1).colors.empty());
}

TEST_CASE("morph targets move a mesh as far as its weights or its node's say") {
  CHECK(make(morphed()).vertices[2].position == glm::vec3{1, 1, 0});  // no weights
  GltfMaker maker = morphed();
  maker.document["meshes"][0]["weights"] = {0.5, 2};
  const Model model = make(maker);
  CHECK(model.vertices[2].position == glm::vec3{3, 1, 0.5f});
  CHECK(model.vertices[0].position == glm::vec3{2, 0, 0});
  CHECK(model.vertices[0].normal == glm::vec3{0, 0, 1});
  // (0, 0, 1) and half of (1, 0, -1).
  for (const std::size_t c : {0u, 2u}) CHECK(model.vertices[2].normal[c] == doctest::Approx(std::sqrt(0.5)));

  // One node as the mesh says, two as they say themselves: two meshes.
  maker.document["nodes"] = {
      {{"mesh", 0}}, {{"mesh", 0}, {"weights", {1, 0}}}, {{"mesh", 0}, {"weights", {1, 0}}}};
  maker.document["scenes"][0]["nodes"] = {0, 1, 2};
  const Model own = make(maker);
  REQUIRE(own.meshes.size() == 2);
  REQUIRE(own.instances.size() == 3);
  CHECK(own.instances[1].mesh == own.instances[2].mesh);
  const Mesh& second = own.meshes[own.instances[1].mesh];
  CHECK(own.vertices[second.firstVertex + 2].position == glm::vec3{1, 1, 1});

  // Without normals those of the moved triangles.
  maker = morphed();
  maker.document["meshes"][0]["weights"] = {1, 0};
  primitive(maker)["attributes"].erase("NORMAL");
  const Model flat = make(maker);
  CHECK(flat.vertices[0].normal[1] == doctest::Approx(-std::sqrt(0.5)));
}

TEST_CASE("a mesh whose weights an animation moves keeps its targets, and a track has one of them") {
  GltfMaker maker = morphed();
  maker.document["meshes"][0]["weights"] = {1, 0};
  const auto animated = [&](std::vector<float> times, std::vector<float> values, const char* how) {
    GltfMaker other = maker;
    const int input = other.floats(times, 1), output = other.floats(values, 1);
    other.document["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", input}, {"output", output}, {"interpolation", how}}}}}};
    return other;
  };
  const Model model = make(animated({0, 1}, {0.25, 2, 3, 4}, "LINEAR"));
  CHECK(model.vertices[2].position == glm::vec3{1, 1, 0});
  REQUIRE(model.targets.size() == 8);
  const Mesh& mesh = model.meshes[0];
  CHECK(mesh.targetBounds == std::vector<Box>{{{0, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {1, 0, 0}}});
  CHECK(model.targets[mesh.firstTarget + 2 * 2].position == glm::vec3{0, 0, 1});
  CHECK(model.targets[mesh.firstTarget + 2 * 2].normal == glm::vec3{1, 0, -1});
  CHECK(model.targets[mesh.firstTarget + 2 * 3 + 1].position == glm::vec3{1, 0, 0});
  CHECK(model.nodes[model.instances[0].node].weights == std::vector<float>{1, 0});
  const std::vector<ModelTrack>& tracks = model.animations[0]->tracks;
  REQUIRE(tracks.size() == 2);
  for (std::uint32_t t = 0; t < 2; ++t) {
    CHECK(tracks[t].path == TrackPath::weights);
    CHECK(tracks[t].target == t);
    CHECK(tracks[t].times == std::vector<float>{0, 1});
    CHECK(tracks[t].values ==
          std::vector<glm::vec4>{{t == 0 ? 0.25f : 2, 0, 0, 0}, {t == 0 ? 3 : 4, 0, 0, 0}});
  }
  // In-tangents, values and out-tangents of all targets.
  const Model cubic = make(animated({0}, {1, 2, 3, 4, 5, 6}, "CUBICSPLINE"));
  CHECK(cubic.animations[0]->tracks[1].values ==
        std::vector<glm::vec4>{{2, 0, 0, 0}, {4, 0, 0, 0}, {6, 0, 0, 0}});
  for (const std::size_t count : {2, 3, 6})
    CHECK(failureOf(animated({0, 1}, std::vector<float>(count), "STEP")).code == Code::badModelValue);
  CHECK(failureOf(animated({0, 1}, {0, 0, kNan, 1}, "STEP")).code == Code::badModelValue);

  // Without normals a target takes those of the triangles to those of the moved ones.
  primitive(maker)["attributes"].erase("NORMAL");
  const Model flat = make(animated({0, 1}, {0, 2, 3, 4}, "LINEAR"));
  REQUIRE(flat.targets.size() == 2 * flat.vertices.size());
  const glm::vec3 turned = glm::normalize(flat.vertices[0].normal + flat.targets[0].normal);
  CHECK(turned[1] == doctest::Approx(-std::sqrt(0.5)));
  CHECK(turned[2] == doctest::Approx(std::sqrt(0.5)));
  // One accessor in a hundred thousand targets is refused here, too.
  primitive(maker)["attributes"]["POSITION"] = maker.floats(std::vector<float>(30000, 0.5f), 3);
  primitive(maker)["targets"] = json(100000, {{"POSITION", primitive(maker)["attributes"]["POSITION"]}});
  primitive(maker)["attributes"].erase("TEXCOORD_0");
  std::vector<float> many(100000, 0.5f);
  CHECK(failureOf(animated({0}, many, "STEP")).code == Code::limitExceeded);
}

TEST_CASE("morph targets that lie") {
  const auto weighted = [](json weights) {
    GltfMaker maker = morphed();
    maker.document["meshes"][0]["weights"] = std::move(weights);
    return maker;
  };
  CHECK(failureOf(weighted({1e300, 0})).code == Code::badModelValue);
  CHECK(failureOf(weighted({"x"})).code == Code::badModelValue);
  CHECK(make(weighted({0, 0, 5, 5, 5})).vertices[0].position ==
        glm::vec3{0, 0, 0});  // of targets that are not there
  GltfMaker maker = weighted({0, 1e9});
  primitive(maker)["targets"][1]["POSITION"] = maker.floats({3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 3);
  CHECK(failureOf(maker).expected == "positions within 1000000000");
  maker = weighted({1, 1});
  primitive(maker)["targets"][1]["POSITION"] = 99;
  CHECK(failureOf(maker).pointer == "/meshes/0/primitives/0/targets/1/POSITION");
  maker = weighted({1, 1});
  primitive(maker)["targets"][1]["POSITION"] = maker.floats({1, 0, 0}, 3);
  CHECK(failureOf(maker).found == "1");
  maker = weighted({1, 1});
  primitive(maker)["targets"][1]["POSITION"] = maker.floats({1, 0, 0, kNan, 0, 0, 1, 0, 0, 1, 0, 0}, 3);
  CHECK(failureOf(maker).code == Code::badModelValue);
  // One accessor in a hundred thousand targets of a mesh of ten thousand vertices: refused, not worked off.
  maker = weighted(json(100000, 1));
  std::vector<float> many(30000, 0.5f);
  for (const char* name : {"POSITION", "NORMAL"})
    primitive(maker)["attributes"][name] = maker.floats(many, 3);
  primitive(maker)["attributes"].erase("TEXCOORD_0");
  primitive(maker)["targets"] = json(100000, {{"POSITION", primitive(maker)["attributes"]["POSITION"]}});
  const text::Diagnostic d = failureOf(maker);
  CHECK(d.code == Code::limitExceeded);
  CHECK(d.hint.find("--limit") != std::string::npos);
}
