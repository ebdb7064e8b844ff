// Nodes, skins and animations: rows of Scene::nodes, ::skins and ::animations. Where a node stands is a function of time
// (engine/scene/frame/transforms.h works it out).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/assets/model.h"
#include "engine/scene/table.h"

namespace weft::scene {

using assets::Transform;
glm::mat4 matrixOf(const Transform& transform);

struct Node {
  std::string name;
  base::Id<Node> parent;  // stands before this row; none: the world
  Transform local;        // at time 0, unless an animation says otherwise
  glm::vec3 spin{0};  // turns about this axis, through the node's origin, by its length in radians per second
  glm::vec3 velocity{0};  // of the parent's units per second
};
using NodeId = Table<Node>::Id;

struct Skin {
  std::vector<NodeId> joints;
  std::vector<glm::mat4> inverseBind;  // parallel to joints: from the mesh to the joint
};
using SkinId = Table<Skin>::Id;

// An animation that plays, round and round. Copies of a model share the tracks and have nodes of their own.
struct Animation {
  std::shared_ptr<const assets::ModelAnimation> tracks;
  std::vector<NodeId> nodes;  // the node that a track moves, parallel to tracks->tracks
  float speed = 1;
};
using AnimationId = Table<Animation>::Id;

}  // namespace weft::scene
