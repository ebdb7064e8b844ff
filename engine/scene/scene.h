// The scene as tables with stable ids. Rows are plain values; nothing here owns GPU memory or knows a clock:
// motion is a function of the time that the caller gives. What of it depends on time is worked out in engine/scene/frame.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/ground.h"
#include "engine/scene/light.h"
#include "engine/scene/mesh.h"
#include "engine/scene/node.h"
#include "engine/scene/table.h"

namespace weft::scene {

using assets::Material;
using assets::Texture;
using MaterialId = Table<Material>::Id;

// The draw lists a graph may name. A list holds spheres and mesh instances; each may stand in several.
enum class DrawList : std::uint8_t { spheres, opaque, shadow_casters, transparent_spheres, transparent };
constexpr int kDrawListCount = 5;
const std::vector<std::string>& drawListNames();  // in the order of the enum
std::optional<DrawList> findDrawList(std::string_view name);
constexpr std::uint8_t maskOf(DrawList list) {
  return static_cast<std::uint8_t>(1u << static_cast<unsigned>(list));
}

struct Sphere {
  glm::vec3 center{0};    // world, at time 0
  float radius = 1;       // over 0
  glm::vec3 velocity{0};  // world units per second, constant
  MaterialId material;
  std::uint8_t lists = maskOf(DrawList::spheres);
};
using SphereId = Table<Sphere>::Id;

struct MeshInstance {
  NodeId node;
  MeshId mesh;
  MaterialId material;
  SkinId skin;  // of a skinned mesh; its joints place it then, and not its node
  std::uint8_t lists = static_cast<std::uint8_t>(maskOf(DrawList::opaque) | maskOf(DrawList::shadow_casters));
};
using MeshInstanceId = Table<MeshInstance>::Id;

struct Scene {
  std::string name;
  Table<Material> materials;
  Table<Sphere> spheres;
  Table<Texture> textures;
  std::shared_ptr<const MeshData> meshData;  // null: no meshes
  Table<Mesh> meshes;
  Table<Node> nodes;  // parents before children
  Table<Skin> skins;
  Table<Animation> animations;  // that play
  Table<MeshInstance> meshInstances;
  Table<Lamp> lamps;
  std::optional<Sun> sun;
  std::optional<Ground> ground;
  float nits = 10000;              // cd/m² that one scene-referred unit stands for
  Table<Camera> cameras;           // at least one after loading; the first is the default
  std::vector<std::string> files;  // what it was read from, for watching
};

// Null when no camera has the name; the first camera for "".
const Camera* findCamera(const Scene& scene, std::string_view name);

// One sphere of a draw list, spelled as the Instance of scene/instances.glsl.
struct Instance {
  glm::vec3 center{0};
  float radius = 1;
  glm::vec3 previous_center{0};
  float roughness = 0.5f;
  glm::vec3 albedo{0.5f};
  float metallic = 0;
};

std::size_t countInstances(const Scene& scene, DrawList list);      // spheres
std::size_t countMeshInstances(const Scene& scene, DrawList list);  // mesh instances
// Whether the list's spheres differ from one time to another.
bool isMoving(const Scene& scene, DrawList list);
bool isMoving(const Scene& scene);  // any sphere or node
// Replaces `out` by the list's instances in table order. Linear in spheres; reuses the capacity of `out`.
void fillInstances(const Scene& scene, DrawList list, double time, double previousTime,
                   std::vector<Instance>& out);

}  // namespace weft::scene
