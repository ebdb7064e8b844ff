#include "engine/scene/frame/transforms.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/scene/frame/parallel.h"

namespace weft::scene {

using assets::ModelTrack;
using assets::TrackInterpolation;
using assets::TrackPath;

namespace {

glm::vec4 slerp(const glm::vec4& a, const glm::vec4& b, float f) {
  const glm::quat q = glm::slerp(glm::quat(a.w, a.x, a.y, a.z), glm::quat(b.w, b.x, b.y, b.z), f);
  return {q.x, q.y, q.z, q.w};
}

constexpr std::size_t kMinPart = 512;  // nodes that are worth a task
constexpr std::size_t kFewParts = 8, kFewAnimations = 64;

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

glm::vec4 sampleTrack(const ModelTrack& track, float time) {
  const std::vector<float>& times = track.times;
  const bool cubic = track.interpolation == TrackInterpolation::cubic;
  const auto key = [&](std::size_t i) { return track.values[cubic ? 3 * i + 1 : i]; };
  const std::size_t after =
      static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (after == 0) return key(0);
  if (after == times.size()) return key(after - 1);
  const std::size_t a = after - 1, b = after;
  if (track.interpolation == TrackInterpolation::step) return key(a);
  const float span = times[b] - times[a], f = (time - times[a]) / span;
  const bool rotation = track.path == TrackPath::rotation;
  if (!cubic) return rotation ? slerp(key(a), key(b), f) : key(a) + (key(b) - key(a)) * f;
  const glm::vec4 leaving = track.values[3 * a + 2] * span, arriving = track.values[3 * b] * span;
  const float f2 = f * f, f3 = f2 * f;
  const glm::vec4 v = key(a) * (2 * f3 - 3 * f2 + 1) + leaving * (f3 - 2 * f2 + f) +
                      key(b) * (3 * f2 - 2 * f3) + arriving * (f3 - f2);
  return rotation ? glm::normalize(v) : v;
}

float animationTime(const Animation& animation, double time) {
  const double duration = animation.tracks->duration;
  if (duration <= 0) return 0;
  const double local = std::fmod(time * static_cast<double>(animation.speed), duration);
  return static_cast<float>(local < 0 ? local + duration : local);
}

namespace {

// Writes the properties of nodes that animations move.
void animate(const Scene& scene, double time, std::span<Transform> locals) {
  const std::span<const Animation> animations = scene.animations.rows();
  forRanges(animations.size(), kFewAnimations, [&](std::size_t from, std::size_t to) {
    for (const Animation& animation : animations.subspan(from, to - from)) {
      const float at = animationTime(animation, time);
      for (std::size_t i = 0; i < animation.nodes.size(); ++i) {
        const ModelTrack& track = animation.tracks->tracks[i];
        if (track.path == TrackPath::weights) continue;
        const glm::vec4 v = sampleTrack(track, at);
        Transform& local = locals[animation.nodes[i].index];
        if (track.path == TrackPath::rotation)
          local.rotation = glm::quat(v.w, v.x, v.y, v.z);
        else
          (track.path == TrackPath::translation ? local.translation : local.scale) = glm::vec3(v);
      }
    }
  });
}

}  // namespace

void WorldTransforms::rebuild(const Scene& scene) {
  const std::span<const Node> nodes = scene.nodes.rows();
  moves_.assign(nodes.size(), 0);
  now_.locals.resize(nodes.size());
  for (const Animation& animation : scene.animations.rows())
    for (const NodeId node : animation.nodes) {
      assert(node.valid() && "an animation moves nodes of its scene");
      moves_[node.index] = 1;
    }
  moving_.clear();
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    const Node& node = nodes[row];
    const NodeId parent = node.parent;
    assert((!parent.valid() || parent.index < row) && "parents stand before their children");
    now_.locals[row] = node.local;
    if (node.spin != glm::vec3(0) || node.velocity != glm::vec3(0)) moves_[row] = 1;
    if (parent.valid() && moves_[parent.index] != 0) moves_[row] = 1;
    if (moves_[row] != 0) moving_.push_back(static_cast<std::uint32_t>(row));
  }
  now_.world.resize(nodes.size());

  // A part may begin where no later row has a moving parent before it.
  parts_ = {moving_.size()};
  std::uint32_t leastParent = assets::kNoRow;
  for (std::size_t i = moving_.size(); i-- > 0;) {
    const NodeId parent = nodes[moving_[i]].parent;
    if (parent.valid() && moves_[parent.index] != 0) leastParent = std::min(leastParent, parent.index);
    if (leastParent >= moving_[i] && parts_.back() - i >= kMinPart) parts_.push_back(i);
  }
  if (parts_.back() != 0) parts_.push_back(0);
  std::ranges::reverse(parts_);
}

void WorldTransforms::placeRow(const Scene& scene, At& at, std::uint32_t row) const {
  const Node& node = scene.nodes.rows()[row];
  glm::mat4 local = matrixOf(moved(node, at.locals[row], at.time));
  if (node.inner != glm::mat3(1)) local *= glm::mat4(node.inner);
  at.world[row] = node.parent.valid() ? at.world[node.parent.index] * local : local;
}

void WorldTransforms::placeMoving(const Scene& scene, At& at) {
  animate(scene, at.time, at.locals);
  forRanges(parts_.size() - 1, kFewParts, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = parts_[from]; i < parts_[to]; ++i) placeRow(scene, at, moving_[i]);
  });
  placed_ += moving_.size();
}

void WorldTransforms::update(const Scene& scene, std::uint64_t sceneGeneration, double time,
                             double previousTime) {
  if (sceneGeneration != generation_) {
    rebuild(scene);
    now_.time = time;
    animate(scene, time, now_.locals);
    for (std::uint32_t row = 0; row < scene.nodes.size(); ++row) placeRow(scene, now_, row);
    placed_ += scene.nodes.size();
    previous_ = now_;
  } else if (time != now_.time && previousTime == now_.time) {
    std::swap(now_, previous_);  // the frame before is most often the one that was placed last
  }
  generation_ = sceneGeneration;
  if (std::exchange(now_.time, time) != time) placeMoving(scene, now_);
  if (std::exchange(previous_.time, previousTime) != previousTime) placeMoving(scene, previous_);
}

}  // namespace weft::scene
