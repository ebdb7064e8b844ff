#include "engine/imports/camera_views.h"

namespace weft::imports {

std::pair<scene::CameraPose, scene::CameraPose> CameraViews::posesOf(const Frame& frame) const {
  return poses_ ? poses_(frame) : std::pair(frame.input.pose, frame.input.previousPose);
}

std::uint64_t CameraViews::generation(const Frame& frame) {
  const scene::CameraPose pose = posesOf(frame).first;
  if (generation_ == 0 || pose != seen_) {
    seen_ = pose;
    generation_ = frame.newGeneration();
  }
  return generation_;
}

const scene::ViewData& CameraViews::view(const Frame& frame, std::uint32_t width, std::uint32_t height) {
  const glm::uvec2 size(width, height);
  if (made_ == frame.number && size == size_) return data_;
  const FrameInput& input = frame.input;
  const auto [pose, previous] = posesOf(frame);
  data_ = scene::makeView({.pose = pose,
                           .previousPose = previous,
                           .viewport = size,
                           .jitter = scene::jitterAt(input.frame, jitter_),
                           .frame = input.frame,
                           .time = input.time,
                           .deltaTime = input.deltaTime});
  made_ = frame.number;
  size_ = size;
  return data_;
}

}  // namespace weft::imports
