#include "engine/imports/world.h"

#include <cassert>

namespace weft::imports {

World::World(scene::Scene scene) : scene_(std::make_shared<const scene::Scene>(std::move(scene))) {}

void World::setScene(scene::Scene scene) {
  scene_ = std::make_shared<const scene::Scene>(std::move(scene));
  ++sceneGeneration_;
}

void World::setEnvironment(std::shared_ptr<const assets::EnvironmentMap> map) {
  environment_ = std::move(map);
  ++environmentGeneration_;
}

WorldFacts World::facts() const {
  WorldFacts facts;
  facts.environment = environment_ || environmentPending();
  if (environment_) {
    facts.environmentWidth = environment_->width;
    facts.environmentHeight = environment_->height;
  }
  facts.scene = scene_;
  facts.known = true;
  return facts;
}

FrameInput headlessFrame(const World& world, std::uint32_t frame, double fps, const Pointer& pointer) {
  const scene::Camera* camera = scene::findCamera(world.scene(), "");
  assert(camera && "a loaded scene has a camera");
  FrameInput input;
  input.frame = frame;
  input.deltaTime = 1.0 / fps;
  input.time = frame / fps;
  input.pointer = pointer;
  input.pointer.clicked = pointer.down && frame == 0;
  input.pose = scene::poseAt(*camera, input.time);
  input.previousPose = scene::poseAt(*camera, frame == 0 ? input.time : (frame - 1) / fps);
  return input;
}

}  // namespace weft::imports
