#include "engine/scene/models/add_model.h"

#include <cassert>
#include <cmath>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>

#include "engine/scene/frame/mesh_frame.h"

namespace weft::scene {

namespace {

using assets::kNoRow;

glm::vec3 vec3Of(const assets::Float3& v) {
  return {v[0], v[1], v[2]};
}

// The scene's and the model's vertices are the same bytes: both rooms may not name one type, because assets is without glm.
template <class To, class From>
void append(std::vector<To>& out, const std::vector<From>& in) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> &&
                std::is_trivially_copyable_v<From>);
  if (in.empty()) return;
  const std::size_t before = out.size();
  out.resize(before + in.size());
  std::memcpy(static_cast<void*>(out.data() + before), in.data(), in.size() * sizeof(From));
}

TextureId addTexture(Scene& scene, const assets::ModelTexture& texture) {
  const std::span<const Texture> known = scene.textures.rows();
  for (std::size_t row = 0; row < known.size(); ++row)
    if (known[row].content == texture.content && known[row].srgb == texture.srgb &&
        known[row].image->width == texture.image->width && known[row].image->texels == texture.image->texels)
      return scene.textures.idOf(row);
  return scene.textures.add({texture.name, texture.image, texture.srgb, texture.content});
}

Material toMaterial(const assets::ModelMaterial& from, const std::vector<TextureId>& textures) {
  const auto map = [&](std::uint32_t row) { return row == kNoRow ? TextureId{} : textures[row]; };
  Material to;
  to.name = from.name;
  to.albedo = vec3Of(from.baseColor);
  to.metallic = from.metallic;
  to.roughness = from.roughness;
  to.emissive = vec3Of(from.emissive);
  to.alpha = from.alpha;
  to.alphaCutoff = from.alphaCutoff;
  to.blend = from.blend;
  to.normalScale = from.normalScale;
  to.occlusionStrength = from.occlusionStrength;
  to.blinnPhong = from.blinnPhong;
  to.specular = vec3Of(from.specular);
  to.shininess = from.shininess;
  to.doubleSided = from.doubleSided;
  to.albedoMap = map(from.baseColorMap);
  to.normalMap = map(from.normalMap);
  to.metallicRoughnessMap = map(from.metallicRoughnessMap);
  to.occlusionMap = map(from.occlusionMap);
  to.emissiveMap = map(from.emissiveMap);
  return to;
}

Mesh toMesh(const assets::Model& model, const assets::ModelMesh& from, std::uint32_t firstVertex,
            std::uint32_t firstIndex) {
  Mesh to;
  to.name = from.name;
  to.firstVertex = firstVertex + from.firstVertex;
  to.vertexCount = from.vertexCount;
  to.firstIndex = firstIndex + from.firstIndex;
  to.indexCount = from.indexCount;
  to.skinned = from.skinned;
  for (std::uint32_t v = from.firstVertex; v < from.firstVertex + from.vertexCount; ++v) {
    const glm::vec3 position = vec3Of(model.vertices[v].position);
    to.bounds.add(position);
    if (!from.skinned) continue;
    const assets::ModelSkinVertex& skin = model.skinVertices[v];
    for (std::size_t i = 0; i < 4; ++i) {
      if (!(skin.weights[i] > 0)) continue;
      if (to.jointBounds.size() <= skin.joints[i]) to.jointBounds.resize(skin.joints[i] + std::size_t{1});
      to.jointBounds[skin.joints[i]].add(position);
    }
  }
  return to;
}

Node toNode(const assets::ModelNode& from) {
  Node to;
  to.name = from.name;
  to.local.translation = vec3Of(from.translation);
  to.local.rotation = glm::quat(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]);
  to.local.scale = vec3Of(from.scale);
  return to;
}

glm::vec3 toUnits(const Scene& scene, const assets::ModelLight& light) {
  return vec3Of(light.color) * (light.intensity / scene.nits);
}

Lamp toLamp(const Scene& scene, const assets::ModelLight& from, NodeId node, bool shadow) {
  Lamp to;
  to.name = from.name;
  to.intensity = toUnits(scene, from);
  to.range = from.range > 0 ? from.range : rangeOf(to.intensity);
  if (from.kind == assets::ModelLightKind::spot) {
    to.direction = {0, 0, -1};
    to.cosInner = std::cos(from.inner);
    to.cosOuter = std::cos(from.outer);
  }
  to.shadow = shadow;
  to.node = node;
  return to;
}

}  // namespace

ModelRows addModelTables(Scene& scene, MeshData& data, const assets::Model& model) {
  ModelRows rows;
  for (const assets::ModelTexture& texture : model.textures)
    rows.textures.push_back(addTexture(scene, texture));
  for (const assets::ModelMaterial& material : model.materials)
    rows.materials.push_back(scene.materials.add(toMaterial(material, rows.textures)));
  const auto firstVertex = static_cast<std::uint32_t>(data.vertices.size());
  const auto firstIndex = static_cast<std::uint32_t>(data.indices.size());
  append(data.vertices, model.vertices);
  if (!model.skinVertices.empty() || !data.skin.empty()) {
    data.skin.resize(firstVertex);
    append(data.skin, model.skinVertices);
    data.skin.resize(data.vertices.size());
  }
  if (!model.colors.empty() || !data.colors.empty()) {
    data.colors.resize(firstVertex, glm::vec4(1));
    append(data.colors, model.colors);
    data.colors.resize(data.vertices.size(), glm::vec4(1));
  }
  data.indices.insert(data.indices.end(), model.indices.begin(), model.indices.end());
  for (const assets::ModelMesh& mesh : model.meshes)
    rows.meshes.push_back(scene.meshes.add(toMesh(model, mesh, firstVertex, firstIndex)));
  return rows;
}

void addModelCopy(Scene& scene, const ModelRows& rows, const assets::Model& model, const ModelCopy& copy) {
  const NodeId root = scene.nodes.add(copy.root);
  std::vector<bool> animated(model.nodes.size());
  if (copy.animation)
    for (const assets::ModelTrack& track : model.animations[*copy.animation]->tracks)
      animated[track.node] = true;
  std::vector<NodeId> nodes;
  nodes.reserve(model.nodes.size());
  for (const assets::ModelNode& from : model.nodes) {
    Node node = toNode(from);
    assert(from.parent == kNoRow || from.parent < nodes.size());
    node.parent = from.parent == kNoRow ? root : nodes[from.parent];
    // A node that does nothing is its parent: a hundred thousand copies of an OBJ have a node each, not three.
    const bool idle = node.local == Transform{} && !animated[nodes.size()];
    nodes.push_back(idle ? node.parent : scene.nodes.add(std::move(node)));
  }
  std::vector<SkinId> skins;
  for (const assets::ModelSkin& from : model.skins) {
    Skin skin;
    for (const std::uint32_t joint : from.joints) skin.joints.push_back(nodes[joint]);
    for (const assets::Matrix4& matrix : from.inverseBind)
      skin.inverseBind.push_back(glm::make_mat4(matrix.data()));
    skins.push_back(scene.skins.add(std::move(skin)));
  }
  for (const assets::ModelInstance& from : model.instances) {
    MeshInstance instance;
    instance.node = nodes[from.node];
    instance.mesh = rows.meshes[from.mesh];
    instance.material = copy.material.value_or(rows.materials[from.material]);
    if (from.skin != kNoRow) instance.skin = skins[from.skin];
    if (copy.lists)
      instance.lists = *copy.lists;
    else if (scene.materials.find(instance.material)->blend)
      instance.lists = maskOf(DrawList::transparent);
    scene.meshInstances.add(instance);
  }
  for (const assets::ModelLight& from : model.lights) {
    if (!copy.lights) break;
    const NodeId node = nodes[from.node];
    if (from.kind != assets::ModelLightKind::sun)
      scene.lamps.add(toLamp(scene, from, node, copy.lampShadows));
    else if (!scene.sun)
      scene.sun = Sun{.direction = {0, 0, 1}, .irradiance = toUnits(scene, from), .node = node};
  }
  if (!copy.animation) return;
  Animation animation{model.animations[*copy.animation], {}, copy.speed};
  for (const assets::ModelTrack& track : animation.tracks->tracks)
    animation.nodes.push_back(nodes[track.node]);
  scene.animations.add(std::move(animation));
}

Box boundsOf(const assets::Model& model) {
  Scene scene;
  MeshData data;
  addModelCopy(scene, addModelTables(scene, data, model), model, {});
  MeshFrame frame;
  frame.update(scene, 1, 0, 0);
  return frame.sceneBounds();
}

}  // namespace weft::scene
