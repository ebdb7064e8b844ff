#include "engine/scene/light.h"

#include <algorithm>
#include <cmath>

namespace weft::scene {

namespace {

// Where a scale is 0 nothing says where to: as it is in the node.
glm::vec3 turn(const glm::mat4& node, glm::vec3 direction) {
  const glm::vec3 turned = glm::mat3(node) * direction;
  const float length = glm::length(turned);
  return length > 1e-30f ? turned / length : direction;
}

}  // namespace

float rangeOf(glm::vec3 intensity) {
  return std::sqrt(std::max({intensity.x, intensity.y, intensity.z}) / kLeastIrradiance);
}

LightPose placeLight(const LightPose& light, const glm::mat4& node) {
  return {glm::vec3(node * glm::vec4(light.position, 1)), turn(node, light.direction)};
}

}  // namespace weft::scene
