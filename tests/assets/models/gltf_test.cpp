// glTF models: what is made of each part of the format, and everything of FlightHelmet and Fox against Assimp, which reads
// them independently.
#include <assimp/GltfMaterial.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>

#include "engine/assets/models/model_file.h"
#include "tests/assets/models/loading.h"

using namespace weft;
using namespace weft::assets;
using weft::test::GltfMaker;
using weft::test::json;
using weft::test::kModels;
using weft::test::loadGood;
using weft::test::make;
using weft::test::worldOf;

namespace {

// A PNG of 1 x 1 texel: dark red.
const unsigned char kRedBytes[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d,
                                   0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01,
                                   0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00,
                                   0x0c, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0x60, 0x60, 0x00,
                                   0x00, 0x01, 0x84, 0x00, 0x81, 0xf9, 0xfe, 0x65, 0x88, 0x00, 0x00, 0x00,
                                   0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::string kRedPng(reinterpret_cast<const char*>(kRedBytes), sizeof kRedBytes);

double distance(const glm::vec3& a, const aiVector3D& b) {
  return std::max({std::abs(a[0] - b.x), std::abs(a[1] - b.y), std::abs(a[2] - b.z)});
}

void compareNodes(const aiNode& node, const aiMatrix4x4& parent, const Model& model, int& seen) {
  const aiMatrix4x4 world = parent * node.mTransformation;
  for (std::uint32_t row = 0; row < model.nodes.size(); ++row) {
    if (model.nodes[row].name != node.mName.C_Str()) continue;
    const glm::mat4 mine = worldOf(model, row);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        CHECK(mine[c][r] == doctest::Approx(world[static_cast<unsigned>(r)][c]).epsilon(1e-4).scale(1));
    ++seen;
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) compareNodes(*node.mChildren[i], world, model, seen);
}

}  // namespace

TEST_CASE("FlightHelmet and Fox hold what Assimp reads from them") {
  for (const char* file : {"FlightHelmet/FlightHelmet.gltf", "Fox.glb"}) {
    CAPTURE(file);
    const Model model = loadGood(kModels + file);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(kModels + file, 0);
    REQUIRE(scene);
    REQUIRE(model.meshes.size() == scene->mNumMeshes);
    int seen = 0;
    compareNodes(*scene->mRootNode, {}, model, seen);
    CHECK(seen == static_cast<int>(model.nodes.size()));
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
      const aiMesh& other = *scene->mMeshes[m];
      const Mesh& mine = model.meshes[m];
      REQUIRE(mine.indexCount == other.mNumFaces * 3);
      double worst = 0, worstUv = 0, worstNormal = 0, worstTangent = 0;
      for (unsigned f = 0; f < other.mNumFaces; ++f)
        for (unsigned i = 0; i < 3; ++i) {
          const unsigned theirs = other.mFaces[f].mIndices[i];
          const Vertex& v = model.vertices[mine.firstVertex + model.indices[mine.firstIndex + 3 * f + i]];
          worst = std::max(worst, distance(v.position, other.mVertices[theirs]));
          const aiVector3D uv = other.mTextureCoords[0][theirs];
          worstUv = std::max<double>({worstUv, std::abs(v.uv[0] - uv.x), std::abs(1 - v.uv[1] - uv.y)});
          if (other.HasNormals())
            worstNormal = std::max(worstNormal, distance(v.normal, other.mNormals[theirs]));
          if (!other.HasTangentsAndBitangents()) continue;
          // The bitangent is cross(normal, tangent) * w.
          const aiVector3D n = other.mNormals[theirs], t(v.tangent[0], v.tangent[1], v.tangent[2]);
          const aiVector3D b = (n ^ t) * v.tangent[3];
          worstTangent = std::max<double>({worstTangent, (t - other.mTangents[theirs]).Length(),
                                           (b - other.mBitangents[theirs]).Length()});
        }
      CHECK(worst == 0);
      CHECK(worstUv < 1e-6);
      CHECK(worstNormal < 1e-3);  // Weft normalizes, Assimp does not
      CHECK(worstTangent < 1e-3);
    }
  }
}

TEST_CASE("FlightHelmet: nodes, materials, and textures that are shared") {
  const Model helmet = loadGood(kModels + "FlightHelmet/FlightHelmet.gltf");
  CHECK(helmet.nodes.size() == 6);
  CHECK(helmet.instances.size() == 6);
  CHECK(helmet.skin.empty());
  CHECK(helmet.files.size() == 17);
  REQUIRE(helmet.materials.size() == 7);  // the last is for meshes without one
  const Material &hose = helmet.materials[0], &rubber = helmet.materials[1], &lenses = helmet.materials[5];
  CHECK(hose.doubleSided);
  CHECK_FALSE(rubber.doubleSided);
  CHECK(hose.albedoMap == rubber.albedoMap);
  CHECK(hose.occlusionMap == hose.metallicRoughnessMap);
  CHECK(helmet.textures[hose.albedoMap].srgb);
  CHECK_FALSE(helmet.textures[hose.normalMap].srgb);
  CHECK_FALSE(helmet.textures[hose.metallicRoughnessMap].srgb);
  CHECK(helmet.textures[hose.albedoMap].image->channels == 4);
  CHECK(lenses.blend);
  CHECK_FALSE(hose.blend);
  for (const Vertex& v : helmet.vertices) {
    const double n = double(v.normal[0]) * v.normal[0] + double(v.normal[1]) * v.normal[1] +
                     double(v.normal[2]) * v.normal[2];
    REQUIRE(n == doctest::Approx(1).epsilon(1e-5));
    REQUIRE(std::abs(v.tangent[3]) == 1);
  }
}

TEST_CASE("Fox: a skin, three animations, flat normals where the file has none") {
  const Model fox = loadGood(kModels + "Fox.glb");
  REQUIRE(fox.skins.size() == 1);
  CHECK(fox.skins[0].joints.size() == 24);
  REQUIRE(fox.animations.size() == 3);
  CHECK(fox.animations[1]->name == "Walk");
  CHECK(fox.animations[1]->duration == doctest::Approx(0.708333));
  CHECK(fox.animations[1]->tracks.size() == 21);
  REQUIRE(fox.skin.size() == fox.vertices.size());
  for (const SkinVertex& v : fox.skin) {
    REQUIRE(v.weights[0] + v.weights[1] + v.weights[2] + v.weights[3] == doctest::Approx(1));
    for (std::size_t i = 0; i < 4; ++i) REQUIRE(v.joints[i] < 24);
  }
  const Mesh& mesh = fox.meshes[0];
  for (std::uint32_t i = 0; i < mesh.indexCount; i += 3) {
    const Vertex* corner[3];
    for (std::uint32_t k = 0; k < 3; ++k)
      corner[k] = &fox.vertices[mesh.firstVertex + fox.indices[mesh.firstIndex + i + k]];
    REQUIRE(corner[0]->normal == corner[1]->normal);
    REQUIRE(corner[0]->normal == corner[2]->normal);
    double edge[2][3], dot = 0;
    for (int c = 0; c < 3; ++c) {
      edge[0][c] = corner[1]->position[c] - corner[0]->position[c];
      edge[1][c] = corner[2]->position[c] - corner[0]->position[c];
    }
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      dot += (edge[0][d] * edge[1][e] - edge[0][e] * edge[1][d]) * corner[0]->normal[c];
    }
    REQUIRE(dot >= 0);  // counter-clockwise seen from where the normal points
  }
}

TEST_CASE(".glb and .gltf with a data URI are the same model") {
  GltfMaker maker;
  maker.square();
  const TemporaryFolder folder;
  const Model a = loadGood(folder.write("a.gltf", maker.gltf())),
              b = loadGood(folder.write("b.glb", maker.glb()));
  CHECK(a.vertices.size() == 4);
  CHECK(a.indices == b.indices);
  for (std::size_t v = 0; v < 4; ++v) CHECK(a.vertices[v].position == b.vertices[v].position);
  // uv goes right and up in the square, so that the tangent is +X and the bitangent, cross(n, t) * w, is +Y.
  CHECK(a.vertices[0].tangent == glm::vec4{1, 0, 0, 1});
  CHECK(a.vertices[0].uv == glm::vec2{0, 1});
}

TEST_CASE("every value of a material arrives") {
  GltfMaker maker;
  maker.square();
  maker.document["extensionsUsed"] = {"KHR_materials_emissive_strength"};
  maker.document["materials"] = {
      {{"name", "all"},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.1, 0.2, 0.3, 0.5}},
         {"metallicFactor", 0.25},
         {"roughnessFactor", 0.75},
         {"baseColorTexture", {{"index", 0}}},
         {"metallicRoughnessTexture", {{"index", 1}}}}},
       {"normalTexture", {{"index", 1}, {"scale", 0.5}}},
       {"occlusionTexture", {{"index", 1}, {"strength", 0.25}}},
       {"emissiveTexture", {{"index", 0}}},
       {"emissiveFactor", {1, 0.5, 0}},
       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}},
       {"alphaMode", "BLEND"},
       {"doubleSided", true}},
      {{"name", "mask"},
       {"alphaMode", "MASK"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}}},
      {{"alphaMode", "OPAQUE"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}}}};
  maker.document["textures"] = {{{"source", 0}}, {{"source", 1}}};
  const std::string uri = "data:image/png;base64," + GltfMaker::base64(kRedPng);
  maker.document["images"] = {{{"uri", uri}}, {{"uri", uri}}};
  const Model model = make(maker);
  const Material& all = model.materials[0];
  CHECK(all.albedo == glm::vec3{0.1f, 0.2f, 0.3f});
  CHECK(all.alpha == 0.5f);
  CHECK(all.blend);
  CHECK(all.metallic == 0.25f);
  CHECK(all.roughness == 0.75f);
  CHECK(all.normalScale == 0.5f);
  CHECK(all.occlusionStrength == 0.25f);
  CHECK(all.emissive == glm::vec3{8, 4, 0});
  CHECK(all.doubleSided);
  CHECK_FALSE(all.blinnPhong);
  // Two images of equal bytes, used as colors and as numbers: two textures, not five.
  CHECK(model.textures.size() == 2);
  CHECK(all.albedoMap == all.emissiveMap);
  CHECK(all.normalMap == all.metallicRoughnessMap);
  CHECK(model.textures[all.albedoMap].image->texels == std::vector<std::uint8_t>{128, 0, 0, 255});
  CHECK(model.textures[all.albedoMap].content != model.textures[all.normalMap].content);
  const Material& mask = model.materials[1];
  CHECK(mask.alphaCutoff == 1);  // 0.5 of 0.5: the factor is in it
  CHECK_FALSE(mask.blend);
  CHECK(mask.metallic == 1);
  CHECK(mask.roughness == 1);
  CHECK(model.materials[2].alpha == 1);  // ignored where the material is opaque
}

TEST_CASE("a picture that ends in its first bytes is told, and the model is there") {
  const std::string whole("RIFF\x10\0\0\0WEBPVP8 ", 16);
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    CAPTURE(size);
    GltfMaker maker;
    maker.square();
    maker.document["images"] = {
        {{"uri", "data:image/webp;base64," + GltfMaker::base64(whole.substr(0, size))}}};
    maker.document["textures"] = {{{"source", 0}}};
    maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    CHECK(make(maker, 1).textures.size() == 1);  // a checkerboard
  }
}

TEST_CASE("what says that it blends but lets nothing through is opaque") {
  const auto blends = [](std::uint8_t texel, float factor, float vertex) {
    GltfMaker maker;
    maker.square();
    const std::uint8_t texels[] = {9, 9, 9, 255, 9, 9, 9, texel};
    maker.document["images"] = {
        {{"uri", "data:image/png;base64," + GltfMaker::base64(encodePng8(2, 1, 4, texels))}}};
    maker.document["textures"] = {{{"source", 0}}};
    maker.document["materials"] = {
        {{"alphaMode", "BLEND"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 1, 1, factor}}, {"baseColorTexture", {{"index", 0}}}}}}};
    json& primitive = maker.document["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    std::vector<float> colors(16, 1.0f);
    colors[11] = vertex;
    primitive["attributes"]["COLOR_0"] = maker.accessor(colors, 4, "VEC4", 5126);
    return make(maker).materials[0].blend;
  };
  CHECK_FALSE(blends(255, 1, 1));
  CHECK(blends(254, 1, 1));
  CHECK(blends(255, 0.99f, 1));
  CHECK(blends(255, 1, 0.99f));
}

TEST_CASE(
    "uv are moved as KHR_texture_transform says; a material has two uv, maps that want a third are left "
    "out") {
  GltfMaker maker;
  maker.square();
  const std::string uri = "data:image/png;base64," + GltfMaker::base64(kRedPng);
  maker.document["images"] = {{{"uri", uri}}};
  maker.document["textures"] = {{{"source", 0}}};
  maker.document["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorTexture",
          {{"index", 0},
           {"extensions",
            {{"KHR_texture_transform",
              {{"offset", {0.5, 0.25}}, {"scale", {2, 4}}, {"rotation", 1.5707963267948966}}}}}}}}},
       {"occlusionTexture", {{"index", 0}, {"texCoord", 1}}},
       {"emissiveTexture", {{"index", 0}}}}};
  maker.document["meshes"][0]["primitives"][0]["material"] = 0;
  maker.document["extensionsRequired"] = {"KHR_texture_transform"};
  const Model model = make(maker, 2);  // the third uv, and the second, which the mesh lacks
  CHECK(model.materials[0].emissiveMap == kNoRow);
  CHECK(model.materials[0].occlusionMap != kNoRow);
  CHECK(model.materials[0].samplers[0] == repeat);
  CHECK(model.materials[0].samplers[3] == atSecondUv);
  CHECK(model.secondUvs.empty());  // the mesh has none
  // Scaled, turned counter-clockwise as uv are drawn (v downwards), then moved: (1, 1) to (2, 4) to (4, -2).
  const glm::vec2 uv = model.vertices[1].uv;  // of (1, 1)
  CHECK(uv[0] == doctest::Approx(0.5 + 4));
  CHECK(uv[1] == doctest::Approx(0.25 - 2));
}

TEST_CASE("normalized and whole components, strips, fans, and sparse accessors") {
  GltfMaker maker;
  maker.square();
  json& primitive = maker.document["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_0"] =
      maker.accessor(std::vector<std::uint16_t>{0, 65535, 65535, 65535, 65535, 0, 0, 0}, 2, "VEC2", 5123);
  maker.document["accessors"].back()["normalized"] = true;
  CHECK(make(maker).vertices[2].uv == glm::vec2{1, 0});

  primitive["mode"] = 5;
  primitive["indices"] = maker.shorts({0, 1, 3, 2});
  const Model strip = make(maker);
  CHECK(strip.indices == std::vector<std::uint32_t>{0, 1, 3, 1, 2, 3});
  primitive["mode"] = 6;
  primitive["indices"] = maker.shorts({0, 1, 2, 3});
  CHECK(make(maker).indices == std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0});

  const int index = maker.shorts({2}), value = maker.floats({5, 6, 7}, 3);
  maker.document["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices",
       {{"bufferView", maker.document["accessors"][index]["bufferView"]}, {"componentType", 5123}}},
      {"values", {{"bufferView", maker.document["accessors"][value]["bufferView"]}}}};
  const Model sparse = make(maker);
  CHECK(sparse.vertices[2].position == glm::vec3{5, 6, 7});
  CHECK(sparse.vertices[1].position == glm::vec3{1, 0, 0});
}

TEST_CASE("points are left out, with a warning") {
  GltfMaker maker;
  maker.square();
  json points = maker.document["meshes"][0]["primitives"][0];
  points["mode"] = 0;
  maker.document["meshes"][0]["primitives"].push_back(points);
  CHECK(make(maker, 1).meshes.size() == 1);
}

TEST_CASE("nodes: matrices are taken apart, mirrors turn the winding, and what no scene shows is not drawn") {
  GltfMaker maker;
  maker.square();
  // Two of the second are what the matrix says: x to 2y, y to -x, z to 3z, moved by (7, 8, 9).
  maker.document["nodes"] = {{{"mesh", 0}, {"matrix", {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 3, 0, 7, 8, 9, 1}}},
                             {{"mesh", 0}, {"scale", {-1, 1, 1}}, {"children", {2}}},
                             {{"mesh", 0}, {"scale", {1, -1, 1}}},
                             {{"mesh", 0}}};
  maker.document["scenes"] = {{{"nodes", {0, 1}}}};
  const Model model = make(maker);
  REQUIRE(model.instances.size() == 3);
  const glm::mat4 wanted(0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 3, 0, 7, 8, 9, 1);
  const glm::mat4 got = worldOf(model, model.instances[0].node);
  for (int i = 0; i < 16; ++i) CHECK(got[i / 4][i % 4] == doctest::Approx(wanted[i / 4][i % 4]).scale(1));
  REQUIRE(model.meshes.size() == 2);  // as it is, and turned: sharing the vertices
  CHECK(model.vertices.size() == 4);
  CHECK(model.instances[0].mesh == 0);
  CHECK(model.instances[1].mesh == 1);
  CHECK(model.instances[2].mesh == 0);  // two mirrors are none
  CHECK(model.indices == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 2, 1, 0, 3, 2});
}

TEST_CASE("tangents are split where uv are mirrored, and stand at right angles to the normal") {
  GltfMaker maker;
  maker.square();
  // Two triangles that share an edge, the second with u the other way.
  maker.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      maker.floats({0, 1, 1, 1, 1, 0, 2, 0}, 2);
  const Model model = make(maker);
  CHECK(model.vertices.size() == 6);
  int negative = 0;
  for (std::size_t corner = 0; corner < 6; ++corner) {
    const Vertex& v = model.vertices[model.indices[corner]];
    CHECK(std::abs(v.tangent[0] * v.normal[0] + v.tangent[1] * v.normal[1] + v.tangent[2] * v.normal[2]) <
          1e-6f);
    negative += v.tangent[3] < 0 ? 1 : 0;
  }
  CHECK(negative == 3);
}

TEST_CASE("a vertex keeps its four heaviest joints") {
  GltfMaker maker;
  maker.square();
  json& attributes = maker.document["meshes"][0]["primitives"][0]["attributes"];
  std::vector<std::uint16_t> joints;
  std::vector<float> first, second;
  for (int v = 0; v < 4; ++v) {
    joints.insert(joints.end(), {0, 1, 2, 3});
    first.insert(first.end(), {0.1f, 0.3f, 0, 0.05f});
    second.insert(second.end(), {0.2f, 0.25f, 0, 0.1f});
  }
  attributes["JOINTS_0"] = attributes["JOINTS_1"] = maker.shorts(joints, 4);
  attributes["WEIGHTS_0"] = maker.floats(first, 4);
  attributes["WEIGHTS_1"] = maker.floats(second, 4);
  maker.document["nodes"] = {{{"mesh", 0}, {"skin", 0}},
                             {{"children", {2, 3, 4}}},
                             json::object(),
                             json::object(),
                             json::object(),
                             {{"mesh", 0}}};
  maker.document["skins"] = {{{"joints", {1, 2, 3, 4}}}};
  maker.document["scenes"] = {{{"nodes", {0, 1, 5}}}};
  const Model model = make(maker);
  REQUIRE(model.instances.size() == 2);
  CHECK(model.instances[0].skin == 0);
  CHECK(model.instances[1].skin == kNoRow);
  CHECK(model.meshes[model.instances[0].mesh].skinned);
  CHECK_FALSE(model.meshes[model.instances[1].mesh].skinned);  // the same mesh without its weights
  const SkinVertex& v = model.skin[0];
  CHECK(v.joints == std::array<std::uint16_t, 4>{1, 1, 0, 0});
  CHECK(v.weights[0] == doctest::Approx(0.3 / 0.85));
  CHECK(v.weights[3] == doctest::Approx(0.1 / 0.85));
  for (const float weight : model.skin[4].weights) CHECK(weight == 0);
}
