// What the readers of scene files share: ranges of numbers, vectors, messages with a place.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <utility>

#include "engine/base/json/fields.h"

namespace weft::scene {

inline constexpr base::NumberRange kUnit{.min = 0, .max = 1};
inline constexpr base::NumberRange kWorld{.min = -1e9, .max = 1e9};  // float keeps 64 units apart there
inline constexpr base::NumberRange kSize{.min = 0, .max = 1e9, .aboveMin = true};
inline constexpr base::NumberRange kAmount{.min = 0, .max = 1e9};
inline constexpr base::NumberRange kFov{.min = 1, .max = 170};
inline constexpr base::NumberRange kGridCount{.min = 1, .max = 65536, .whole = true};

inline glm::vec3 toVec3(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}
inline glm::dvec3 toDvec3(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

inline base::Diagnostic& failAt(base::Diagnostics& diagnostics, base::Code code, const base::JsonValue& value,
                                std::string message) {
  return diagnostics.error(code, value.place, std::move(message));
}

}  // namespace weft::scene
