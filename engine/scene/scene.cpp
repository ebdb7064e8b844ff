#include "engine/scene/scene.h"

#include <cmath>

namespace weft::scene {

const std::vector<std::string>& drawListNames() {
  static const std::vector<std::string> names = {
      "spheres", "opaque", "shadow_casters", "transparent_spheres", "transparent", "transmissive"};
  return names;
}

std::optional<DrawList> findDrawList(std::string_view name) {
  const std::vector<std::string>& names = drawListNames();
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<DrawList>(found - names.begin()));
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

bool matches(std::string_view word, std::string_view text) {
  const bool before = word.starts_with('*'), after = word.size() > 1 && word.ends_with('*');
  const std::string_view part = word.substr(before, word.size() - before - after);
  return before && after ? text.find(part) != text.npos
         : before        ? text.ends_with(part)
         : after         ? text.starts_with(part)
                         : text == part;
}

Members::Members(const Selection& selection, const Scene& scene) : lists_(selection.lists) {
  const auto anyOf = [](const std::string& word, const std::vector<std::string>& texts) {
    return word.empty() ||
           std::ranges::any_of(texts, [&](const std::string& text) { return matches(word, text); });
  };
  if (!selection.name.empty() || !selection.tag.empty()) {
    for (const Label& label : scene.labels.rows())
      labels_.push_back(anyOf(selection.name, label.names) && anyOf(selection.tag, label.tags));
    labels_.push_back(0);
  }
  if (selection.material.empty()) return;
  for (const Material& material : scene.materials.rows())
    materials_.push_back(matches(selection.material, material.name));
  materials_.push_back(0);
}

bool isMoving(const Scene& scene, const Selection& list) {
  const Members members(list, scene);
  return std::ranges::any_of(scene.spheres.rows(),
                             [&](const Sphere& s) { return s.velocity != glm::vec3(0) && members.has(s); });
}

bool isMoving(const Scene& scene) {
  return scene.animations.size() > 0 || isMoving(scene, Selection()) ||
         std::ranges::any_of(scene.nodes.rows(), [](const Node& n) {
           return n.velocity != glm::vec3(0) || n.spin != glm::vec3(0);
         });
}

void fillInstances(const Scene& scene, const Selection& list, double time, double previousTime,
                   std::vector<Instance>& out) {
  const Members members(list, scene);
  out.clear();
  out.reserve(members.count(scene.spheres));
  const float now = static_cast<float>(time), before = static_cast<float>(previousTime);
  static const Material kNoMaterial{};
  for (const Sphere& sphere : scene.spheres.rows()) {
    if (!members.has(sphere)) continue;
    const Material* found = scene.materials.find(sphere.material);
    const Material& material = found ? *found : kNoMaterial;
    out.push_back({sphere.center + sphere.velocity * now, sphere.radius,
                   sphere.center + sphere.velocity * before, material.roughness, material.albedo,
                   material.metallic});
  }
}

}  // namespace weft::scene
