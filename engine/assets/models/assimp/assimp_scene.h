// Assimp's scene to a Model: nodes, materials, meshes, skins and animations. Internal to the folder.
#pragma once

#include "engine/assets/model.h"
#include "engine/assets/models/parts/model_files.h"
#include "engine/assets/models/parts/texture_pool.h"

struct aiScene;

namespace weft::assets {

// False after errors, or when `observer` gave up. The scene's faces are triangles, lines and points. `colorlessLine`: of a file
// whose vertices have colours in part, where the first of the others stands.
bool readAssimpScene(const aiScene& scene, std::uint32_t colorlessLine, ModelFiles& files,
                     const LoadObserver& observer, const DecodeRunner& decode, base::Diagnostics& diagnostics,
                     Model& model);

}  // namespace weft::assets
