// Nodes, skins, animations and lights (KHR_lights_punctual) of a glTF document. Internal to the folder.
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

// One light for each node that is shown and names one. A scene has one sun: of several the brightest stays, the others are
// left out, with W168. False after errors: an index that is none, a number that no light can have.
bool readGltfLights(GltfDocument& document, const GltfNodes& nodes, base::Diagnostics& diagnostics,
                    Model& model);

}  // namespace weft::assets
