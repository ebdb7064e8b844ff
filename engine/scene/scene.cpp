#include "engine/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace weft::scene {

const std::vector<std::string>& drawListNames() {
  static const std::vector<std::string> names = {"spheres", "opaque", "shadow_casters", "transparent_spheres",
                                                 "transparent"};
  return names;
}

std::optional<DrawList> findDrawList(std::string_view name) {
  const std::vector<std::string>& names = drawListNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return {};
  return static_cast<DrawList>(found - names.begin());
}

glm::mat4 matrixOf(const Transform& transform) {
  const glm::mat3 rotation = glm::mat3_cast(transform.rotation);
  return {glm::vec4(rotation[0] * transform.scale.x, 0), glm::vec4(rotation[1] * transform.scale.y, 0),
          glm::vec4(rotation[2] * transform.scale.z, 0), glm::vec4(transform.translation, 1)};
}

float rangeOf(glm::vec3 intensity) {
  return std::sqrt(std::max({intensity.x, intensity.y, intensity.z}) / kMinIrradiance);
}

glm::vec3 turnDirection(const glm::mat4& node, glm::vec3 direction) {
  const glm::vec3 turned = glm::mat3(node) * direction;
  const float length = glm::length(turned);
  return length > 1e-30f ? turned / length : direction;
}

const Camera* findCamera(const Scene& scene, std::string_view name) {
  for (const Camera& camera : scene.cameras.rows())
    if (name.empty() || camera.name == name) return &camera;
  return nullptr;
}

std::size_t countInstances(const Scene& scene, DrawList list) {
  return static_cast<std::size_t>(std::ranges::count_if(
      scene.spheres.rows(), [&](const Sphere& s) { return (s.lists & maskOf(list)) != 0; }));
}

std::size_t countMeshInstances(const Scene& scene, DrawList list) {
  return static_cast<std::size_t>(std::ranges::count_if(
      scene.meshInstances.rows(), [&](const MeshInstance& m) { return (m.lists & maskOf(list)) != 0; }));
}

bool isMoving(const Scene& scene, DrawList list) {
  return std::ranges::any_of(scene.spheres.rows(), [&](const Sphere& s) {
    return (s.lists & maskOf(list)) != 0 && s.velocity != glm::vec3(0);
  });
}

bool isMoving(const Scene& scene) {
  return scene.animations.size() > 0 ||
         std::ranges::any_of(scene.spheres.rows(),
                             [](const Sphere& s) { return s.velocity != glm::vec3(0); }) ||
         std::ranges::any_of(scene.nodes.rows(), [](const Node& n) {
           return n.velocity != glm::vec3(0) || n.spin != glm::vec3(0);
         });
}

void fillInstances(const Scene& scene, DrawList list, double time, double previousTime,
                   std::vector<Instance>& out) {
  out.clear();
  out.reserve(countInstances(scene, list));
  const float now = static_cast<float>(time), before = static_cast<float>(previousTime);
  static const Material kNoMaterial{};
  for (const Sphere& sphere : scene.spheres.rows()) {
    if ((sphere.lists & maskOf(list)) == 0) continue;
    const Material* found = scene.materials.find(sphere.material);
    const Material& material = found ? *found : kNoMaterial;
    out.push_back({sphere.center + sphere.velocity * now, sphere.radius,
                   sphere.center + sphere.velocity * before, material.roughness, material.albedo,
                   material.metallic});
  }
}

}  // namespace weft::scene
