#include "engine/scene/files/model_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "engine/scene/files/models.h"
#include "engine/scene/frame/mesh_frame.h"

namespace weft::scene {

namespace {

constexpr double kFovDegrees = 35;
constexpr float kSunLux = 50000;  // a bright day

}  // namespace

CameraPose framePose(const Box& box, glm::dvec3 towards) {
  const glm::dvec3 center = (glm::dvec3(box.low) + glm::dvec3(box.high)) * 0.5;
  const double radius = std::max(glm::length(glm::dvec3(box.high) - glm::dvec3(box.low)) / 2, 1e-6);
  const double distance = radius / std::sin(kFovDegrees / 2 * std::numbers::pi / 180);
  CameraPose pose;
  pose.target = center;
  pose.position = center - towards * distance;
  pose.fovDegrees = kFovDegrees;
  pose.nearPlane = distance / 1000;
  return pose;
}

std::optional<Scene> loadModelScene(const std::string& path, base::Diagnostics& diagnostics,
                                    std::vector<std::string>* files, const assets::LoadObserver& observer) {
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  SceneModels models(scene, path, diagnostics, observer);
  const bool good = models.addWhole(path);
  if (files) *files = models.files();
  if (!good) return {};
  models.finish();
  MeshFrame frame;
  frame.update(scene, 1, 0, 0);
  const Box box = frame.sceneBounds();
  const std::pair<const char*, glm::dvec3> kViews[] = {{"front", {0, 0, -1}},
                                                       {"left", {1, 0, 0}},
                                                       {"right", {-1, 0, 0}},
                                                       {"back", {0, 0, 1}},
                                                       {"top", {0, -1, 0}}};
  for (const auto& [name, towards] : kViews) {
    Camera camera;
    camera.name = name;
    camera.pose = framePose(box, towards);
    scene.cameras.add(std::move(camera));
  }
  if (scene.sun || scene.lamps.size() > 0) return scene;
  Sun sun;
  sun.direction = glm::normalize(glm::vec3(0.4f, 0.8f, 0.6f));
  sun.irradiance = glm::vec3(kSunLux / scene.nits);
  scene.sun = sun;
  return scene;
}

}  // namespace weft::scene
