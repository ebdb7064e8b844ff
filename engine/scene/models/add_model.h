// Puts a model (engine/assets/model.h) into a scene: its textures, materials and meshes once, its nodes, skins and
// instances once per copy, and its lights with them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/assets/model.h"
#include "engine/scene/scene.h"

namespace weft::scene {

// What all copies share: rows of the scene, parallel to the model's tables.
struct ModelRows {
  std::vector<MaterialId> materials;
  std::vector<MeshId> meshes;
};

// `data` is what Scene::meshData becomes when all models are in; those of the model are moved to it. Textures whose
// content the scene has already are not added again.
ModelRows addModelTables(Scene& scene, MeshData& data, assets::Model& model);

// A label for each instance of the model, with `name`, the names of its node and of those above, and `tags`.
std::vector<LabelId> addLabels(Scene& scene, const assets::Model& model, const std::string& name,
                               const std::vector<std::string>& tags);

// A node without a transform, which no animation moves, gets no row: what names it names its parent.
struct ModelCopy {
  Node root;                               // above the model's own; its parent must be in the scene
  std::optional<std::uint8_t> lists;       // empty: as the material says (docs/scenes.md)
  std::vector<LabelId> labels;             // parallel to the model's instances; empty: none
  std::optional<MaterialId> material;      // of every instance
  std::optional<std::uint32_t> animation;  // row of the model's animations
  float speed = 1;
  bool lights = true;        // with the model's lights; its sun only where the scene has none
  bool lampShadows = false;  // its lamps cast shadows
};
// The node of each of the model's nodes.
std::vector<NodeId> addModelCopy(Scene& scene, const ModelRows& rows, const assets::Model& model,
                                 const ModelCopy& copy);

}  // namespace weft::scene
