#include "engine/runtime/world.h"

#include <algorithm>
#include <cassert>

namespace weft::runtime {

World::World(scene::Scene scene) : scene_(std::move(scene)) {}

void World::setScene(scene::Scene scene) {
  scene_ = std::move(scene);
  ++sceneGeneration_;
}

void World::setEnvironment(std::shared_ptr<const assets::ImageF> image) {
  environment_ = std::move(image);
  ++environmentGeneration_;
}

WorldFacts World::facts() const {
  WorldFacts facts;
  if (environment_) {
    facts.environment = true;
    facts.environmentWidth = static_cast<std::uint32_t>(environment_->width);
    facts.environmentHeight = static_cast<std::uint32_t>(environment_->height);
  }
  for (int i = 0; i < scene::kDrawListCount; ++i) {
    const auto list = static_cast<scene::DrawList>(i);
    facts.lists.push_back({scene::drawListNames()[static_cast<std::size_t>(i)], scene::countInstances(scene_, list)});
  }
  return facts;
}

FrameInput headlessFrame(const World& world, std::uint32_t frame, double fps) {
  const scene::Camera* camera = scene::findCamera(world.scene(), "");
  assert(camera && "a loaded scene has a camera");
  FrameInput input;
  input.frame = frame;
  input.deltaTime = 1.0 / fps;
  input.time = frame / fps;
  input.pose = scene::poseAt(*camera, input.time);
  input.previousPose = scene::poseAt(*camera, frame == 0 ? input.time : (frame - 1) / fps);
  return input;
}

}  // namespace weft::runtime
