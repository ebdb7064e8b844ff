// The scene as tables. Rows are plain values; nothing here owns GPU memory or knows a clock:
// motion is a function of the time that the caller gives. What of it depends on time is worked out in engine/scene/frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/assets/model.h"
#include "engine/scene/camera.h"

namespace weft::scene {

using assets::Box;
using assets::Material;
using assets::Mesh;
using assets::MeshData;
using assets::SkinVertex;
using assets::Texture;
using assets::Transform;
using assets::Vertex;

// A row of the table of such rows.
template <class Row>
struct Id {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t index = kNone;
  constexpr bool valid() const { return index != kNone; }
  friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

// Rows in the order in which they were added.
template <class Row>
class Table {
 public:
  Id<Row> add(Row row) {
    rows_.push_back(std::move(row));
    return idOf(rows_.size() - 1);
  }
  Id<Row> idOf(std::size_t row) const { return {static_cast<std::uint32_t>(row)}; }
  // Null for the id of nothing.
  const Row* find(Id<Row> id) const { return id.index < rows_.size() ? &rows_[id.index] : nullptr; }
  Row& edit(Id<Row> id) { return rows_[id.index]; }
  std::span<const Row> rows() const { return rows_; }
  std::size_t size() const { return rows_.size(); }
  void reserve(std::size_t count) { rows_.reserve(count); }

 private:
  std::vector<Row> rows_;
};

using MaterialId = Id<Material>;
using MeshId = Id<Mesh>;

// Where a node stands is a function of time (engine/scene/frame/transforms.h).
glm::mat4 matrixOf(const Transform& transform);

struct Node;
using NodeId = Id<Node>;
struct Node {
  std::string name;
  NodeId parent;       // stands before this row; none: the world
  Transform local;     // at time 0, unless an animation says otherwise
  glm::mat3 inner{1};  // before it
  glm::vec3 spin{0};  // turns about this axis, through the node's origin, by its length in radians per second
  glm::vec3 velocity{0};          // of the parent's units per second
  std::uint32_t firstWeight = 0;  // in Scene::weights, of a morphed mesh of its own or of its parent
};

struct Skin {
  std::vector<NodeId> joints;
  std::vector<glm::mat4> inverseBind;  // parallel to joints: from the mesh to the joint
};
using SkinId = Id<Skin>;

// An animation that plays, round and round. Copies of a model share tracks, not nodes: no two animations move the same node.
struct Animation {
  std::shared_ptr<const assets::ModelAnimation> tracks;
  std::vector<NodeId> nodes;  // the node that a track moves, parallel to tracks->tracks
  float speed = 1;
};

// Quantities of light are in scene units: Scene::nits cd/m² are one unit of radiance, so that an irradiance is lux / nits and an
// intensity candela / nits, per color channel.
struct Sun {
  glm::vec3 direction{0, 1, 0};  // unit, from the scene towards the sun
  glm::vec3 irradiance{1};       // linear RGB, on a surface that faces it
  float angle = 0.53f;           // degrees: diameter of the disc
  bool shadow = true;
  NodeId node{};  // that turns it, as a lamp's does
};

struct Lamp {
  std::string name;
  glm::vec3 position{0};
  glm::vec3 intensity{1};  // linear RGB radiant intensity: irradiance at distance d is intensity / d²
  float range = 0;         // over 0: no light beyond; by default where irradiance falls below kMinIrradiance
  glm::vec3 direction{0, -1, 0};       // unit, from the lamp; of a spot
  float cosInner = -1, cosOuter = -1;  // of half angles: full light within, none outside; -1: all round
  bool shadow = false;
  float radius = 0;            // world units: of the ball that shines, for soft shadows
  glm::vec3 across{0}, up{0};  // of a rectangle, from its middle to two sides; 0: it is none
  // What it stands on: position and direction are in this node's coordinates then. Lengths are not scaled. None: the world.
  NodeId node{};
};

constexpr float kMinIrradiance = 1e-3f;  // scene units
float rangeOf(glm::vec3 intensity);      // where its brightest channel falls to kMinIrradiance

// A direction of a light in the world, by the matrix of its node; where a scale is 0 as it is in the node.
glm::vec3 turnDirection(const glm::mat4& node, glm::vec3 direction);

// A horizontal plane that things stand on. It takes their shadows; what it shows beside them is the environment, or a surface of
// its own that ends in the environment.
struct Ground {
  float height = 0;                 // world Y
  std::optional<glm::vec3> albedo;  // linear, of a diffuse surface; empty: it shows the environment
  float radius = 100;               // of that surface, about the world's Y axis; it fades in the outer half
};

// The draw lists that every scene has. A list holds spheres and mesh instances; each may stand in several. Greater numbers are those
// of lists that graphs choose, each with a Selection, which whoever numbers them keeps.
enum class DrawList : std::uint16_t {
  spheres,
  opaque,
  shadow_casters,
  transparent_spheres,
  transparent,
  transmissive
};
constexpr int kDrawListCount = 6;
const std::vector<std::string>& drawListNames();  // in the order of the enum
std::optional<DrawList> findDrawList(std::string_view name);
constexpr std::uint8_t maskOf(DrawList list) {
  return static_cast<std::uint8_t>(1u << static_cast<unsigned>(list));
}

// How the meshes of a list are drawn: those of a mesh together, those of a material together, or by the depth of the centers of
// their boxes. Equal ones in the order of the rows.
enum class MeshOrder : std::uint8_t { by_mesh, by_material, front_to_back, back_to_front };

// Which things of a scene a draw list holds.
struct Selection {
  std::uint8_t lists = 0xff;        // those in any of these
  std::string name, tag, material;  // names with '*' at the ends for any text; empty: whatever it is
  std::optional<MeshOrder> order;   // empty: back_to_front where a pass blends, else by_mesh
  Selection() = default;
  Selection(DrawList list)
      : lists(maskOf(list)) {}  // NOLINT(google-explicit-constructor): one of the scene's is a selection
  friend bool operator==(const Selection&, const Selection&) = default;
};

// What a selection knows a thing by, besides its material.
struct Label {
  std::vector<std::string> names, tags;  // its own, and those of the nodes and the model that it is part of
  friend bool operator==(const Label&, const Label&) = default;
};
using LabelId = Id<Label>;

struct Sphere {
  glm::vec3 center{0};    // world, at time 0
  float radius = 1;       // over 0
  glm::vec3 velocity{0};  // world units per second, constant
  MaterialId material;
  LabelId label{};
  std::uint8_t lists = maskOf(DrawList::spheres);
};

struct MeshInstance {
  NodeId node;
  MeshId mesh;
  MaterialId material;
  SkinId skin;  // of a skinned mesh; its joints place it then, and not its node
  LabelId label{};
  std::uint8_t lists = static_cast<std::uint8_t>(maskOf(DrawList::opaque) | maskOf(DrawList::shadow_casters));
};

struct Scene {
  std::string name;
  Table<Material> materials;
  Table<Label> labels;
  Table<Sphere> spheres;
  Table<Texture> textures;
  std::shared_ptr<const MeshData> meshData;  // null: no meshes
  Table<Mesh> meshes;
  Table<Node> nodes;  // parents before children
  Table<Skin> skins;
  Table<Animation> animations;  // that play
  std::vector<float> weights;   // at time 0, as Node::local
  Table<MeshInstance> meshInstances;
  Table<Lamp> lamps;
  std::optional<Sun> sun;
  std::optional<Ground> ground;
  float nits = 10000;  // cd/m² that one scene-referred unit stands for
  glm::vec3 toUnits(double photometric, glm::vec3 color) const {
    return color * static_cast<float>(photometric / double{nits});
  }
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

// Which rows of a scene a selection holds, found out once.
class Members {
 public:
  Members(const Selection& selection, const Scene& scene);
  bool has(const auto& row) const {  // a Sphere or a MeshInstance
    return (row.lists & lists_) != 0 && admits(labels_, row.label.index) &&
           admits(materials_, row.material.index);
  }
  std::size_t count(const auto& table) const {  // of such rows
    return static_cast<std::size_t>(
        std::ranges::count_if(table.rows(), [&](const auto& row) { return has(row); }));
  }

 private:
  // By row, and one more for none; empty: all.
  static bool admits(const std::vector<std::uint8_t>& rows, std::uint32_t row) {
    return rows.empty() || rows[std::min<std::size_t>(row, rows.size() - 1)] != 0;
  }
  std::uint8_t lists_;
  std::vector<std::uint8_t> labels_, materials_;
};
// Whether a text is what a word of a Selection says.
bool matches(std::string_view word, std::string_view text);

// Whether the list's spheres differ from one time to another.
bool isMoving(const Scene& scene, const Selection& list);
bool isMoving(const Scene& scene);  // any sphere or node
// Replaces `out` by the list's instances in table order. Linear in spheres; reuses the capacity of `out`.
void fillInstances(const Scene& scene, const Selection& list, double time, double previousTime,
                   std::vector<Instance>& out);

}  // namespace weft::scene
