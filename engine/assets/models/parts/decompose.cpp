#include "engine/assets/models/parts/decompose.h"

#include <cmath>

namespace weft::assets {

namespace {

constexpr double kTiny = 1e-12;

}  // namespace

bool normalizeRotation(glm::vec4& q) {
  const double length = glm::length(glm::dvec4(q));
  if (!(length > kTiny)) return false;
  q = glm::vec4(glm::dvec4(q) / length);
  return true;
}

bool isFinite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

bool decompose(const glm::mat4& matrix, Transform& transform) {
  glm::dmat3 columns(matrix);
  glm::dvec3 scale(glm::length(columns[0]), glm::length(columns[1]), glm::length(columns[2]));
  if (!std::isfinite(scale.x + scale.y + scale.z)) return false;
  if (glm::determinant(columns) < 0) scale.x = -scale.x;
  const bool flat = glm::any(glm::lessThan(glm::abs(scale), glm::dvec3(kTiny)));
  transform = {.translation = glm::vec3(matrix[3]), .scale = glm::vec3(scale)};
  if (flat) return true;
  for (int c = 0; c < 3; ++c) columns[c] /= scale[c];
  const glm::dquat rotation = glm::quat_cast(columns);
  glm::vec4 q(rotation.x, rotation.y, rotation.z, rotation.w);
  if (!normalizeRotation(q)) return false;
  transform.rotation = toRotation(q);
  return true;
}

}  // namespace weft::assets
