// Wavefront OBJ and its material libraries to a Model. Paul Bourke, "Object Files (.obj)" and "MTL material format"; maps of physically
// based materials as Blender and tinyobjloader name them. Internal to the folder.
#pragma once

#include <string_view>

#include "engine/assets/model.h"
#include "engine/assets/models/parts/model_files.h"

namespace weft::assets {

// Left out, with one W168 of each kind: statements that are not drawn, faces that name what is not there, unknown materials. False after
// errors, or when the load was stopped.
bool readObj(std::string_view bytes, ModelFiles& files, Model& model);

}  // namespace weft::assets
