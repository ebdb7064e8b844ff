// What a frame draws of the scene's mesh instances: a row per instance and draw list with its matrices of this frame and of
// the one before, boxes to cull, the matrices of joints, and lights. Owns its tables and works out again only what moved.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/scene/frame/transforms.h"
#include "engine/scene/scene.h"

namespace weft::scene {

// Spelled as the MeshRow of shaders/scene/meshes.glsl. Of a skinned mesh `transform` is the identity: its joints take a
// vertex from the mesh to the world.
struct MeshRow {
  glm::mat4 transform{1}, previous_transform{1};
  std::uint32_t material = 0;     // row of Scene::materials
  std::uint32_t first_joint = 0;  // of a skinned mesh
  std::uint32_t mesh = 0;         // row of Scene::meshes
  // Of a morphed mesh: target t of vertex v of all is row first_target + v * targets + t.
  std::uint32_t first_weight = 0, first_target = 0, targets = 0;
};

// Of a skinned mesh: takes a vertex from the bind pose to the world, in this frame and in the one before.
struct Joint {
  glm::mat4 now{1}, previous{1};
};

class MeshFrame {
 public:
  // `chosen`: lists beside those of every scene, numbered behind them; there may be more than in the last call, and the others
  // must be the same. Nothing happens for a generation, times and lists that are those of the last call. Little work is done on
  // one thread; the tables are the same, byte for byte, on any number.
  void update(const Scene& scene, std::uint64_t sceneGeneration, double time, double previousTime,
              std::span<const Selection> chosen = {});

  // The rows of the last update. Those of one mesh stand together, in table order; meshes stand in the order of Scene::meshes.
  std::span<const MeshRow> rows(DrawList list) const { return tableOf(list).rows; }
  // World space, parallel to rows.
  std::span<const Box> bounds(DrawList list) const { return tableOf(list).bounds; }
  // Two per joint: now, previous. From the mesh to the world.
  std::span<const Joint> joints() const { return joints_; }
  // Parallel to Scene::weights: now and previous; of the generation of joints.
  std::span<const glm::vec2> weights() const { return weights_; }
  // Moves when a row may be another.
  std::uint64_t generation(DrawList list) const { return tableOf(list).generation; }
  std::uint64_t jointsGeneration() const { return jointsGeneration_; }
  // The box of everything that stands in any list, spheres too, at the time of the last update.
  Box sceneBounds() const { return bounds_; }
  // Whether any row of the list can ever be another.
  bool isMoving(DrawList list) const { return !tableOf(list).moving.empty(); }
  // Scene::lamps and Scene::sun as they stand in the world.
  std::span<const Lamp> lamps() const { return lamps_; }
  const std::optional<Sun>& sun() const { return sun_; }
  std::uint64_t lightsGeneration() const { return lightsGeneration_; }
  // How many times a node was placed since this was made.
  std::uint64_t nodeUpdates() const { return transforms_.updates(); }

 private:
  // One set of instances. Lists that hold the same ones share it.
  struct ListTable {
    std::vector<std::uint32_t> instances;  // rows of Scene::meshInstances
    std::vector<std::uint32_t> moving;     // rows of this table
    std::vector<MeshRow> rows;
    std::vector<Box> bounds;
    std::uint64_t generation = 0;  // 0: its rows are not filled yet
  };
  const ListTable& tableOf(DrawList list) const { return tables_[tableOf_[static_cast<std::size_t>(list)]]; }
  void rebuild(const Scene& scene);
  bool isMoving(const Scene& scene, const MeshInstance& instance) const;
  void addList(const Scene& scene, const Selection& list);
  void fillJoints(const Scene& scene, bool all);
  void fillRow(const Scene& scene, ListTable& table, std::uint32_t row) const;
  void fillRows(const Scene& scene, bool another);
  void fillBounds(const Scene& scene, double time, bool all);
  void fillLights(const Scene& scene, bool all);

  std::uint64_t sceneGeneration_ = 0;  // 0: none yet
  double time_ = 0, previousTime_ = 0;
  WorldTransforms transforms_;
  std::vector<ListTable> tables_{1};                                                 // the first is empty
  std::vector<std::uint32_t> tableOf_ = std::vector<std::uint32_t>(kDrawListCount);  // by list
  std::vector<std::uint32_t> firstJoint_;                                            // by row of Scene::skins
  std::vector<std::uint32_t> jointNodes_;  // rows, of all skins one after another
  std::vector<Joint> joints_;
  std::vector<glm::vec2> weights_;
  std::vector<std::uint8_t> skinMoves_;  // by row of Scene::skins
  std::uint64_t jointsGeneration_ = 0, count_ = 0;
  bool spheresMove_ = false;
  std::vector<Lamp> lamps_;
  std::optional<Sun> sun_;
  bool lightsMove_ = false;
  std::uint64_t lightsGeneration_ = 0;
  Box sphereBounds_, bounds_;
  std::vector<Box> partBoxes_;  // of parts of a table, while bounds_ is made
};

}  // namespace weft::scene
