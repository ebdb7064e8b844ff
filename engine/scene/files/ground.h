// The key `ground` of a scene file. What is wrong is W160, or what JsonFields reports.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/base/json/fields.h"
#include "engine/scene/scene.h"

namespace weft::scene {

void readGround(base::JsonFields& fields, Scene& scene, base::Diagnostics& diagnostics);

}  // namespace weft::scene
