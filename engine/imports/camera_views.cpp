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
  Cached* cached = nullptr;
  for (Cached& each : cached_)
    if (each.width == width && each.height == height) cached = &each;
  if (!cached) {
    // Sizes that the last frame did not ask for go: a window that is being resized makes one per frame.
    std::erase_if(cached_, [&](const Cached& each) { return each.frame + 1 < frame.number; });
    cached_.push_back({.width = width, .height = height, .data = {}});
    cached = &cached_.back();
  }
  if (cached->frame != frame.number) {
    const FrameInput& input = frame.input;
    const auto [pose, previous] = posesOf(frame);
    cached->data = scene::makeView({.pose = pose,
                                    .previousPose = previous,
                                    .viewport = {width, height},
                                    .jitter = scene::jitterAt(input.frame, jitter_),
                                    .frame = input.frame,
                                    .time = input.time,
                                    .deltaTime = input.deltaTime});
    cached->frame = frame.number;
  }
  return cached->data;
}

}  // namespace weft::imports
