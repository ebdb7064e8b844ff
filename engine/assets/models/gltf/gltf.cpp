#include "engine/assets/models/gltf/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/assets/models/gltf/gltf_materials.h"
#include "engine/assets/models/gltf/gltf_nodes.h"
#include "engine/assets/models/parts/mesh_builder.h"

namespace weft::assets {

using base::Diagnostics;
using base::JsonValue;

namespace {

constexpr float kFarthest = 1e9f;  // as of everything in a scene

class GltfReader {
 public:
  GltfReader(GltfDocument& document, ModelFiles& files, Diagnostics& diagnostics, Model& model)
      : document_(document), files_(files), diagnostics_(diagnostics), model_(model), builder_(model) {}

  bool read(const LoadObserver& observer, const DecodeRunner& decode) {
    const std::size_t before = diagnostics_.errorCount();
    if (!readGltfNodes(document_, model_, nodes_) || !readGltfSkins(document_, nodes_, model_)) return false;
    TexturePool pool(diagnostics_);
    auto materials = readGltfMaterials(document_, files_, pool, observer, decode, diagnostics_);
    if (!materials) return false;
    uvs_ = std::move(materials->uvs);
    model_.materials = std::move(materials->materials);
    model_.textures = pool.take();
    const std::vector<JsonValue>& rows = document_.rows("nodes");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (observer &&
          !observer(LoadStage::converting, static_cast<double>(i) / static_cast<double>(rows.size())))
        return false;
      if (nodes_.shown[i] && !readInstances(rows[i], nodes_.rowOf[i])) return false;
    }
    return readGltfLights(document_, nodes_, diagnostics_, model_) &&
           readGltfAnimations(document_, files_, nodes_, model_) && diagnostics_.errorCount() == before;
  }

 private:
  struct Part {
    std::uint32_t mesh = kNoRow, material = 0;
    std::uint64_t joints = 0;  // that its vertices name, at least
  };

  bool readInstances(const JsonValue& node, std::uint32_t row) {
    const JsonValue* name = node.find("mesh");
    if (!name) return true;
    const auto mesh = document_.index("meshes", name);
    if (!mesh) return false;
    std::uint32_t skin = kNoRow;
    if (const JsonValue* which = node.find("skin")) {
      const auto found = document_.index("skins", which);
      if (!found) return false;
      skin = *found;
    }
    const std::vector<Part>* parts = partsOf(*mesh, skin != kNoRow, node);
    if (!parts) return false;
    for (const Part& part : *parts) {
      const bool skinned = model_.meshes[part.mesh].skinned;
      if (skinned && part.joints > model_.skins[skin].joints.size()) {
        base::Diagnostic& d =
            document_.fail(node, "vertices are moved by joints that the skin does not have");
        d.expected = fmt::format("joints below {}", model_.skins[skin].joints.size());
        d.found = fmt::format("joint {}", part.joints - 1);
        return false;
      }
      model_.instances.push_back({row, part.mesh, part.material, skinned ? skin : kNoRow});
    }
    return true;
  }

  // How far morph targets have moved a mesh when nothing animates it: as the node says, else as the mesh does.
  bool readMorphWeights(const JsonValue& node, const JsonValue& mesh, std::vector<float>& weights) {
    const JsonValue* own = node.find("weights");
    const JsonValue* found = own ? own : mesh.find("weights");
    if (!found) return true;
    weights.resize(found->items.size());
    return document_.numbers(own ? node : mesh, "weights", weights.size(), weights.data());
  }

  // A mesh is read once with its joints and once without, and once for each way in which it is morphed, where nodes use it
  // so.
  const std::vector<Part>* partsOf(std::uint32_t mesh, bool skinned, const JsonValue& node) {
    const JsonValue& value = document_.rows("meshes")[mesh];
    std::vector<float> weights;
    if (!readMorphWeights(node, value, weights)) return nullptr;
    const auto key = std::tuple(mesh, skinned, weights);
    const auto known = parts_.find(key);
    if (known != parts_.end()) return &known->second;
    std::vector<Part> parts;
    const JsonValue* primitives = value.find("primitives");
    std::string name = document_.text(value, "name");
    if (name.empty()) name = fmt::format("mesh {}", mesh);
    for (std::size_t i = 0; primitives && i < primitives->items.size(); ++i) {
      Part part;
      const std::string each = primitives->items.size() == 1 ? name : fmt::format("{}[{}]", name, i);
      if (!readPrimitive(primitives->items[i], each, skinned, weights, part)) return nullptr;
      if (part.mesh != kNoRow) parts.push_back(part);
    }
    return &parts_.emplace(key, std::move(parts)).first->second;
  }

  bool readPrimitive(const JsonValue& value, const std::string& name, bool skinned,
                     const std::vector<float>& weights, Part& part) {
    const JsonValue* attributes = value.find("attributes");
    const JsonValue* positions = attributes ? attributes->find("POSITION") : nullptr;
    const double mode = document_.number(value, "mode", 4, 0, 6);
    if (mode < 4 || !positions) {
      document_.leaveOut(value,
                         fmt::format("mesh '{}' was left out: {}", name,
                                     positions ? "points and lines are not drawn" : "it has no positions"));
      return true;
    }
    part.material = static_cast<std::uint32_t>(model_.materials.size() - 1);
    if (const JsonValue* material = value.find("material")) {
      const auto row = document_.index("materials", material);
      if (!row) return false;
      part.material = *row;
    }
    RawMesh mesh;
    mesh.name = name;
    const GltfAccessor* accessor = document_.accessor(positions, "VEC3", true);
    if (!accessor) return false;
    count_ = accessor->count;
    const GltfAccessor* indices = nullptr;
    if (const JsonValue* which = value.find("indices")) {
      indices = document_.accessor(which, "SCALAR", false);
      if (!indices) return false;
    }
    const std::uint64_t corners = std::uint64_t{indices ? indices->count : count_} * (mode == 4 ? 1 : 3);
    const bool flat = !attributes->find("NORMAL");
    if (!builder_.hasRoom(flat ? corners : count_, corners, value.place, diagnostics_)) return false;
    if (!readVectors(*positions, *accessor, "POSITION", kFarthest, mesh.positions)) return false;
    if (!readAttributes(*attributes, part.material, mesh) || !readColors(*attributes, mesh)) return false;
    if (const JsonValue* targets = value.find("targets"); targets && !morph(*targets, weights, mesh))
      return false;
    if (skinned && !readWeights(*attributes, mesh, part)) return false;
    if (!readIndices(value, indices, static_cast<int>(mode), mesh)) return false;
    if (!mesh.indices.empty()) part.mesh = builder_.add(std::move(mesh));
    return true;
  }

  // An attribute of the primitive: null when it is absent, or after an error.
  const GltfAccessor* attribute(const JsonValue& attributes, const std::string& name, std::string_view kind,
                                bool floats, bool& good) {
    const JsonValue* which = attributes.find(name);
    if (!which) return nullptr;
    const GltfAccessor* accessor = document_.accessor(which, kind, floats);
    if (accessor && accessor->count == count_) return accessor;
    if (accessor) {
      base::Diagnostic& d =
          document_.fail(*which, fmt::format("'{}' has not one value for each vertex", name));
      d.expected = fmt::format("{} elements", count_);
      d.found = fmt::format("{}", accessor->count);
    }
    good = false;
    return nullptr;
  }

  template <class Vector>
  bool readVectors(const JsonValue& where, const GltfAccessor& accessor, const char* name, float most,
                   std::vector<Vector>& out) {
    constexpr std::size_t N = Vector::length();
    const std::vector<float> values = readFloats(accessor);
    out.resize(accessor.count);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(std::abs(values[i]) <= most)) {
        base::Diagnostic& d = document_.fail(
            where, fmt::format("'{}' of vertex {} is no number that can be used", name, i / N));
        d.expected = fmt::format("finite numbers within {}", most);
        d.found = fmt::format("{}", values[i]);
        d.hint = "repair the mesh and export it again";
        return false;
      }
      out[i / N][static_cast<int>(i % N)] = values[i];
    }
    return true;
  }

  bool readAttributes(const JsonValue& attributes, std::uint32_t material, RawMesh& mesh) {
    bool good = true;
    // Normals and tangents that are no numbers are made anew.
    if (const GltfAccessor* normals = attribute(attributes, "NORMAL", "VEC3", true, good)) {
      const std::vector<float> values = readFloats(*normals);
      for (std::size_t i = 0; i < count_; ++i)
        mesh.normals.push_back({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
    }
    if (const GltfAccessor* tangents = attribute(attributes, "TANGENT", "VEC4", true, good)) {
      const std::vector<float> values = readFloats(*tangents);
      for (std::size_t i = 0; i < count_; ++i)
        mesh.tangents.push_back({values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]});
    }
    const GltfUv& uv = uvs_[material];
    const std::string name = fmt::format("TEXCOORD_{}", uv.set);
    const GltfAccessor* coordinates = attribute(attributes, name, "VEC2", true, good);
    if (!good) return false;
    if (!coordinates) return true;
    if (!readVectors(*attributes.find(name), *coordinates, name.c_str(), 1e6f, mesh.uvs)) return false;
    if (uv == GltfUv{.set = uv.set}) return true;
    // Counter-clockwise as uv are drawn, with v downwards: github.com/KhronosGroup/glTF/issues/1563.
    const float c = std::cos(uv.rotation), s = std::sin(uv.rotation);
    for (glm::vec2& each : mesh.uvs) {
      const float u = each[0] * uv.scale[0], v = each[1] * uv.scale[1];
      each = {c * u + s * v + uv.offset[0], -s * u + c * v + uv.offset[1]};
    }
    return true;
  }

  // glTF 2.0, 3.7.2.1: linear, clamped to 0..1; floats, or unsigned bytes and shorts that are normalised.
  bool readColors(const JsonValue& attributes, RawMesh& mesh) {
    const JsonValue* where = attributes.find("COLOR_0");
    if (!where) return true;
    const std::string_view kind = document_.kindOf(*where) == "VEC3" ? "VEC3" : "VEC4";
    bool good = true;
    const GltfAccessor* accessor = attribute(attributes, "COLOR_0", kind, true, good);
    if (!accessor) return good;
    const bool whole = accessor->type == 5121 || accessor->type == 5123;
    if (accessor->type != 5126 && !(whole && accessor->normalized)) {
      base::Diagnostic& d =
          document_.leaveOut(*where, fmt::format("the vertex colours of mesh '{}' were left out", mesh.name));
      d.expected = "floats, or normalised unsigned numbers of 8 or 16 bits";
      d.found = fmt::format("componentType {}{}", accessor->type, accessor->normalized ? ", normalised" : "");
      return true;
    }
    const auto put = [&](auto values) {
      if (!readVectors(*where, *accessor, "COLOR_0", 1e9f, values)) return false;
      for (const auto& value : values) {
        glm::vec4& color = mesh.colors.emplace_back(1.0f);
        for (int c = 0; c < value.length(); ++c) color[c] = std::clamp(value[c], 0.0f, 1.0f);
      }
      return true;
    };
    return kind == "VEC3" ? put(std::vector<glm::vec3>{}) : put(std::vector<glm::vec4>{});
  }

  // The mesh as its targets move it, each by its weight. glTF 2.0, 3.7.2.2.
  bool morph(const JsonValue& targets, const std::vector<float>& weights, RawMesh& mesh) {
    for (std::size_t t = 0; t < std::min(weights.size(), targets.items.size()); ++t) {
      const JsonValue& target = targets.items[t];
      if (weights[t] == 0) continue;
      // The same accessor may serve any number of targets.
      if (!files_.count(std::uint64_t{count_} * sizeof(glm::vec3) * target.members.size(), target.place))
        return false;
      const auto add = [&](const char* name, auto& to) {
        bool good = true;
        std::vector<glm::vec3> moves;
        const GltfAccessor* accessor = to.empty() ? nullptr : attribute(target, name, "VEC3", true, good);
        if (!accessor) return good;
        if (!readVectors(*target.find(name), *accessor, name, kFarthest, moves)) return false;
        for (std::size_t v = 0; v < count_; ++v)
          for (int c = 0; c < 3; ++c) to[v][c] += weights[t] * moves[v][c];
        return true;
      };
      if (!add("POSITION", mesh.positions) || !add("NORMAL", mesh.normals) || !add("TANGENT", mesh.tangents))
        return false;
    }
    for (const glm::vec3& position : mesh.positions)
      if (!glm::all(glm::lessThanEqual(glm::abs(position), glm::vec3(kFarthest)))) {
        document_.fail(targets, fmt::format("the morph targets move mesh '{}' too far", mesh.name)).expected =
            fmt::format("positions within {}", kFarthest);
        return false;
      }
    return true;
  }

  bool readWeights(const JsonValue& attributes, RawMesh& mesh, Part& part) {
    for (std::size_t set = 0; set < 2; ++set) {
      bool good = true;
      const GltfAccessor* joints = attribute(attributes, fmt::format("JOINTS_{}", set), "VEC4", false, good);
      const std::string name = fmt::format("WEIGHTS_{}", set);
      const GltfAccessor* weights = attribute(attributes, name, "VEC4", true, good);
      if (!good) return false;
      if (!joints || !weights) return true;
      const std::vector<std::uint32_t> rows = readWhole(*joints);
      std::vector<glm::vec4> values;
      if (!readVectors(*attributes.find(name), *weights, name.c_str(), 1e6f, values)) return false;
      mesh.joints.resize(count_);
      mesh.weights.resize(count_);
      for (std::size_t v = 0; v < count_; ++v)
        for (std::size_t i = 0; i < 4; ++i) {
          mesh.joints[v][4 * set + i] = rows[4 * v + i];
          mesh.weights[v][4 * set + i] = std::max(0.0f, values[v][static_cast<int>(i)]);
          // A weight of 0 asks for no joint; a vertex without any weight stands with its first.
          if (values[v][static_cast<int>(i)] > 0 || (set == 0 && i == 0))
            part.joints = std::max(part.joints, std::uint64_t{rows[4 * v + i]} + 1);
        }
    }
    return true;
  }

  bool readIndices(const JsonValue& value, const GltfAccessor* accessor, int mode, RawMesh& mesh) {
    std::vector<std::uint32_t> indices;
    if (accessor) {
      indices = readWhole(*accessor);
      const auto bad = std::ranges::find_if(indices, [&](std::uint32_t i) { return i >= count_; });
      if (bad != indices.end()) {
        base::Diagnostic& d = document_.fail(
            *value.find("indices"),
            fmt::format("index {} of mesh '{}' names no vertex", bad - indices.begin(), mesh.name));
        d.expected = fmt::format("an index below {}", count_);
        d.found = fmt::format("{}", *bad);
        return false;
      }
    } else {
      for (std::uint32_t i = 0; i < count_; ++i) indices.push_back(i);
    }
    if (mode == 4) {
      indices.resize(indices.size() / 3 * 3);
      mesh.indices = std::move(indices);
      return true;
    }
    // A strip turns every second triangle round; a fan goes on from its first corner.
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
      const bool strip = mode == 5, odd = i % 2 != 0;
      mesh.indices.push_back(indices[strip ? i : i + 1]);
      mesh.indices.push_back(indices[strip ? (odd ? i + 2 : i + 1) : i + 2]);
      mesh.indices.push_back(indices[strip ? (odd ? i + 1 : i + 2) : 0]);
    }
    return true;
  }

  GltfDocument& document_;
  ModelFiles& files_;
  Diagnostics& diagnostics_;
  Model& model_;
  MeshBuilder builder_;
  GltfNodes nodes_;
  std::vector<GltfUv> uvs_;
  std::map<std::tuple<std::uint32_t, bool, std::vector<float>>, std::vector<Part>> parts_;
  std::uint32_t count_ = 0;  // of vertices of the primitive that is read
};

}  // namespace

bool readGltf(std::string bytes, ModelFiles& files, const LoadObserver& observer, const DecodeRunner& decode,
              Diagnostics& diagnostics, Model& model) {
  GltfDocument document(files, diagnostics);
  return document.open(std::move(bytes)) &&
         GltfReader(document, files, diagnostics, model).read(observer, decode);
}

}  // namespace weft::assets
