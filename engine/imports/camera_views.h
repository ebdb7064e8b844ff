// The scene's camera through one lens and one jitter: a view per size of screen, made once a frame. Shared by what needs
// the camera as it is, and one more per camera that a graph declares.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/imports/frame.h"
#include "engine/scene/camera.h"

namespace weft::imports {

class CameraViews {
 public:
  // `jitter`: length of the sub-pixel sequence, 0 for none. `fovDegrees`: 0 for the scene's.
  explicit CameraViews(std::uint32_t jitter = 0, double fovDegrees = 0)
      : jitter_(jitter), fovDegrees_(fovDegrees) {}
  // Valid until the next call.
  const scene::ViewData& view(const Frame& frame, std::uint32_t width, std::uint32_t height);

 private:
  struct Cached {
    std::uint32_t width = 0, height = 0;
    std::uint64_t frame = 0;  // that it was made in
    scene::ViewData data;
  };
  std::uint32_t jitter_;
  double fovDegrees_;
  std::vector<Cached> cached_;
};

}  // namespace weft::imports
