// Why glTF has a reader of its own: what Assimp 5.2.5 makes of it, beside what Weft does. docs/dependencies.md says the same.
// A newer Assimp that passes over less fails here: then the page is to be written anew.
#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>

#include "tests/assets/models/loading.h"

using namespace weft;
using namespace weft::assets;
using weft::test::GltfMaker;
using weft::test::json;

namespace {

// The same file by both.
struct Both {
  explicit Both(const GltfMaker& maker) {
    const TemporaryFolder folder;
    const std::string path = folder.write("m.gltf", maker.gltf());
    mine = test::loadGood(path);
    theirs = importer.ReadFile(path, 0);
    REQUIRE(theirs);
  }
  Model mine;
  Assimp::Importer importer;
  const aiScene* theirs = nullptr;
};

GltfMaker square() {
  GltfMaker maker;
  maker.square();
  return maker;
}

}  // namespace

TEST_CASE("Assimp passes over the strength of what shines") {
  GltfMaker maker = square();
  maker.document["extensionsUsed"] = {"KHR_materials_emissive_strength"};
  maker.document["materials"] = {
      {{"emissiveFactor", {1, 0.5, 0}},
       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}}};
  maker.document["meshes"][0]["primitives"][0]["material"] = 0;
  const Both both(maker);
  CHECK(both.mine.materials[0].emissive == glm::vec3{8, 4, 0});
  const aiMaterial& material = *both.theirs->mMaterials[both.theirs->mMeshes[0]->mMaterialIndex];
  aiColor3D color;
  float strength = 0;
  REQUIRE(material.Get(AI_MATKEY_COLOR_EMISSIVE, color) == aiReturn_SUCCESS);
  CHECK(color == aiColor3D(1, 0.5f, 0));
  CHECK(material.Get(AI_MATKEY_EMISSIVE_INTENSITY, strength) != aiReturn_SUCCESS);
}

TEST_CASE("Assimp makes the same keys of steps, lines and cubic curves") {
  std::vector<std::vector<float>> found;
  for (const char* how : {"STEP", "LINEAR", "CUBICSPLINE"}) {
    GltfMaker maker = square();
    // Cubic keys have tangents before and after the value.
    const bool cubic = std::string(how) == "CUBICSPLINE";
    std::vector<float> values = {0, 0, 0, 4, 0, 0};
    if (cubic) values = {0, 0, 0, 0, 0, 0, 9, 9, 9, -9, -9, -9, 4, 0, 0, 0, 0, 0};
    maker.document["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers",
          {{{"input", maker.floats({0, 1}, 1)},
            {"output", maker.floats(values, 3)},
            {"interpolation", how}}}}}};
    const Both both(maker);
    const TrackInterpolation wanted = cubic                        ? TrackInterpolation::cubic
                                      : std::string(how) == "STEP" ? TrackInterpolation::step
                                                                   : TrackInterpolation::linear;
    CHECK(both.mine.animations[0]->tracks[0].interpolation == wanted);
    CHECK(both.mine.animations[0]->tracks[0].values.size() == values.size() / 3);
    const aiNodeAnim& channel = *both.theirs->mAnimations[0]->mChannels[0];
    std::vector<float>& keys = found.emplace_back();
    for (unsigned k = 0; k < channel.mNumPositionKeys; ++k)
      for (const double each : {channel.mPositionKeys[k].mTime, double(channel.mPositionKeys[k].mValue.x),
                                double(channel.mPositionKeys[k].mValue.y)})
        keys.push_back(static_cast<float>(each));
  }
  CHECK(found[0].size() == 6);
  CHECK(found[0] == found[1]);
  CHECK(found[0] == found[2]);
}

TEST_CASE("Assimp knows what an animation or a skin moves by its name alone, and files repeat names") {
  GltfMaker maker = square();
  maker.document["nodes"] = {{{"name", "wheel"}, {"mesh", 0}}, {{"name", "wheel"}, {"mesh", 0}}};
  maker.document["scenes"][0]["nodes"] = {0, 1};
  maker.document["animations"] = {
      {{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}},
       {"samplers",
        {{{"input", maker.floats({0, 1}, 1)}, {"output", maker.floats({0, 0, 0, 4, 0, 0}, 3)}}}}}};
  const Both both(maker);
  CHECK(both.mine.animations[0]->tracks[0].node == 1);
  int named = 0;
  const aiString& moved = both.theirs->mAnimations[0]->mChannels[0]->mNodeName;
  for (unsigned i = 0; i < both.theirs->mRootNode->mNumChildren; ++i)
    named += both.theirs->mRootNode->mChildren[i]->mName == moved ? 1 : 0;
  CHECK(named == 2);
}
