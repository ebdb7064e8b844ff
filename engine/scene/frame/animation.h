// Animations sampled at a time, as glTF 2.0 says (specification, appendix C): linear, step, cubic Hermite; rotations by
// slerp or normalised. Does not: blend animations, or know where a node stands in the world.
#pragma once

#include <span>

#include "engine/scene/scene.h"

namespace weft::scene {

// The value of a track, held before its first and after its last key: xyz, or a unit quaternion as x y z w.
glm::vec4 sampleTrack(const assets::ModelTrack& track, float time);

// Where `time` of the scene is in an animation that plays round and round.
float animationTime(const Animation& animation, double time);

// Writes the properties that an animation moves. `rows[i]` is the row of animation.nodes[i].
void applyAnimation(const Animation& animation, double time, std::span<const std::uint32_t> rows,
                    std::span<Transform> locals);

}  // namespace weft::scene
