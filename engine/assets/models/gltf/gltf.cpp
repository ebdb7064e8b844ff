#include "engine/assets/models/gltf/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/assets/models/gltf/gltf_lights.h"
#include "engine/assets/models/gltf/gltf_materials.h"
#include "engine/assets/models/gltf/gltf_nodes.h"
#include "engine/assets/models/parts/mesh_builder.h"

namespace weft::assets {

using base::Code;
using base::Diagnostics;
using base::JsonValue;

namespace {

constexpr float kFarthest = 1e9f;  // as of everything in a scene

class GltfReader {
 public:
  GltfReader(GltfDocument& document, ModelFiles& files, Diagnostics& diagnostics, Model& model)
      : document_(document), files_(files), diagnostics_(diagnostics), model_(model), builder_(model) {}

  bool read(const LoadObserver& observer) {
    const std::size_t before = diagnostics_.errorCount();
    if (!readGltfNodes(document_, model_, nodes_) || !readGltfSkins(document_, nodes_, model_)) return false;
    TexturePool pool(diagnostics_);
    auto materials = readGltfMaterials(document_, files_, pool, observer, diagnostics_);
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
    const std::vector<Part>* parts = partsOf(*mesh, skin != kNoRow);
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

  // A mesh is read once with its weights and once without, where nodes use it both ways.
  const std::vector<Part>* partsOf(std::uint32_t mesh, bool skinned) {
    const auto known = parts_.find({mesh, skinned});
    if (known != parts_.end()) return &known->second;
    std::vector<Part> parts;
    const JsonValue& value = document_.rows("meshes")[mesh];
    const JsonValue* primitives = value.find("primitives");
    std::string name = document_.text(value, "name");
    if (name.empty()) name = fmt::format("mesh {}", mesh);
    for (std::size_t i = 0; primitives && i < primitives->items.size(); ++i) {
      Part part;
      const std::string each = primitives->items.size() == 1 ? name : fmt::format("{}[{}]", name, i);
      if (!readPrimitive(primitives->items[i], each, skinned, part)) return nullptr;
      if (part.mesh != kNoRow) parts.push_back(part);
    }
    return &parts_.emplace(std::pair{mesh, skinned}, std::move(parts)).first->second;
  }

  void leaveOut(const JsonValue& where, std::string message) {
    diagnostics_.warning(Code::modelPartLeftOut, where.place, std::move(message)).pointer = where.pointer;
  }

  bool readPrimitive(const JsonValue& value, const std::string& name, bool skinned, Part& part) {
    const JsonValue* attributes = value.find("attributes");
    const JsonValue* positions = attributes ? attributes->find("POSITION") : nullptr;
    const double mode = document_.number(value, "mode", 4, 0, 6);
    if (mode < 4 || !positions) {
      leaveOut(value, fmt::format("mesh '{}' was left out: {}", name,
                                  positions ? "points and lines are not drawn" : "it has no positions"));
      return true;
    }
    if (value.find("targets"))
      leaveOut(value, fmt::format("the morph targets of mesh '{}' were left out", name));
    if (attributes->find("COLOR_0"))
      leaveOut(value, fmt::format("the vertex colours of mesh '{}' were left out", name));
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
    if (!readAttributes(*attributes, part.material, mesh)) return false;
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

  template <std::size_t N>
  bool readVectors(const JsonValue& where, const GltfAccessor& accessor, const char* name, float most,
                   std::vector<std::array<float, N>>& out) {
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
      out[i / N][i % N] = values[i];
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
    for (Float2& each : mesh.uvs) {
      const float u = each[0] * uv.scale[0], v = each[1] * uv.scale[1];
      each = {c * u + s * v + uv.offset[0], -s * u + c * v + uv.offset[1]};
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
      std::vector<Float4> values;
      if (!readVectors(*attributes.find(name), *weights, name.c_str(), 1e6f, values)) return false;
      mesh.joints.resize(count_);
      mesh.weights.resize(count_);
      for (std::size_t v = 0; v < count_; ++v)
        for (std::size_t i = 0; i < 4; ++i) {
          mesh.joints[v][4 * set + i] = rows[4 * v + i];
          mesh.weights[v][4 * set + i] = std::max(0.0f, values[v][i]);
          // A weight of 0 asks for no joint; a vertex without any weight stands with its first.
          if (values[v][i] > 0 || (set == 0 && i == 0))
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
  std::map<std::pair<std::uint32_t, bool>, std::vector<Part>> parts_;
  std::uint32_t count_ = 0;  // of vertices of the primitive that is read
};

}  // namespace

bool readGltf(std::string bytes, ModelFiles& files, const LoadObserver& observer, Diagnostics& diagnostics,
              Model& model) {
  GltfDocument document(files, diagnostics);
  return document.open(std::move(bytes)) && GltfReader(document, files, diagnostics, model).read(observer);
}

}  // namespace weft::assets
