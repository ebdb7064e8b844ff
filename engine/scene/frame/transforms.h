// Where nodes stand in the world, at a time and at the time before. Parents are updated before their children, by one walk
// over the table; nodes that never move are placed once per scene, so that a frame costs what moved. Does not: know meshes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace weft::scene {

class WorldTransforms {
 public:
  // Nothing happens for a generation and times that are those of the last call.
  void update(const Scene& scene, std::uint64_t sceneGeneration, double time, double previousTime);

  // By row of Scene::nodes.
  std::span<const glm::mat4> now() const { return now_; }
  std::span<const glm::mat4> previous() const { return previous_; }
  // Whether a row can ever stand elsewhere.
  bool isMoving(std::size_t row) const { return moves_[row] != 0; }
  // How many times a node was placed since this was made. For tests and measurements.
  std::uint64_t updates() const { return updates_; }

 private:
  void rebuild(const Scene& scene);
  void place(const Scene& scene, double time, std::span<const std::uint32_t> rows,
             std::vector<glm::mat4>& out);

  std::uint64_t generation_ = 0;  // of the scene; 0: none yet
  double time_ = 0, previousTime_ = 0;
  std::vector<glm::mat4> now_, previous_;
  std::vector<std::uint32_t> parents_;  // rows, or kNone
  std::vector<std::uint8_t> moves_;
  std::vector<std::uint32_t> moving_;                     // rows that move, ascending
  std::vector<Transform> locals_;                         // with what animations make of them
  std::vector<std::vector<std::uint32_t>> animatedRows_;  // per animation, parallel to its tracks
  std::uint64_t updates_ = 0;
};

}  // namespace weft::scene
