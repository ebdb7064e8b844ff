// A camera through one lens and one jitter: the view for a size of screen, kept for the frame. Shared by what needs
// the scene's camera as it is, and one more per camera that a graph declares.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "engine/imports/world.h"
#include "engine/scene/camera.h"

namespace weft::imports {

class CameraViews {
 public:
  // Where it stands in a frame, and where in the one before.
  using Poses = std::function<std::pair<scene::CameraPose, scene::CameraPose>(const Frame&)>;
  // `jitter`: length of the sub-pixel sequence, 0 for none. `poses`: empty for the scene's camera.
  explicit CameraViews(std::uint32_t jitter = 0, Poses poses = {})
      : jitter_(jitter), poses_(std::move(poses)) {}
  // Moves when the camera stands elsewhere or has another lens. What else a view holds does not count: the moment, the
  // sub-pixel step of the jitter, and where the camera stood before.
  std::uint64_t generation(const Frame& frame);
  // Valid until the next call.
  const scene::ViewData& view(const Frame& frame, std::uint32_t width, std::uint32_t height);

 private:
  std::pair<scene::CameraPose, scene::CameraPose> posesOf(const Frame& frame) const;
  std::uint32_t jitter_;
  Poses poses_;
  scene::CameraPose seen_;  // of generation_
  std::uint64_t generation_ = 0;
  scene::ViewData data_;  // of a size, in a frame
  glm::uvec2 size_{0};
  std::uint64_t made_ = 0;
};

}  // namespace weft::imports
