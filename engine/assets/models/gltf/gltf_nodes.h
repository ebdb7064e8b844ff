// Nodes, skins and animations of a glTF document. Internal to the folder.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/assets/models/gltf/gltf_document.h"

namespace weft::assets {

// The file's nodes in the order of Model::nodes: parents before children.
struct GltfNodes {
  std::vector<std::uint32_t> rowOf;  // the file's index to the row
  std::vector<bool> shown;           // by the file's index: in the scene that is shown
};

// False after errors: a node that is its own ancestor, that has two parents, an index that is none.
bool readGltfNodes(GltfDocument& document, Model& model, GltfNodes& nodes);
bool readGltfSkins(GltfDocument& document, const GltfNodes& nodes, Model& model);
bool readGltfAnimations(GltfDocument& document, ModelFiles& files, const GltfNodes& nodes, Model& model);

}  // namespace weft::assets
