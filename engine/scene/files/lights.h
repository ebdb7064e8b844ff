// The lights of a scene file: the keys `nits`, `sun`, `lamps` and `lamp_grids`, with their units. What is wrong is W160, or
// what JsonFields reports. Does not: know what is lit.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/base/json/fields.h"
#include "engine/scene/scene.h"

namespace weft::scene {

constexpr std::size_t kMaxLamps = 65536;

void readLights(base::JsonFields& fields, Scene& scene, base::Diagnostics& diagnostics);

}  // namespace weft::scene
