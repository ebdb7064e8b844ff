// The key `lists` of a scene file: which draw lists something stands in. W162 for a name that is none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/base/json/fields.h"
#include "engine/scene/scene.h"

namespace weft::scene {

// A mask of maskOf(); empty when the key is absent. `what` names the object in messages.
std::optional<std::uint8_t> readLists(base::JsonFields& fields, const std::string& what,
                                      base::Diagnostics& diagnostics);

}  // namespace weft::scene
