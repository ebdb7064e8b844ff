// The scene as tables with stable ids. Rows are plain values; nothing here owns GPU memory or knows a clock:
// motion is a function of the time that the caller gives. Meshes and textures join as further tables when
// models are loaded.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/table.h"

namespace weft::scene {

// The draw lists a graph may name. A sphere may stand in several.
enum class DrawList : std::uint8_t { spheres, opaque, shadow_casters, transparent_spheres };
constexpr int kDrawListCount = 4;
const std::vector<std::string>& drawListNames();  // in the order of the enum
std::optional<DrawList> findDrawList(std::string_view name);
constexpr std::uint8_t maskOf(DrawList list) {
  return static_cast<std::uint8_t>(1u << static_cast<unsigned>(list));
}

struct Material {
  std::string name;
  glm::vec3 albedo{0.5f};  // linear; F0 of a metal
  float metallic = 0;
  float roughness = 0.5f;  // perceptual
};
using MaterialId = Table<Material>::Id;

struct Sphere {
  glm::vec3 center{0};    // world, at time 0
  float radius = 1;       // over 0
  glm::vec3 velocity{0};  // world units per second, constant
  MaterialId material;
  std::uint8_t lists = maskOf(DrawList::spheres);
};
using SphereId = Table<Sphere>::Id;

struct PointLight {
  std::string name;
  glm::vec3 position{0};
  glm::vec3 intensity{1};  // linear RGB radiant intensity: irradiance at distance d is intensity / d^2
  float range = 0;         // no contribution beyond; 0 for none
  bool shadow = false;
};

struct Sun {
  glm::vec3 direction{0, 1, 0};  // unit, from the scene towards the sun
  glm::vec3 irradiance{1};       // linear RGB on a surface that faces it
};

struct Scene {
  std::string name;
  Table<Material> materials;
  Table<Sphere> spheres;
  Table<PointLight> pointLights;
  std::optional<Sun> sun;
  Table<Camera> cameras;           // at least one after loading; the first is the default
  std::vector<std::string> files;  // what it was read from, for watching
};

// Null when no camera has the name; the first camera for "".
const Camera* findCamera(const Scene& scene, std::string_view name);

// One row of a draw list, spelled as the Instance of scene/instances.glsl.
struct Instance {
  glm::vec3 center{0};
  float radius = 1;
  glm::vec3 previous_center{0};
  float roughness = 0.5f;
  glm::vec3 albedo{0.5f};
  float metallic = 0;
};

std::size_t countInstances(const Scene& scene, DrawList list);
// Whether the list's instances differ from one time to another.
bool isMoving(const Scene& scene, DrawList list);
// Replaces `out` by the list's instances in table order. Linear in spheres; reuses the capacity of `out`.
void fillInstances(const Scene& scene, DrawList list, double time, double previousTime,
                   std::vector<Instance>& out);

}  // namespace weft::scene
