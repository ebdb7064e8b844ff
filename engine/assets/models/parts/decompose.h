// Matrices of nodes to translation, rotation and scale.
#pragma once

#include "engine/assets/model.h"

namespace weft::assets {

// A quaternion x y z w. False for one without length.
bool normalizeRotation(glm::vec4& q);
inline glm::quat toRotation(const glm::vec4& q) {
  return {q.w, q.x, q.y, q.z};
}

bool isFinite(const glm::vec4& v);

// Takes a matrix without shear apart; a mirror becomes a negative x scale. False when a column is not finite.
bool decompose(const glm::mat4& matrix, Transform& transform);

}  // namespace weft::assets
