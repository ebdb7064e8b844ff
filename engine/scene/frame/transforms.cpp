#include "engine/scene/frame/transforms.h"

#include <cassert>
#include <cmath>
#include <numeric>

#include "engine/scene/frame/animation.h"

namespace weft::scene {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

std::uint32_t rowOf(const Table<Node>& nodes, NodeId id) {
  const Node* node = nodes.find(id);
  return node ? static_cast<std::uint32_t>(node - nodes.rows().data()) : kNone;
}

Transform moved(const Node& node, Transform local, double time) {
  local.translation += node.velocity * static_cast<float>(time);
  const float speed = glm::length(node.spin);
  if (speed > 0) {
    // The angle within one turn, so that it stays exact when the time is long.
    const double angle = std::fmod(static_cast<double>(speed) * time, 2 * 3.14159265358979323846);
    local.rotation = glm::angleAxis(static_cast<float>(angle), node.spin / speed) * local.rotation;
  }
  return local;
}

}  // namespace

void WorldTransforms::rebuild(const Scene& scene) {
  const std::span<const Node> nodes = scene.nodes.rows();
  parents_.resize(nodes.size());
  moves_.assign(nodes.size(), 0);
  locals_.resize(nodes.size());
  animatedRows_.clear();
  for (const Animation& animation : scene.animations.rows()) {
    std::vector<std::uint32_t>& rows = animatedRows_.emplace_back();
    for (const NodeId id : animation.nodes) {
      rows.push_back(rowOf(scene.nodes, id));
      assert(rows.back() != kNone && "an animation moves nodes of its scene");
      moves_[rows.back()] = 1;
    }
  }
  moving_.clear();
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    const Node& node = nodes[row];
    parents_[row] = rowOf(scene.nodes, node.parent);
    assert((parents_[row] == kNone || parents_[row] < row) && "parents stand before their children");
    locals_[row] = node.local;
    if (node.spin != glm::vec3(0) || node.velocity != glm::vec3(0)) moves_[row] = 1;
    if (parents_[row] != kNone && moves_[parents_[row]] != 0) moves_[row] = 1;
    if (moves_[row] != 0) moving_.push_back(static_cast<std::uint32_t>(row));
  }
  now_.resize(nodes.size());
}

void WorldTransforms::place(const Scene& scene, double time, std::span<const std::uint32_t> rows,
                            std::vector<glm::mat4>& out) {
  const std::span<const Animation> animations = scene.animations.rows();
  for (std::size_t i = 0; i < animations.size(); ++i)
    applyAnimation(animations[i], time, animatedRows_[i], locals_);
  const std::span<const Node> nodes = scene.nodes.rows();
  for (const std::uint32_t row : rows) {
    const glm::mat4 local = matrixOf(moved(nodes[row], locals_[row], time));
    out[row] = parents_[row] == kNone ? local : out[parents_[row]] * local;
  }
  updates_ += rows.size();
}

void WorldTransforms::update(const Scene& scene, std::uint64_t sceneGeneration, double time,
                             double previousTime) {
  if (sceneGeneration != generation_) {
    rebuild(scene);
    std::vector<std::uint32_t> all(scene.nodes.size());
    std::iota(all.begin(), all.end(), 0u);
    place(scene, time, all, now_);
    previous_ = now_;
    if (previousTime != time) place(scene, previousTime, moving_, previous_);
  } else if (time != time_ || previousTime != previousTime_) {
    // The frame before is most often the one that was placed last.
    if (previousTime == time_ && time != time_) {
      now_.swap(previous_);
      place(scene, time, moving_, now_);
    } else {
      if (time != time_) place(scene, time, moving_, now_);
      if (previousTime != previousTime_) place(scene, previousTime, moving_, previous_);
    }
  }
  generation_ = sceneGeneration;
  time_ = time;
  previousTime_ = previousTime;
}

}  // namespace weft::scene
