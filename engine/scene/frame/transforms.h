// Where nodes stand in the world, at a time and at the time before. Parents are updated before their children, by one walk
// over the table; nodes that never move are placed once per scene, so that a frame costs what moved.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace weft::scene {

// Animations sampled at a time, as glTF 2.0 says (specification, appendix C): linear, step, cubic Hermite; rotations by slerp or
// normalized.
// The value of a track, held before its first and after its last key: xyz, or a unit quaternion as x y z w.
glm::vec4 sampleTrack(const assets::ModelTrack& track, float time);

// Where `time` of the scene is in an animation that plays round and round.
float animationTime(const Animation& animation, double time);

class WorldTransforms {
 public:
  // Nothing happens for a generation and times that are those of the last call.
  void update(const Scene& scene, std::uint64_t sceneGeneration, double time, double previousTime);

  // One matrix per row of Scene::nodes.
  std::span<const glm::mat4> now() const { return now_.world; }
  std::span<const glm::mat4> previous() const { return previous_.world; }
  // Whether a row can ever stand elsewhere.
  bool isMoving(std::size_t row) const { return moves_[row] != 0; }
  // How many times a node was placed since this was made. For tests and measurements.
  std::uint64_t updates() const { return placed_; }

 private:
  struct At {
    std::vector<glm::mat4> world;
    std::vector<Transform> locals;  // with what animations make of them
    double time = 0;
  };
  void rebuild(const Scene& scene);
  void placeMoving(const Scene& scene, At& at);
  void placeRow(const Scene& scene, At& at, std::uint32_t row) const;

  std::uint64_t generation_ = 0;  // of the scene; 0: none yet
  At now_, previous_;
  std::vector<std::uint8_t> moves_;
  std::vector<std::uint32_t> moving_;  // rows that move, ascending
  std::vector<std::size_t> parts_;     // of moving_, independent ones: where each begins, and the end
  std::uint64_t placed_ = 0;
};

}  // namespace weft::scene
