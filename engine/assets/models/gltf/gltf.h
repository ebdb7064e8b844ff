// glTF 2.0, .gltf and .glb, to a Model. Everything that a file says is held against the file before it is used. Left out, with W168:
// points and lines, the motion of morph targets, further uv sets, a second sun; in silence: cameras. Internal to the folder.
#pragma once

#include "engine/assets/model.h"
#include "engine/assets/models/parts/model_files.h"

namespace weft::assets {

// False after errors, or when `observer` gave up.
bool readGltf(std::string bytes, ModelFiles& files, const LoadObserver& observer,
              text::Diagnostics& diagnostics, Model& model);

}  // namespace weft::assets
