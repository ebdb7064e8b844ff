#include <assimp/GltfMaterial.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cmath>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "engine/assets/models/assimp/model_check.h"
#include "engine/assets/models/parts/mesh_builder.h"
#include "engine/assets/models/parts/texture_pool.h"
#include "engine/text/limits.h"

namespace weft::assets {

using text::Code;
using text::Diagnostics;

namespace {

constexpr const char* kName = "model.fbx";

// All that Assimp may open: the model itself, which was read and checked.
class ModelIo final : public Assimp::IOSystem {
 public:
  explicit ModelIo(std::string bytes) : bytes_(std::move(bytes)) {}

  bool Exists(const char* path) const override { return std::string_view(path) == kName; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (!Exists(path) || std::strchr(mode, 'w') || std::strchr(mode, 'a')) return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string bytes_;
};

class Progress final : public Assimp::ProgressHandler {
 public:
  explicit Progress(const LoadObserver& observer) : observer_(observer) {}
  bool Update(float done) override {
    return !observer_ || observer_(LoadStage::decoding, std::clamp(static_cast<double>(done), 0.0, 1.0) / 2);
  }

 private:
  const LoadObserver& observer_;
};

constexpr double kFarthestVertex = 1e9;

glm::vec3 toVec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

// Assimp's matrices are rows.
glm::mat4 toMatrix(const aiMatrix4x4& m) {
  return glm::transpose(glm::make_mat4(&m.a1));
}

class AssimpReader {
 public:
  AssimpReader(const aiScene& scene, ModelFiles& files, Diagnostics& diagnostics, Model& model)
      : scene_(scene),
        files_(files),
        diagnostics_(diagnostics),
        model_(model),
        builder_(model),
        pool_(diagnostics) {}

  bool read(const LoadObserver& observer) {
    const std::size_t before = diagnostics_.errorCount();
    if (!readNodes()) return false;
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
      if (observer && !observer(LoadStage::decoding, 0.5)) return false;
      readMaterial(*scene_.mMaterials[i]);
    }
    if (!pool_.finish(model_, observer, 0.5)) return false;
    for (const auto& [node, row] : nodeRows_)
      for (unsigned i = 0; i < node->mNumMeshes; ++i)
        if (!readInstance(node->mMeshes[i], row)) return false;
    std::ranges::stable_sort(model_.instances, {}, &ModelInstance::node);
    readAnimations();
    if (scene_.mNumLights > 0)
      leaveOut("the lights of the model were left out: the format says no unit of their brightness",
               "give the scene file a 'sun' and 'lamps'");
    return diagnostics_.errorCount() == before;
  }

 private:
  void fail(std::string message, std::string expected, std::string found = "", std::string hint = "") {
    diagnostics_.add({.code = Code::badModelValue,
                      .message = std::move(message),
                      .place = files_.place(),
                      .expected = std::move(expected),
                      .found = std::move(found),
                      .hint = std::move(hint)});
  }
  void leaveOut(std::string message, std::string hint) {
    diagnostics_.warning(Code::modelPartLeftOut, files_.place(), std::move(message)).hint = std::move(hint);
  }

  bool readNodes() {
    std::vector<std::pair<const aiNode*, std::uint32_t>> work{{scene_.mRootNode, kNoRow}};
    while (!work.empty()) {
      const auto [from, parent] = work.back();
      work.pop_back();
      ModelNode node;
      node.name = from->mName.C_Str();
      node.parent = parent;
      std::optional<Transform> inner;
      if (!decompose(toMatrix(from->mTransformation), node.local, inner)) {
        fail(fmt::format("the matrix of node '{}' holds what is no number", node.name), "finite numbers");
        return false;
      }
      auto row = static_cast<std::uint32_t>(model_.nodes.size());
      rowByName_.emplace(node.name, row);
      if (inner) {
        model_.nodes.push_back(node);
        node = {.name = node.name, .parent = row++, .local = *inner};
      }
      nodeRows_.emplace_back(from, row);
      model_.nodes.push_back(std::move(node));
      for (unsigned c = from->mNumChildren; c-- > 0;) work.emplace_back(from->mChildren[c], row);
    }
    return true;
  }

  static std::string imageOf(const aiMaterial& material, aiTextureType type) {
    aiString path;
    return material.GetTexture(type, 0, &path) == aiReturn_SUCCESS ? path.C_Str() : "";
  }
  // The first that there is.
  std::uint32_t mapOf(const aiMaterial& material, std::initializer_list<aiTextureType> types,
                      TextureUse use) {
    for (const aiTextureType type : types) {
      const std::string name = imageOf(material, type);
      if (name.empty()) continue;
      auto known = images_.find(name);
      if (known == images_.end()) known = images_.emplace(name, readImage(name)).first;
      return pool_.use(known->second, name, use, files_.place());
    }
    return kNoRow;
  }

  // The image of a texture: embedded, or beside the model, by its own name if its path leads elsewhere (models often keep
  // the paths of the machine that they were made on).
  std::uint32_t readImage(const std::string& given) {
    if (const aiTexture* embedded = scene_.GetEmbeddedTexture(given.c_str())) {
      if (embedded->mHeight == 0)
        return pool_.put(std::string(reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth),
                         given, files_.place());
      pool_.reportMissing(given, "it is packed without a file format", files_.place());
      return kNoRow;
    }
    std::string name = given;
    std::ranges::replace(name, '\\', '/');
    if (!files_.hasBeside(name)) name = name.substr(name.rfind('/') + 1);
    auto bytes = files_.readOptional(name, files_.place(), Code::missingModelTexture, false);
    return bytes ? pool_.put(std::move(*bytes), name, files_.place()) : kNoRow;
  }

  static float unitOf(float value, float otherwise) {
    return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : otherwise;
  }
  static glm::vec3 colorOf(const aiMaterial& from, const char* key, unsigned type, unsigned index,
                           glm::vec3 otherwise) {
    aiColor3D color;
    if (from.Get(key, type, index, color) != aiReturn_SUCCESS) return otherwise;
    return {unitOf(color.r, 0), unitOf(color.g, 0), unitOf(color.b, 0)};
  }

  void readMaterial(const aiMaterial& from) {
    Material material;
    material.name = from.GetName().C_Str();
    material.albedo = colorOf(from, AI_MATKEY_COLOR_DIFFUSE, {0.6f, 0.6f, 0.6f});
    material.specular = colorOf(from, AI_MATKEY_COLOR_SPECULAR, {0, 0, 0});
    material.emissive = colorOf(from, AI_MATKEY_COLOR_EMISSIVE, {0, 0, 0});
    float shininess = 0, strength = 1, opacity = 1, metallic = 0, roughness = 0;
    from.Get(AI_MATKEY_SHININESS, shininess);
    if (from.Get(AI_MATKEY_SHININESS_STRENGTH, strength) == aiReturn_SUCCESS && std::isfinite(strength))
      for (int c = 0; c < 3; ++c) material.specular[c] = unitOf(material.specular[c] * strength, 0);
    if (from.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) material.alpha = unitOf(opacity, 1);
    material.blend = material.alpha < 1;
    material.shininess = std::isfinite(shininess) ? std::clamp(shininess, 0.0f, 10000.0f) : 0;
    int both = 0;
    material.doubleSided = from.Get(AI_MATKEY_TWOSIDED, both) == aiReturn_SUCCESS && both != 0;
    if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == aiReturn_SUCCESS) {
      from.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
      material.metallic = unitOf(metallic, 0);
      material.roughness = unitOf(roughness, 0.5f);
    } else {
      toMetallicRoughness(material);
    }
    material.albedoMap = mapOf(from, {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR}, TextureUse::color);
    material.emissiveMap = mapOf(from, {aiTextureType_EMISSIVE}, TextureUse::color);
    material.normalMap = mapOf(from, {aiTextureType_NORMALS}, TextureUse::numbers);
    if (material.normalMap == kNoRow)
      material.normalMap = mapOf(from, {aiTextureType_HEIGHT}, TextureUse::bump);
    model_.materials.push_back(std::move(material));
  }

  bool readInstance(unsigned index, std::uint32_t node) {
    const aiMesh& from = *scene_.mMeshes[index];
    if ((from.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return true;
    auto known = meshes_.find(index);
    if (known == meshes_.end()) {
      const std::optional<std::uint32_t> row = readMesh(from, index);
      if (!row) return false;
      known = meshes_.emplace(index, *row).first;
    }
    const bool skinned = model_.meshes[known->second].skinned;
    model_.instances.push_back({node, known->second, from.mMaterialIndex, skinned ? skins_[index] : kNoRow});
    return true;
  }

  // The format does not say what its colors are; other programs take them for sRGB (Blender 3.4 and later, three.js).
  static glm::vec4 toLinear(const aiColor4D& color) {
    const auto linear = [](float c) { return decodeSrgb(std::clamp(c, 0.0f, 1.0f)); };
    return {linear(color.r), linear(color.g), linear(color.b), std::clamp(color.a, 0.0f, 1.0f)};
  }

  std::optional<std::uint32_t> readMesh(const aiMesh& from, unsigned index) {
    const std::uint64_t corners = std::uint64_t{from.mNumFaces} * 3;
    if (!builder_.hasRoom(from.HasNormals() ? from.mNumVertices : corners, corners, files_.place(),
                          diagnostics_))
      return {};
    RawMesh mesh;
    mesh.name = from.mName.C_Str();
    mesh.join = true;
    const bool colored = from.HasVertexColors(0);
    mesh.normals = from.HasNormals();
    mesh.colors = colored;
    for (unsigned v = 0; v < from.mNumVertices; ++v) {
      const glm::vec3 position = toVec3(from.mVertices[v]);
      const aiVector3D uv = from.HasTextureCoords(0) ? from.mTextureCoords[0][v] : aiVector3D();
      const aiColor4D color = colored ? from.mColors[0][v] : aiColor4D();
      for (const float c :
           {position[0], position[1], position[2], uv.x, uv.y, color.r, color.g, color.b, color.a})
        if (!(std::abs(c) <= kFarthestVertex)) {
          fail(fmt::format("vertex {} of mesh '{}' is no number that can be used", v, mesh.name),
               fmt::format("finite numbers within {}", kFarthestVertex), fmt::format("{}", c),
               "repair the mesh and export it again");
          return {};
        }
      RawVertex& out = mesh.vertices.emplace_back(RawVertex{.position = position});
      if (from.HasNormals()) out.normal = toVec3(from.mNormals[v]);
      if (from.HasTextureCoords(0)) out.uv = {uv.x, 1 - uv.y};  // Assimp's v goes up
      if (colored) out.color = toLinear(color);
    }
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
      const aiFace& face = from.mFaces[f];
      if (face.mNumIndices != 3) continue;
      for (unsigned i = 0; i < 3; ++i) {
        if (face.mIndices[i] >= from.mNumVertices) {
          fail(fmt::format("a face of mesh '{}' names a vertex that is not there", mesh.name),
               fmt::format("an index below {}", from.mNumVertices), fmt::format("{}", face.mIndices[i]));
          return {};
        }
        mesh.indices.push_back(face.mIndices[i]);
      }
    }
    readBones(from, index, mesh);
    return builder_.add(std::move(mesh));
  }

  void readBones(const aiMesh& from, unsigned index, RawMesh& mesh) {
    if (from.mNumBones == 0 || from.mNumBones > 65535) return;
    ModelSkin skin;
    mesh.skinned = true;
    std::vector<std::array<std::uint32_t, 8>> joints(from.mNumVertices);
    std::vector<std::array<float, 8>> weights(from.mNumVertices);
    for (unsigned b = 0; b < from.mNumBones; ++b) {
      const aiBone& bone = *from.mBones[b];
      const auto node = rowByName_.find(bone.mName.C_Str());
      skin.joints.push_back(node == rowByName_.end() ? 0 : node->second);
      skin.inverseBind.push_back(toMatrix(bone.mOffsetMatrix));
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (weight.mVertexId >= from.mNumVertices || !(weight.mWeight > 0) || !std::isfinite(weight.mWeight))
          continue;
        auto& mine = weights[weight.mVertexId];
        const auto least = static_cast<std::size_t>(std::ranges::min_element(mine) - mine.begin());
        if (mine[least] >= weight.mWeight) continue;
        mine[least] = weight.mWeight;
        joints[weight.mVertexId][least] = b;
      }
    }
    for (unsigned v = 0; v < from.mNumVertices; ++v) mesh.vertices[v].skin = heaviest(joints[v], weights[v]);
    skins_[index] = static_cast<std::uint32_t>(model_.skins.size());
    model_.skins.push_back(std::move(skin));
  }

  template <class Key, class Value>
  static void addTrack(const Key* keys, unsigned count, double perSecond, std::uint32_t node, TrackPath path,
                       const Value& value, ModelAnimation& out) {
    ModelTrack track{.node = node, .path = path};
    for (unsigned k = 0; k < count; ++k) {
      const auto time = static_cast<float>(keys[k].mTime / perSecond);
      const glm::vec4 v = value(keys[k].mValue);
      const bool finite = std::isfinite(time) && isFinite(v);
      if (!finite || (!track.times.empty() && time < track.times.back())) continue;
      track.times.push_back(time);
      track.values.push_back(v);
    }
    if (track.times.empty()) return;
    out.duration = std::max(out.duration, track.times.back());
    out.tracks.push_back(std::move(track));
  }

  void readAnimations() {
    for (unsigned a = 0; a < scene_.mNumAnimations; ++a) {
      const aiAnimation& from = *scene_.mAnimations[a];
      ModelAnimation animation;
      animation.name = from.mName.C_Str();
      const double perSecond = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : 25;
      for (unsigned c = 0; c < from.mNumChannels; ++c) {
        const aiNodeAnim& channel = *from.mChannels[c];
        const auto node = rowByName_.find(channel.mNodeName.C_Str());
        if (node == rowByName_.end()) continue;
        const auto vector = [](const aiVector3D& v) { return glm::vec4{v.x, v.y, v.z, 0}; };
        const auto rotation = [](aiQuaternion q) {
          q.Normalize();
          return glm::vec4{q.x, q.y, q.z, q.w};
        };
        addTrack(channel.mPositionKeys, channel.mNumPositionKeys, perSecond, node->second,
                 TrackPath::translation, vector, animation);
        addTrack(channel.mRotationKeys, channel.mNumRotationKeys, perSecond, node->second,
                 TrackPath::rotation, rotation, animation);
        addTrack(channel.mScalingKeys, channel.mNumScalingKeys, perSecond, node->second, TrackPath::scale,
                 vector, animation);
      }
      model_.animations.push_back(std::make_shared<const ModelAnimation>(std::move(animation)));
    }
  }

  const aiScene& scene_;
  ModelFiles& files_;
  Diagnostics& diagnostics_;
  Model& model_;
  MeshBuilder builder_;
  TexturePool pool_;
  std::vector<std::pair<const aiNode*, std::uint32_t>> nodeRows_;
  std::map<std::string, std::uint32_t, std::less<>> rowByName_;
  std::map<std::string, std::uint32_t> images_;  // numbers in the pool
  std::map<unsigned, std::uint32_t> meshes_, skins_;
};

bool checkBefore(const std::string& bytes, ModelFiles& files, Diagnostics& diagnostics) {
  if (!isBinaryFbx(bytes) && !files.isTextInLimit(bytes)) return false;
  std::uint64_t unpacked = 0;
  const ModelProblem problem = checkFbx(bytes, unpacked);
  if (!problem.message.empty()) {
    text::Place place = files.place();
    place.line = problem.line;
    text::Diagnostic& d =
        diagnostics.error(problem.line > 0 ? Code::badModelValue : Code::unreadableModel, place,
                          fmt::format("cannot read model '{}': {}", files.path(), problem.message));
    d.expected = problem.expected;
    d.found = problem.found;
    return false;
  }
  return files.count(unpacked, files.place());
}

bool hasEndlessFace(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m)
    for (unsigned f = 0; f < scene.mMeshes[m]->mNumFaces; ++f)
      if (scene.mMeshes[m]->mFaces[f].mNumIndices > 4096) return true;
  return false;
}

}  // namespace

bool readFbx(std::string bytes, ModelFiles& files, const LoadObserver& observer, Diagnostics& diagnostics,
             Model& model) {
  if (!checkBefore(bytes, files, diagnostics)) return false;
  const std::size_t before = diagnostics.errorCount();
  Assimp::Importer importer;  // owns what is set here
  importer.SetIOHandler(new ModelIo(std::move(bytes)));
  importer.SetProgressHandler(new Progress(observer));
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(kName, 0);
  const auto unreadable = [&](const std::string& why) {
    if (diagnostics.errorCount() == before)
      diagnostics
          .error(Code::unreadableModel, files.place(),
                 fmt::format("cannot read model '{}': {}", files.path(), why))
          .expected = "an FBX file of version 7.1 or later";
    return false;
  };
  if (files.gaveUp()) return false;
  if (!scene || !scene->mRootNode) return unreadable(importer.GetErrorString());
  if (diagnostics.errorCount() > before) return false;
  if (hasEndlessFace(*scene)) return unreadable("a face of it has more than 4096 corners");
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
  if (!scene) return unreadable(importer.GetErrorString());
  return AssimpReader(*scene, files, diagnostics, model).read(observer);
}

}  // namespace weft::assets
