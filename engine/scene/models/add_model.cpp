#include "engine/scene/models/add_model.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace weft::scene {

namespace {

using assets::kNoRow;

std::uint32_t addTexture(Scene& scene, const Texture& texture) {
  const std::span<const Texture> known = scene.textures.rows();
  for (std::size_t row = 0; row < known.size(); ++row)
    if (known[row].content == texture.content) return static_cast<std::uint32_t>(row);
  scene.textures.add(texture);
  return static_cast<std::uint32_t>(known.size());
}

Lamp toLamp(const Scene& scene, const assets::ModelLight& from, NodeId node, bool shadow) {
  Lamp to;
  to.name = from.name;
  to.intensity = scene.toUnits(from.intensity, from.color);
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

ModelRows addModelTables(Scene& scene, MeshData& data, assets::Model& model) {
  ModelRows rows;
  std::vector<std::uint32_t> textures;
  for (const Texture& texture : model.textures) textures.push_back(addTexture(scene, texture));
  for (Material material : model.materials) {
    for (std::uint32_t* map : material.maps())
      if (*map != kNoRow) *map = textures[*map];
    rows.materials.push_back(scene.materials.add(std::move(material)));
  }
  for (Mesh& mesh : std::exchange(model.meshes, {})) {
    mesh.firstVertex += static_cast<std::uint32_t>(data.vertices.size());
    mesh.firstIndex += static_cast<std::uint32_t>(data.indices.size());
    mesh.firstTarget += static_cast<std::uint32_t>(data.targets.size());
    rows.meshes.push_back(scene.meshes.add(std::move(mesh)));
  }
  assets::moveInto(data, std::move(model));
  return rows;
}

std::vector<LabelId> addLabels(Scene& scene, const assets::Model& model, const std::string& name,
                               const std::vector<std::string>& tags) {
  std::vector<LabelId> ofNodes(model.nodes.size()), labels;
  for (const assets::ModelInstance& instance : model.instances) {
    LabelId& label = ofNodes[instance.node];
    if (!label.valid()) {
      Label with{.names = {name}, .tags = tags};
      for (std::uint32_t node = instance.node; node != kNoRow; node = model.nodes[node].parent)
        with.names.push_back(model.nodes[node].name);
      label = scene.labels.add(std::move(with));
    }
    labels.push_back(label);
  }
  return labels;
}

std::vector<NodeId> addModelCopy(Scene& scene, const ModelRows& rows, const assets::Model& model,
                                 const ModelCopy& copy) {
  const NodeId root = scene.nodes.add(copy.root);
  std::vector<NodeId> nodes;
  nodes.reserve(model.nodes.size());
  for (const assets::ModelNode& from : model.nodes) {
    Node node{.name = from.name, .local = from.local, .inner = from.inner};
    assert(from.parent == kNoRow || from.parent < nodes.size());
    node.parent = from.parent == kNoRow ? root : nodes[from.parent];
    // A node that does nothing is its parent: a hundred thousand copies of an OBJ have a node each, not three.
    const bool idle = node.local == Transform{} && node.inner == glm::mat3(1) && !from.animated;
    node.firstWeight = from.weights.empty() ? scene.nodes.rows()[node.parent.index].firstWeight
                                            : static_cast<std::uint32_t>(scene.weights.size());
    scene.weights.insert(scene.weights.end(), from.weights.begin(), from.weights.end());
    nodes.push_back(idle ? node.parent : scene.nodes.add(std::move(node)));
  }
  std::vector<SkinId> skins;
  for (const assets::ModelSkin& from : model.skins) {
    Skin skin{.joints = {}, .inverseBind = from.inverseBind};
    for (const std::uint32_t joint : from.joints) skin.joints.push_back(nodes[joint]);
    skins.push_back(scene.skins.add(std::move(skin)));
  }
  for (std::size_t i = 0; i < model.instances.size(); ++i) {
    const assets::ModelInstance& from = model.instances[i];
    MeshInstance instance;
    if (!copy.labels.empty()) instance.label = copy.labels[i];
    instance.node = nodes[from.node];
    instance.mesh = rows.meshes[from.mesh];
    instance.material = copy.material.value_or(rows.materials[from.material]);
    if (from.skin != kNoRow) instance.skin = skins[from.skin];
    if (copy.lists)
      instance.lists = *copy.lists;
    else if (const Material& material = *scene.materials.find(instance.material);
             material.layers.transmission > 0)
      instance.lists = maskOf(DrawList::transmissive);
    else if (material.blend)
      instance.lists = maskOf(DrawList::transparent);
    scene.meshInstances.add(instance);
  }
  for (const assets::ModelLight& from : model.lights) {
    if (!copy.lights) break;
    const NodeId node = nodes[from.node];
    if (from.kind != assets::ModelLightKind::sun)
      scene.lamps.add(toLamp(scene, from, node, copy.lampShadows));
    else if (!scene.sun)
      scene.sun =
          Sun{.direction = {0, 0, 1}, .irradiance = scene.toUnits(from.intensity, from.color), .node = node};
  }
  if (!copy.animation) return nodes;
  Animation animation{model.animations[*copy.animation], {}, copy.speed};
  for (const assets::ModelTrack& track : animation.tracks->tracks)
    animation.nodes.push_back(nodes[track.node]);
  scene.animations.add(std::move(animation));
  return nodes;
}

}  // namespace weft::scene
