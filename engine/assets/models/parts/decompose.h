// Matrices of nodes to translation, rotation and scale.
#pragma once

#include "engine/assets/model.h"

namespace weft::assets {

// False for a quaternion without length.
bool normalizeRotation(Float4& q);

// Takes a matrix without shear apart; a mirror becomes a negative x scale. False when a column is not finite.
bool decompose(const Matrix4& matrix, ModelNode& node);

}  // namespace weft::assets
