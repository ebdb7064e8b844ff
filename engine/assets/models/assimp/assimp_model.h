// Wavefront OBJ and FBX to a Model, through Assimp. What Assimp 5.2.5 does not survive is refused before it sees a file:
// engine/assets/models/assimp/model_check.h. Internal to the folder.
#pragma once

#include <string>

#include "engine/assets/model.h"
#include "engine/assets/models/parts/model_files.h"

namespace weft::assets {

// `obj`: else FBX. False after errors, or when `observer` gave up.
bool readWithAssimp(std::string bytes, bool obj, ModelFiles& files, const LoadObserver& observer,
                    text::Diagnostics& diagnostics, Model& model);

}  // namespace weft::assets
