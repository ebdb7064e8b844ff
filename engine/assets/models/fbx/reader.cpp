// The program weft-fbx: an FBX file on standard input, read by Assimp, becomes a .glb (engine/text/apart.h). Its arguments are how much
// processor time, in seconds, and memory, in bytes, it may take. It is a program of its own, so that no other is linked with Assimp,
// which would cost each a fifth of its start.
#include <assimp/GltfMaterial.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <glm/gtc/color_space.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "engine/assets/models/fbx/fbx.h"
#include "engine/text/apart.h"

namespace weft::assets {

namespace {

using Json = nlohmann::json;

glm::vec3 toVec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

// Assimp's matrices are rows.
glm::mat4 toMatrix(const aiMatrix4x4& m) {
  return glm::transpose(glm::make_mat4(&m.a1));
}

// The format does not say what its colors are; other programs take them for sRGB (Blender 3.4 and later, three.js).
glm::vec4 toLinear(const aiColor4D& color) {
  return glm::convertSRGBToLinear(glm::clamp(glm::vec4(color.r, color.g, color.b, color.a), 0.0f, 1.0f));
}

float unitOf(float value, float otherwise) {
  return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : otherwise;
}

// What Assimp has read, as the bytes of a .glb. Blinn–Phong materials have the extension WEFT_blinn_phong, bump maps the member
// "bump", and the members of "extras" are what was left out: the glTF reader knows them.
class GltfWriter {
 public:
  explicit GltfWriter(const aiScene& scene) : scene_(scene) {}

  std::string write() {
    json_["bufferViews"] = {{{"buffer", 0}}};  // one for all accessors
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i)
      json_["materials"].push_back(materialOf(*scene_.mMaterials[i]));
    addNodes();
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) addAnimation(*scene_.mAnimations[i]);
    if (scene_.HasLights())
      json_["extras"]["each light, whose unit the format does not say,"] =
          "give the scene file a 'sun' and 'lamps'";
    if (scene_.HasCameras()) json_["extras"]["each camera"] = "";
    json_["asset"]["version"] = "2.0";
    json_["buffers"] = {{{"byteLength", binary_.size()}}};
    json_["bufferViews"][0]["byteLength"] = binary_.size();
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF";
    const auto add = [&](std::initializer_list<std::size_t> words) {  // of 4 bytes, the lowest first
      for (const std::size_t word : words) out.append(reinterpret_cast<const char*>(&word), 4);
    };
    add({2, 28 + text.size() + binary_.size(), text.size()});
    out += "JSON" + text;
    add({binary_.size()});
    return out.append("BIN\0", 4) += binary_;
  }

 private:
  // Where bytes that are added begin.
  std::size_t add(const void* bytes, std::size_t size) {
    const std::size_t at = binary_.size();
    binary_.append(static_cast<const char*>(bytes), size);
    binary_.resize((binary_.size() + 3) / 4 * 4);
    return at;
  }

  // The row of an accessor: T is float, a vector, a matrix, or whole numbers.
  template <class T>
  std::size_t accessor(const std::vector<T>& values) {
    constexpr const char* kKinds[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    constexpr std::size_t kNumbers = sizeof(T) / 4;
    constexpr bool kWhole = std::is_same_v<T, std::uint32_t> || std::is_same_v<T, glm::uvec4>;
    json_["accessors"].push_back({{"bufferView", 0},
                                  {"byteOffset", add(values.data(), values.size() * sizeof(T))},
                                  {"componentType", kWhole ? 5125 : 5126},
                                  {"count", values.size()},
                                  {"type", kNumbers == 16 ? "MAT4" : kKinds[(kNumbers - 1) % 4]}});
    return json_["accessors"].size() - 1;
  }

  // A texture of the first of these that there is, for `out`.
  void setTexture(const aiMaterial& from, std::initializer_list<aiTextureType> types, const char* key,
                  Json& out) {
    aiString path;
    for (const aiTextureType type : types) {
      if (from.GetTexture(type, 0, &path) != aiReturn_SUCCESS || path.length == 0) continue;
      const auto [known, isNew] = images_.try_emplace(path.C_Str(), images_.size());
      if (isNew) {
        json_["textures"].push_back({{"source", known->second}});
        json_["images"].push_back(imageOf(known->first));
      }
      out[key]["index"] = known->second;
      if (type == aiTextureType_HEIGHT) out[key]["bump"] = true;
      return;
    }
  }

  // Embedded, or a file.
  Json imageOf(const std::string& path) {
    const aiTexture* embedded = scene_.GetEmbeddedTexture(path.c_str());
    Json image = {{"name", path}};
    if (!embedded) image["uri"] = path;
    if (embedded && embedded->mHeight == 0) {  // else it is packed without a file format
      image["bufferView"] = json_["bufferViews"].size();
      json_["bufferViews"].push_back({{"buffer", 0},
                                      {"byteOffset", add(embedded->pcData, embedded->mWidth)},
                                      {"byteLength", embedded->mWidth}});
    }
    return image;
  }

  static glm::vec3 colorOf(const aiMaterial& from, const char* key, unsigned type, unsigned index,
                           glm::vec3 otherwise) {
    aiColor3D color;
    if (from.Get(key, type, index, color) != aiReturn_SUCCESS) return otherwise;
    return {unitOf(color.r, 0), unitOf(color.g, 0), unitOf(color.b, 0)};
  }

  Json materialOf(const aiMaterial& from) {
    const glm::vec3 albedo = colorOf(from, AI_MATKEY_COLOR_DIFFUSE, glm::vec3(0.6f)),
                    specular = colorOf(from, AI_MATKEY_COLOR_SPECULAR, glm::vec3(0)),
                    emissive = colorOf(from, AI_MATKEY_COLOR_EMISSIVE, glm::vec3(0));
    float shininess = 0, strength = 1, opacity = 1, metallic = 0, roughness = 0;
    int both = 0;
    from.Get(AI_MATKEY_SHININESS, shininess);
    from.Get(AI_MATKEY_SHININESS_STRENGTH, strength);
    from.Get(AI_MATKEY_OPACITY, opacity);
    from.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
    from.Get(AI_MATKEY_TWOSIDED, both);
    opacity = unitOf(opacity, 1);
    Json out = {{"name", from.GetName().C_Str()},
                {"emissiveFactor", {emissive.r, emissive.g, emissive.b}},
                {"alphaMode", opacity < 1 ? "BLEND" : "OPAQUE"},
                {"doubleSided", both != 0}};
    Json& surface = out["pbrMetallicRoughness"];
    surface["baseColorFactor"] = {albedo.r, albedo.g, albedo.b, opacity};
    surface["metallicFactor"] = unitOf(metallic, 0);
    if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == aiReturn_SUCCESS) {
      surface["roughnessFactor"] = unitOf(roughness, 0.5f);
    } else {
      Json& shine = out["extensions"]["WEFT_blinn_phong"];
      for (int c = 0; c < 3; ++c) shine["specular"].push_back(unitOf(specular[c] * strength, specular[c]));
      shine["shininess"] = std::isfinite(shininess) ? std::clamp(shininess, 0.0f, 10000.0f) : 0;
    }
    setTexture(from, {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR}, "baseColorTexture", surface);
    setTexture(from, {aiTextureType_EMISSIVE, aiTextureType_EMISSION_COLOR}, "emissiveTexture", out);
    setTexture(from, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT},
               "normalTexture", out);
    for (const auto type :
         {aiTextureType_SPECULAR, aiTextureType_OPACITY, aiTextureType_SHININESS, aiTextureType_METALNESS,
          aiTextureType_DIFFUSE_ROUGHNESS, aiTextureType_AMBIENT_OCCLUSION, aiTextureType_DISPLACEMENT})
      if (from.GetTextureCount(type) > 0)
        json_["extras"][std::string("each map ") + aiTextureTypeToString(type)] = "";
    return out;
  }

  void addNodes() {
    std::vector<const aiNode*> nodes{scene_.mRootNode};
    Json& rows = json_["nodes"];
    for (std::size_t row = 0; row < nodes.size(); ++row) {
      const aiNode& from = *nodes[row];
      rowOf_.try_emplace(from.mName.C_Str(), row);
      Json node = {{"name", from.mName.C_Str()}};
      if (from.mTransformation != aiMatrix4x4()) {
        const glm::mat4 matrix = toMatrix(from.mTransformation);
        node["matrix"] = std::vector<float>(&matrix[0].x, &matrix[0].x + 16);
      }
      for (unsigned c = 0; c < from.mNumChildren; ++c) {
        node["children"].push_back(nodes.size());
        nodes.push_back(from.mChildren[c]);
      }
      rows.push_back(std::move(node));
    }
    for (std::size_t row = 0; row < nodes.size(); ++row)
      for (unsigned i = 0; i < nodes[row]->mNumMeshes; ++i) addInstance(nodes[row]->mMeshes[i], row);
  }

  // A node has one mesh: further ones get nodes of their own.
  void addInstance(unsigned index, std::size_t row) {
    auto known = meshes_.find(index);
    if (known == meshes_.end()) known = meshes_.emplace(index, meshOf(*scene_.mMeshes[index])).first;
    if (known->second.is_null()) return;
    Json& rows = json_["nodes"];
    if (rows[row].contains("mesh")) {
      rows[row]["children"].push_back(rows.size());
      rows.push_back({{"name", Json(rows[row]["name"])}});
      row = rows.size() - 1;
    }
    rows[row].update(known->second);
  }

  // What a node with this mesh has: the mesh, and its skin. Null for one that draws nothing.
  Json meshOf(const aiMesh& from) {
    std::vector<std::uint32_t> indices;
    for (unsigned f = 0; f < from.mNumFaces; ++f)
      if (const aiFace& face = from.mFaces[f]; face.mNumIndices == 3)
        indices.insert(indices.end(), face.mIndices, face.mIndices + 3);
    if (indices.empty() || from.mNumVertices == 0) return nullptr;
    const auto each = [&](const auto* values, const auto& convert) {
      std::vector<decltype(convert(*values))> out;
      for (unsigned v = 0; v < from.mNumVertices; ++v) out.push_back(convert(values[v]));
      return accessor(out);
    };
    Json attributes = {{"POSITION", each(from.mVertices, toVec3)}}, made;
    if (from.HasNormals()) attributes["NORMAL"] = each(from.mNormals, toVec3);
    if (from.HasTextureCoords(0))  // whose v goes up
      attributes["TEXCOORD_0"] =
          each(from.mTextureCoords[0], [](const aiVector3D& uv) { return glm::vec2(uv.x, 1 - uv.y); });
    if (from.HasVertexColors(0)) attributes["COLOR_0"] = each(from.mColors[0], toLinear);
    if (from.mNumAnimMeshes > 0) json_["extras"]["each shape key"] = "";
    if (from.mNumBones > 0 && from.mNumBones <= 65535) made["skin"] = addSkin(from, attributes);
    const Json primitive = {
        {"attributes", attributes}, {"indices", accessor(indices)}, {"material", from.mMaterialIndex}};
    made["mesh"] = json_["meshes"].size();
    json_["meshes"].push_back({{"name", from.mName.C_Str()}, {"primitives", {primitive}}});
    return made;
  }

  std::size_t addSkin(const aiMesh& from, Json& attributes) {
    std::vector<glm::uvec4> joints(from.mNumVertices);
    std::vector<glm::vec4> weights(from.mNumVertices, glm::vec4(0));
    std::vector<glm::mat4> inverse;
    Json skin;
    for (unsigned b = 0; b < from.mNumBones; ++b) {
      const aiBone& bone = *from.mBones[b];
      const auto node = rowOf_.find(bone.mName.C_Str());
      skin["joints"].push_back(node == rowOf_.end() ? 0 : node->second);
      inverse.push_back(toMatrix(bone.mOffsetMatrix));
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (weight.mVertexId >= from.mNumVertices || !std::isfinite(weight.mWeight)) continue;
        glm::vec4& mine = weights[weight.mVertexId];
        const auto least = static_cast<int>(std::min_element(&mine.x, &mine.x + 4) - &mine.x);
        if (mine[least] >= weight.mWeight) continue;
        mine[least] = weight.mWeight;
        joints[weight.mVertexId][least] = b;
      }
    }
    attributes["JOINTS_0"] = accessor(joints);
    attributes["WEIGHTS_0"] = accessor(weights);
    skin["inverseBindMatrices"] = accessor(inverse);
    json_["skins"].push_back(std::move(skin));
    return json_["skins"].size() - 1;
  }

  void addAnimation(const aiAnimation& from) {
    Json animation = {{"name", from.mName.C_Str()}};
    const double perSecond = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : 25;
    for (unsigned c = 0; c < from.mNumChannels; ++c) {
      const aiNodeAnim& channel = *from.mChannels[c];
      const auto node = rowOf_.find(channel.mNodeName.C_Str());
      if (node == rowOf_.end()) continue;
      // What is no number, or earlier than the key before, is left out.
      const auto add = [&](const auto* keys, unsigned count, const char* path, const auto& convert) {
        std::vector<float> times;
        std::vector<decltype(convert(keys->mValue))> values;
        for (unsigned k = 0; k < count; ++k) {
          const float time = std::max(0.0f, static_cast<float>(keys[k].mTime / perSecond));
          const auto value = convert(keys[k].mValue);
          if (!std::isfinite(time + glm::dot(value, value)) || (!times.empty() && time < times.back()))
            continue;
          times.push_back(time);
          values.push_back(value);
        }
        if (times.empty()) return;
        animation["channels"].push_back({{"sampler", animation["samplers"].size()},
                                         {"target", {{"node", node->second}, {"path", path}}}});
        animation["samplers"].push_back({{"input", accessor(times)}, {"output", accessor(values)}});
      };
      add(channel.mPositionKeys, channel.mNumPositionKeys, "translation", toVec3);
      add(channel.mRotationKeys, channel.mNumRotationKeys, "rotation",
          [](const aiQuaternion& q) { return glm::vec4(q.x, q.y, q.z, q.w); });
      add(channel.mScalingKeys, channel.mNumScalingKeys, "scale", toVec3);
    }
    json_["animations"].push_back(std::move(animation));
  }

  const aiScene& scene_;
  Json json_;
  std::string binary_;
  std::map<std::string, std::size_t, std::less<>> rowOf_;  // of nodes
  std::map<std::string, std::size_t> images_;
  std::map<unsigned, Json> meshes_;
};

// One of these words; `out` becomes the .glb, or the reason why there is none.
char convert(const std::string& bytes, std::string& out) try {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                     aiProcess_Triangulate | aiProcess_SortByPType, "fbx");
  if (importer.GetException()) std::rethrow_exception(importer.GetException());
  out = scene ? GltfWriter(*scene).write() : importer.GetErrorString();
  return scene ? kMade : kUnreadable;
} catch (const std::bad_alloc&) {
  return kTooLarge;
} catch (const std::exception& error) {
  out = error.what();
  return kUnreadable;
}

}  // namespace
}  // namespace weft::assets

int main(int argc, char** argv) {
  using namespace weft;
  using namespace weft::assets;
  const std::string input = text::beginApart();
  if (argc < 3) text::endApart();
  text::takeLimits(std::strtoull(argv[1], nullptr, 10), std::strtoull(argv[2], nullptr, 10));
  // Assimp goes on without a mesh for which there is no memory.
  static bool full = false;
  std::set_new_handler([] {
    full = true;
    throw std::bad_alloc();
  });
  std::string made;
  const char what = convert(input, made);
  text::endApart(made, full ? kTooLarge : what);
}
