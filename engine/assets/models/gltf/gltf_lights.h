// The lights of a glTF document: KHR_lights_punctual. Internal to the folder.
#pragma once

#include "engine/assets/models/gltf/gltf_nodes.h"

namespace weft::assets {

// One light for each node that is shown and names one. A scene has one sun: of several the brightest stays, the others are
// left out, with W168. False after errors: an index that is none, a number that no light can have.
bool readGltfLights(GltfDocument& document, const GltfNodes& nodes, base::Diagnostics& diagnostics,
                    Model& model);

}  // namespace weft::assets
