// From the document to a Model. Declared in gltf_document.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "assets_sentences.h"
#include "engine/assets/models/gltf/gltf_document.h"
#include "engine/assets/models/parts/mesh_builder.h"

namespace weft::assets {

using text::Diagnostics;
using text::JsonValue;

namespace {

// The place of a word among others; their number when it is none of them.
std::size_t rowOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return static_cast<std::size_t>(std::ranges::find(words, word) - words.begin());
}

class GltfReader {
 public:
  GltfReader(GltfDocument& document, ModelFiles& files, Model& model, bool made)
      : document_(document), files_(files), model_(model), made_(made) {}

  void read() {
    if (const JsonValue* leftOut = made_ ? document_.root().find("extras") : nullptr)
      for (const auto& each : leftOut->members)
        document_.leaveOut(say::leftOut, each.value, each.key, each.value.text);
    readNodes();
    for (const JsonValue& row : document_.rows("skins")) readSkin(row);
    for (const JsonValue& row : document_.rows("animations")) readAnimation(row);
    uvs_ = readMaterials(document_, files_, model_, made_);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      GltfDocument::refuseUnless(!files_.stop().stop_requested());
      if (shown_[i]) readInstances(rows_[i], rowOf_[i]);
    }
    readLights();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (const JsonValue* camera = rows_[i].find("camera"); camera && shown_[i])
        readCamera(document_.rows("cameras")[document_.index("cameras", *camera)], i);
  }

 private:
  // --- nodes and skins

  ModelNode readNode(const JsonValue& value, std::size_t number) {
    ModelNode node;
    node.name = textOf(value, "name", fmt::format("node {}", number));
    glm::mat4 matrix(0);
    if (document_.numbers(value, "matrix", {&matrix[0].x, 16})) {
      node.local.translation = glm::vec3(matrix[3]);
      node.inner = glm::mat3(matrix);
      return node;
    }
    glm::vec4 rotation(0, 0, 0, 1);
    document_.numbers(value, "translation", {&node.local.translation.x, 3});
    document_.numbers(value, "scale", {&node.local.scale.x, 3});
    document_.numbers(value, "rotation", {&rotation.x, 4});
    if (!normalizeRotation(rotation))
      document_.fail(say::rotationWithoutLength, *value.find("rotation"), number);
    node.local.rotation = toRotation(rotation);
    return node;
  }

  std::uint32_t addNode(ModelNode node) {
    model_.nodes.push_back(std::move(node));
    return static_cast<std::uint32_t>(model_.nodes.size() - 1);
  }

  // Parents before their children: rowOf_ takes a node of the file to its row. Shown are the roots of the scene and all below, up to
  // what is invisible (KHR_node_visibility).
  void readNodes() {
    std::vector<std::uint32_t> parents(rows_.size(), kNoRow), work;
    for (std::uint32_t i = 0; i < rows_.size(); ++i)
      for (const JsonValue& item : itemsOf(rows_[i], "children")) {
        std::uint32_t& parent = parents[document_.index("nodes", item)];
        if (parent != kNoRow) document_.fail(say::noChild, item, i, parent);
        parent = i;
      }
    const std::vector<bool> roots = findRoots(parents);
    rowOf_.assign(rows_.size(), kNoRow);
    shown_.assign(rows_.size(), false);
    for (std::size_t i = rows_.size(); i-- > 0;)
      if (parents[i] == kNoRow) work.push_back(static_cast<std::uint32_t>(i));
    while (!work.empty()) {
      const std::uint32_t at = work.back();
      work.pop_back();
      ModelNode node = readNode(rows_[at], at);
      const std::uint32_t parent = parents[at];
      if (parent != kNoRow) node.parent = rowOf_[parent];
      const JsonValue* visible = valueOf(rows_[at], {"extensions", "KHR_node_visibility", "visible"});
      shown_[at] = (roots[at] || (parent != kNoRow && shown_[parent])) && (!visible || visible->flag);
      rowOf_[at] = addNode(std::move(node));
      const std::vector<JsonValue>& children = itemsOf(rows_[at], "children");
      for (std::size_t c = children.size(); c-- > 0;) work.push_back(document_.index("nodes", children[c]));
    }
    if (const auto missing = std::ranges::find(rowOf_, kNoRow); missing != rowOf_.end())
      document_.fail(say::ownAncestor, rows_[static_cast<std::size_t>(missing - rowOf_.begin())],
                     missing - rowOf_.begin());
  }

  // What the scene names. Without a scene, what has no parent.
  std::vector<bool> findRoots(const std::vector<std::uint32_t>& parents) const {
    const std::vector<JsonValue>& scenes = document_.rows("scenes");
    const JsonValue* chosen = document_.root().find("scene");
    std::vector<bool> roots(rows_.size(), false);
    if (!scenes.empty())
      for (const JsonValue& item : itemsOf(scenes[chosen ? document_.index("scenes", *chosen) : 0], "nodes"))
        roots[document_.index("nodes", item)] = true;
    for (std::size_t i = 0; scenes.empty() && i < roots.size(); ++i) roots[i] = parents[i] == kNoRow;
    return roots;
  }

  void readSkin(const JsonValue& row) {
    ModelSkin& skin = model_.skins.emplace_back();
    const std::vector<JsonValue>& joints = itemsOf(row, "joints");
    if (joints.empty() || joints.size() > 65535) document_.fail(say::jointsOutOfRange, row);
    for (const JsonValue& item : joints) skin.joints.push_back(rowOf_[document_.index("nodes", item)]);
    skin.inverseBind.assign(joints.size(), glm::mat4(1));
    const JsonValue* matrices = row.find("inverseBindMatrices");
    if (!matrices) return;
    const GltfAccessor accessor = document_.accessor(*matrices, "MAT4", true);
    if (accessor.count < joints.size() || accessor.count > 65536 || accessor.type != 5126)
      document_.fail(say::matricesMisfitJoints, *matrices, joints.size(), accessor.count, accessor.type);
    const std::vector<float> values = document_.read<float>(accessor);
    if (!std::ranges::all_of(values, [](float v) { return std::isfinite(v); }))
      document_.fail(say::matrixNotFinite, *matrices);
    for (std::size_t j = 0; j < joints.size(); ++j)
      skin.inverseBind[j] = glm::make_mat4(values.data() + 16 * j);
  }

  // glTF 2.0, 3.10: at the origin of its node.
  void readCamera(const JsonValue& value, std::size_t node) {
    ModelCamera camera{
        .name = textOf(value, "name", textOf(rows_[node], "name", fmt::format("camera {}", node))),
        .node = rowOf_[node]};
    const bool flat = textOf(value, "type") == "orthographic";
    const JsonValue& lens = document_.need(value, flat ? "orthographic" : "perspective");
    if (flat)
      camera.height = 2 * document_.number(lens, {"ymag"}, 1, 1e-9, 1e9);
    else
      camera.fovDegrees = glm::degrees(document_.number(lens, {"yfov"}, 1, 1e-3, 3.1));
    camera.nearPlane = std::max(1e-6f, document_.number(lens, {"znear"}, 0.1, 0, 1e9));
    model_.cameras.push_back(std::move(camera));
  }

  // --- meshes

  struct Part {
    std::uint32_t mesh = kNoRow, material = 0;
    std::uint64_t joints = 0;  // that its vertices name, at least
  };

  void readInstances(const JsonValue& node, std::uint32_t row) {
    const JsonValue *mesh = node.find("mesh"), *which = node.find("skin");
    if (!mesh) return;
    const std::uint32_t skin = which ? document_.index("skins", *which) : kNoRow;
    const std::vector<std::uint32_t> nodes = instancesOf(node, row);
    for (const Part& part : partsOf(document_.index("meshes", *mesh), skin != kNoRow, node, row)) {
      const bool skinned = model_.meshes[part.mesh].skinned;
      if (skinned && part.joints > model_.skins[skin].joints.size())
        document_.fail(say::noSuchJoints, node, model_.skins[skin].joints.size(), part.joints - 1);
      for (const std::uint32_t each : nodes)
        model_.instances.push_back({each, part.mesh, part.material, skinned ? skin : kNoRow});
    }
  }

  // The rows that show the node's mesh: its own, or those that EXT_mesh_gpu_instancing puts below it.
  std::vector<std::uint32_t> instancesOf(const JsonValue& node, std::uint32_t row) {
    const JsonValue* attributes = valueOf(node, {"extensions", "EXT_mesh_gpu_instancing", "attributes"});
    if (!attributes || attributes->members.empty()) return {row};
    const JsonValue& any = attributes->members[0].value;
    const std::string kind = textOf(document_.rows("accessors")[document_.index("accessors", any)], "type");
    count_ = document_.accessor(any, kind, true).count;
    GltfDocument::refuseUnless(files_.count(std::uint64_t{count_} * sizeof(ModelNode), node.place));
    const std::vector<glm::vec3> moves = attribute<glm::vec3>(*attributes, "TRANSLATION", kFarthest),
                                 scales = attribute<glm::vec3>(*attributes, "SCALE", kFarthest);
    std::vector<glm::vec4> turns = attribute<glm::vec4>(*attributes, "ROTATION", 2);
    std::vector<std::uint32_t> rows;
    for (std::uint32_t i = 0; i < count_; ++i) {
      ModelNode each{model_.nodes[row].name, row};
      if (!moves.empty()) each.local.translation = moves[i];
      if (!scales.empty()) each.local.scale = scales[i];
      if (!turns.empty() && normalizeRotation(turns[i])) each.local.rotation = toRotation(turns[i]);
      rows.push_back(addNode(std::move(each)));
    }
    return rows;
  }

  // A mesh is read once with its joints, once without, and once for each way in which nodes morph it, or begin to.
  const std::vector<Part>& partsOf(std::uint32_t mesh, bool skinned, const JsonValue& node,
                                   std::uint32_t row) {
    const JsonValue& value = document_.rows("meshes")[mesh];
    // How far morph targets have moved a mesh when nothing animates it: as the node says, else as the mesh does.
    const JsonValue& weighted = node.find("weights") ? node : value;
    std::vector<float> weights(itemsOf(weighted, "weights").size()), &moving = model_.nodes[row].weights;
    document_.numbers(weighted, "weights", weights);
    const bool moves = !moving.empty();
    if (moves) weights.resize(moving.size());
    if (moves) moving = std::exchange(weights, std::vector<float>(moving.size()));
    const auto [parts, isNew] = parts_.try_emplace({mesh, skinned, moves, weights});
    if (!isNew) return parts->second;
    const std::string name = textOf(value, "name", fmt::format("mesh {}", mesh));
    const std::vector<JsonValue>& primitives = itemsOf(value, "primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const std::string each = primitives.size() == 1 ? name : fmt::format("{}[{}]", name, i);
      const Part part = readPrimitive(primitives[i], each, skinned, weights, moves);
      if (part.mesh != kNoRow) parts->second.push_back(part);
    }
    return parts->second;
  }

  Part readPrimitive(const JsonValue& value, const std::string& name, bool skinned,
                     const std::vector<float>& weights, bool moves) {
    document_.unpackDraco(value);
    const JsonValue* positions = valueOf(value, {"attributes", "POSITION"});
    const int mode = static_cast<int>(document_.number(value, {"mode"}, 4, 0, 6));
    if (mode < 4 || !positions) {
      document_.leaveOut(say::meshLeftOut, value, name,
                         positions ? "points and lines are not drawn" : "it has no positions");
      return {};
    }
    const JsonValue &attributes = *value.find("attributes"), *material = value.find("material"),
                    *which = value.find("indices");
    Part part;
    part.material = material ? document_.index("materials", *material)
                             : static_cast<std::uint32_t>(model_.materials.size() - 1);
    count_ = document_.accessor(*positions, "VEC3", true).count;
    std::optional<GltfAccessor> indices;
    if (which) indices = document_.accessor(*which, "SCALAR", false);
    const std::uint64_t corners = std::uint64_t{indices ? indices->count : count_} * (mode == 4 ? 1 : 3);
    const std::uint64_t vertices = std::max<std::uint64_t>(count_, attributes.find("NORMAL") ? 0 : corners);
    GltfDocument::refuseUnless(builder_.hasRoom(vertices, corners, value.place, diagnostics_));
    RawMesh mesh{.name = name, .join = made_};
    if (skinned) part.joints = readWeights(attributes, mesh);  // first, for it takes most memory
    mesh.vertices.resize(count_, {.tangent = glm::vec4(0)});
    take(attribute<glm::vec3>(attributes, "POSITION", kFarthest), mesh, &Vertex::position);
    // Normals and tangents that are no numbers are made anew.
    mesh.normals = take(attribute<glm::vec3>(attributes, "NORMAL", {}), mesh, &Vertex::normal);
    take(attribute<glm::vec4>(attributes, "TANGENT", {}), mesh, &Vertex::tangent);
    const GltfUvs& uvs = uvs_[part.material];
    Material& surface = model_.materials[part.material];
    const bool mapped = std::ranges::any_of(surface.maps(), [](auto* map) { return *map != kNoRow; });
    for (std::size_t i = 0; i < uvs.size(); ++i) {
      std::vector<glm::vec2> found = readUvs(attributes, uvs[i]);
      if (found.empty() && mapped && mapless_.insert(part.material).second)
        document_.leaveOut(say::mapsWithoutUv, value, surface.name, name,
                           made_ ? "uv" : fmt::format("TEXCOORD_{}", uvs[i].set));
      if (i == 0) take(found, mesh, &Vertex::uv);
      if (i == 1) mesh.secondUvs = std::move(found);
    }
    mesh.tangentsAtSecondUv = (surface.samplers[1] & atSecondUv) != 0;
    readColors(attributes, mesh);
    morph(value, weights, moves, vertices, mesh);
    readIndices(value, indices, mode, mesh);
    part.mesh = builder_.add(std::move(mesh));
    return part;
  }

  GltfAccessor vertexAccessor(const JsonValue& which, const std::string& name, std::string_view kind,
                              bool floats) {
    const GltfAccessor accessor = document_.accessor(which, kind, floats);
    if (accessor.count != count_) document_.fail(say::notOnePerVertex, which, name, count_, accessor.count);
    return accessor;
  }

  // One vector for each vertex of the primitive, within ±`most` if that is given; none where the attribute is absent.
  template <class Vector>
  std::vector<Vector> attribute(const JsonValue& attributes, const std::string& name,
                                std::optional<float> most) {
    constexpr std::size_t N = Vector::length();
    const JsonValue* which = attributes.find(name);
    if (!which) return {};
    const std::vector<float> values =
        document_.read<float>(vertexAccessor(*which, name, fmt::format("VEC{}", N), true));
    std::vector<Vector> out(count_);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (most && !(std::abs(values[i]) <= *most))
        document_.fail(say::vertexUnusable, *which, name, i / N, *most, values[i]);
      out[i / N][static_cast<int>(i % N)] = values[i];
    }
    return out;
  }

  template <class Vector>
  static bool take(const std::vector<Vector>& values, RawMesh& mesh, Vector Vertex::*member) {
    for (std::size_t v = 0; v < values.size(); ++v) mesh.vertices[v].*member = values[v];
    return !values.empty();
  }

  std::vector<glm::vec2> readUvs(const JsonValue& attributes, const GltfUv& uv) {
    std::vector<glm::vec2> uvs = attribute<glm::vec2>(attributes, fmt::format("TEXCOORD_{}", uv.set), 1e6f);
    // Counter-clockwise as uv are drawn, with v downwards: github.com/KhronosGroup/glTF/issues/1563.
    const float c = std::cos(uv.rotation), s = std::sin(uv.rotation);
    for (glm::vec2& each : uvs) {
      if (uv == GltfUv{.set = uv.set}) break;
      const float u = each[0] * uv.scale[0], v = each[1] * uv.scale[1];
      each = {c * u + s * v + uv.offset[0], -s * u + c * v + uv.offset[1]};
    }
    return uvs;
  }

  // glTF 2.0, 3.7.2.1: linear, clamped to 0..1; floats, or unsigned bytes and shorts that are normalized.
  void readColors(const JsonValue& attributes, RawMesh& mesh) {
    const JsonValue* where = attributes.find("COLOR_0");
    if (!where) return;
    const JsonValue& row = document_.rows("accessors")[document_.index("accessors", *where)];
    const bool opaque = textOf(row, "type") == "VEC3";
    const GltfAccessor accessor = vertexAccessor(*where, "COLOR_0", opaque ? "VEC3" : "VEC4", true);
    if (accessor.type != 5126 && !(accessor.normalized && (accessor.type == 5121 || accessor.type == 5123)))
      return document_.leaveOut(say::meshColorsLeftOut, *where, mesh.name, accessor.type,
                                accessor.normalized ? ", normalized" : "");
    if (opaque)
      for (const glm::vec3& color : attribute<glm::vec3>(attributes, "COLOR_0", 1e9f))
        mesh.colors.emplace_back(color, 1);
    else
      mesh.colors = attribute<glm::vec4>(attributes, "COLOR_0", 1e9f);
    for (glm::vec4& color : mesh.colors) color = glm::clamp(color, 0.0f, 1.0f);
  }

  // The mesh as its targets move it, each by its weight; where weights are to move, it keeps its targets. glTF 2.0, 3.7.2.2.
  void morph(const JsonValue& primitive, const std::vector<float>& weights, bool moves,
             std::uint64_t vertices, RawMesh& mesh) {
    const std::vector<JsonValue>& targets = itemsOf(primitive, "targets");
    for (std::size_t t = 0; t < std::min(weights.size(), targets.size()); ++t) {
      if (!moves && weights[t] == 0) continue;
      // The same accessor may serve any number of targets: each has vertices of its own.
      GltfDocument::refuseUnless(builder_.hasRoom(vertices, 0, targets[t].place, diagnostics_));
      std::vector<MorphTarget>& target = mesh.morphs.emplace_back(count_);
      const auto read = [&](const char* name, glm::vec3 MorphTarget::*member) {
        const std::vector<glm::vec3> values = attribute<glm::vec3>(targets[t], name, kFarthest);
        for (std::size_t v = 0; v < values.size(); ++v) target[v].*member = values[v];
      };
      read("POSITION", &MorphTarget::position);
      if (mesh.normals) read("NORMAL", &MorphTarget::normal);
      if (mesh.normals) read("TANGENT", &MorphTarget::tangent);  // of flat ones they are made anew
      if (moves) continue;
      for (std::size_t v = 0; v < count_; ++v) {
        mesh.vertices[v].position += weights[t] * target[v].position;
        mesh.vertices[v].normal += weights[t] * target[v].normal;
        mesh.vertices[v].tangent += glm::vec4(weights[t] * target[v].tangent, 0);
      }
      mesh.morphs.pop_back();
    }
    for (const Vertex& v : mesh.vertices)
      if (!glm::all(glm::lessThanEqual(glm::abs(v.position), glm::vec3(kFarthest))))
        document_.fail(say::morphedTooFar, *primitive.find("targets"), mesh.name, kFarthest);
  }

  // How many joints its vertices name, at least.
  std::uint64_t readWeights(const JsonValue& attributes, RawMesh& mesh) {
    std::uint64_t named = 0;
    std::array<std::vector<std::uint32_t>, 2> joints;
    std::array<std::vector<glm::vec4>, 2> weights;
    for (std::size_t set = 0; set < 2; ++set) {
      const std::string name = fmt::format("JOINTS_{}", set);
      const JsonValue* which = attributes.find(name);
      weights[set] = attribute<glm::vec4>(attributes, fmt::format("WEIGHTS_{}", set), 1e6f);
      if (!which || weights[set].empty()) break;
      joints[set] = document_.read<std::uint32_t>(vertexAccessor(*which, name, "VEC4", false));
      // A weight of 0 asks for no joint; a vertex without any weight follows its first.
      for (std::size_t i = 0; i < joints[set].size(); ++i)
        if (weights[set][i / 4][static_cast<int>(i % 4)] > 0 || (set == 0 && i % 4 == 0))
          named = std::max(named, std::uint64_t{joints[set][i]} + 1);
    }
    mesh.skin.reserve(joints[0].size() / 4);
    for (std::size_t v = 0; v < joints[0].size() / 4; ++v) {
      std::array<std::uint32_t, 8> from{};
      std::array<float, 8> by{};
      for (std::size_t i = 0; i < 8 && !joints[i / 4].empty(); ++i) {
        from[i] = joints[i / 4][4 * v + i % 4];
        by[i] = std::max(0.0f, weights[i / 4][v][static_cast<int>(i % 4)]);
      }
      mesh.skin.push_back(heaviest(from, by));
    }
    return named;
  }

  void readIndices(const JsonValue& value, const std::optional<GltfAccessor>& accessor, int mode,
                   RawMesh& mesh) {
    std::vector<std::uint32_t> indices;
    if (accessor) indices = document_.read<std::uint32_t>(*accessor);
    for (std::uint32_t i = 0; !accessor && i < count_; ++i) indices.push_back(i);
    const auto bad = std::ranges::find_if(indices, [&](std::uint32_t i) { return i >= count_; });
    if (bad != indices.end())
      document_.fail(say::indexNamesNoVertex, *value.find("indices"), bad - indices.begin(), mesh.name,
                     count_, *bad);
    if (mode == 4) {
      indices.resize(indices.size() / 3 * 3);
      mesh.indices = std::move(indices);
      return;
    }
    // A strip turns every second triangle round; a fan goes on from its first corner.
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
      const std::size_t odd = i % 2;
      const std::array<std::size_t, 3> corners =
          mode == 5 ? std::array{i, i + 1 + odd, i + 2 - odd} : std::array{i + 1, i + 2, std::size_t{0}};
      for (const std::size_t corner : corners) mesh.indices.push_back(indices[corner]);
    }
  }

  // --- lights (KHR_lights_punctual) and animations

  // One light for each node that is shown and names one. A scene has one sun: of several the brightest stays.
  void readLights() {
    const JsonValue* extension = valueOf(document_.root(), {"extensions", "KHR_lights_punctual"});
    const std::vector<JsonValue>& table = itemsOf(extension ? *extension : document_.root(), "lights");
    std::map<std::uint32_t, std::optional<ModelLight>> lights;  // by row of the table
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const JsonValue* name = valueOf(rows_[i], {"extensions", "KHR_lights_punctual", "light"});
      if (!shown_[i] || !name) continue;
      const std::uint32_t row = document_.index("lights", table.size(), *name);
      if (!lights.contains(row)) lights[row] = readLight(table[row], row);
      if (std::optional<ModelLight> light = lights[row]) {
        light->node = rowOf_[i];
        addLight(std::move(*light), *name);
      }
    }
  }

  std::optional<ModelLight> readLight(const JsonValue& value, std::uint32_t number) {
    const std::string kind = textOf(value, "type");
    ModelLight light{.name = textOf(value, "name", fmt::format("light {}", number))};
    const std::size_t row = rowOf(kind, {"directional", "point", "spot"});
    if (row == 3) {
      document_.leaveOut(say::lightLeftOut, value, light.name, kind);
      return {};
    }
    light.kind = static_cast<ModelLightKind>(row);
    light.intensity = document_.number(value, {"intensity"}, 1, 0, 1e12);
    if (document_.numbers(value, "color", {&light.color.x, 3}) &&
        glm::any(glm::lessThan(light.color, glm::vec3(0))))
      document_.fail(say::negativeLight, *value.find("color"), light.color[0], light.color[1],
                     light.color[2]);
    if (light.kind == ModelLightKind::sun) return light;
    light.range = document_.number(value, {"range"}, 0, 1e-6, 1e9);
    if (light.kind != ModelLightKind::spot) return light;
    constexpr double kQuarter = 1.5708;  // turn, as files round it
    light.inner = document_.number(value, {"spot", "innerConeAngle"}, 0, 0, kQuarter);
    light.outer = document_.number(value, {"spot", "outerConeAngle"}, std::numbers::pi / 4, 0, kQuarter);
    if (light.inner > light.outer)
      document_.fail(say::innerConeWider, *value.find("spot"), light.outer, light.inner);
    return light;
  }

  void addLight(ModelLight light, const JsonValue& where) {
    const auto brightnessOf = [](const ModelLight& each) {
      return each.intensity * std::max({each.color.x, each.color.y, each.color.z});
    };
    const auto other = std::ranges::find(model_.lights, ModelLightKind::sun, &ModelLight::kind);
    if (light.kind != ModelLightKind::sun || other == model_.lights.end()) {
      model_.lights.push_back(std::move(light));
      return;
    }
    if (brightnessOf(light) > brightnessOf(*other)) std::swap(light, *other);
    document_.leaveOut(say::theLightLeftOut, where, light.name, other->name);
  }

  void readAnimation(const JsonValue& row) {
    ModelAnimation animation{.name =
                                 textOf(row, "name", fmt::format("animation {}", model_.animations.size()))};
    const std::vector<JsonValue>& samplers = itemsOf(row, "samplers");
    for (const JsonValue& channel : itemsOf(row, "channels")) {
      const JsonValue *path = valueOf(channel, {"target", "path"}),
                      *node = valueOf(channel, {"target", "node"});
      if (!path || !node || samplers.empty()) continue;
      const std::size_t which = rowOf(path->text, {"translation", "rotation", "scale", "weights"});
      const std::uint32_t moved = document_.index("nodes", *node);
      const std::size_t targets = which == 3 ? targetsOf(rows_[moved]) : 1;
      if (which == 4 || targets == 0) continue;
      ModelTrack track{.node = rowOf_[moved], .path = static_cast<TrackPath>(which)};
      if (track.path != TrackPath::weights) takeApart(model_.nodes[track.node]);
      model_.nodes[track.node].animated = true;
      const JsonValue& sampler = document_.need(channel, "sampler");
      readTracks(samplers[document_.index("samplers", samplers.size(), sampler)], targets, track, animation);
      animation.duration = std::max(animation.duration, track.times.back());
    }
    model_.animations.push_back(std::make_shared<const ModelAnimation>(std::move(animation)));
  }

  // What the matrix of an animated node does becomes rotation and scale, which tracks replace; without its shear.
  static void takeApart(ModelNode& node) {
    glm::mat3& m = node.inner;
    if (m == glm::mat3(1)) return;
    node.local.scale = {glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
    if (glm::determinant(m) < 0) node.local.scale.x *= -1;
    for (int c = 0; c < 3; ++c) m[c] /= node.local.scale[c];
    const glm::quat rotation = glm::quat_cast(std::exchange(m, glm::mat3(1)));
    if (glm::dot(rotation, rotation) > 0) node.local.rotation = glm::normalize(rotation);
  }

  // How many morph targets the mesh of a node has.
  std::size_t targetsOf(const JsonValue& node) const {
    const JsonValue* mesh = node.find("mesh");
    const std::vector<JsonValue>& primitives =
        itemsOf(mesh ? document_.rows("meshes")[document_.index("meshes", *mesh)] : node, "primitives");
    return primitives.empty() ? 0 : itemsOf(primitives[0], "targets").size();
  }

  // Adds one track, or one for each morph target where the sampler moves weights.
  void readTracks(const JsonValue& sampler, std::size_t targets, ModelTrack& track, ModelAnimation& into) {
    const std::string how = textOf(sampler, "interpolation");
    const bool cubic = how == "CUBICSPLINE", rotation = track.path == TrackPath::rotation,
               weights = track.path == TrackPath::weights;
    track.interpolation = cubic           ? TrackInterpolation::cubic
                          : how == "STEP" ? TrackInterpolation::step
                                          : TrackInterpolation::linear;
    const GltfAccessor input = document_.accessor(document_.need(sampler, "input"), "SCALAR", true);
    const char* const kind = weights ? "SCALAR" : rotation ? "VEC4" : "VEC3";
    const GltfAccessor output = document_.accessor(document_.need(sampler, "output"), kind, true);
    const std::uint64_t values = std::uint64_t{input.count} * (cubic ? 3 : 1);
    if (output.count != values * targets)
      document_.fail(say::notOnePerTime, sampler, values * targets, output.count);
    // The same accessor may serve any number of tracks.
    const std::uint64_t bytes = (sizeof(ModelTrack) + std::uint64_t{input.count} * 4) * targets;
    GltfDocument::refuseUnless(files_.count(bytes + std::uint64_t{output.count} * 16, sampler.place));
    track.times = document_.read<float>(input);
    for (float before = 0; const float time : track.times) {
      if (!(time >= before) || !std::isfinite(time))
        document_.fail(say::timesDoNotAscend, sampler, time, before);
      before = time;
    }
    if (weights) model_.nodes[track.node].weights.resize(targets);
    const std::vector<float> numbers = document_.read<float>(output);
    for (; track.target < targets; ++track.target) {
      track.values.clear();
      for (std::size_t i = 0; i < values; ++i) {
        glm::vec4& value = track.values.emplace_back(0.0f);
        std::copy_n(numbers.data() + (i * targets + track.target) * output.components, output.components,
                    &value.x);
        const bool isRotation = rotation && (!cubic || i % 3 == 1);
        if (value - value != glm::vec4(0) ||  // infinite, or no number
            (isRotation && !normalizeRotation(value)))
          document_.fail(say::animatedValueUnusable, sampler, i, rotation ? "rotation" : "number");
      }
      into.tracks.push_back(track);
    }
  }

  GltfDocument& document_;
  ModelFiles& files_;
  Diagnostics& diagnostics_ = files_.diagnostics();
  Model& model_;
  const bool made_;  // of a file of another format
  MeshBuilder builder_{model_};
  std::vector<GltfUvs> uvs_;  // of the materials
  const std::vector<JsonValue>& rows_ = document_.rows("nodes");
  std::vector<std::uint32_t> rowOf_;  // by the file's index of a node: its row in the model
  std::vector<bool> shown_;           // by the file's index: in the scene that is shown
  std::map<std::tuple<std::uint32_t, bool, bool, std::vector<float>>, std::vector<Part>> parts_;
  std::set<std::uint32_t> mapless_;  // materials that meshes without their uv have
  std::uint32_t count_ = 0;          // of vertices of the primitive that is read
};

}  // namespace

bool readGltf(std::string bytes, ModelFiles& files, Model& model, bool made) try {
  GltfDocument document(std::move(bytes), files);
  GltfReader(document, files, model, made).read();
  return true;
} catch (const Refused&) {
  return false;
}

}  // namespace weft::assets
