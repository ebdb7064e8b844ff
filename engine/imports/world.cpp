#include "engine/imports/world.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "engine/imports/material_textures.h"

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

std::uint64_t World::dropEnvironmentTexels() {
  if (!environment_ || environment_->texels.empty()) return 0;
  const std::uint64_t bytes = environment_->texels.size() * sizeof(environment_->texels[0]);
  assets::EnvironmentMap rest{environment_->width, environment_->height, {}, environment_->id};
  environment_ = std::make_shared<const assets::EnvironmentMap>(std::move(rest));
  return bytes;
}

void World::setEnvironment(const std::shared_ptr<const assets::ImageF>& image) {
  setEnvironment(std::make_shared<const assets::EnvironmentMap>(assets::toEnvironmentMap(*image)));
}

WorldFacts World::facts() const {
  WorldFacts facts;
  facts.environment = environment_ || environmentPending();
  if (environment_) {
    facts.environmentWidth = environment_->width;
    facts.environmentHeight = environment_->height;
  }
  facts.things = scene_;
  const scene::Scene& scene = *scene_;
  facts.materials = scene.materials.size();
  for (const MaterialArray& array : batchTextures(scene)) {
    WorldFacts::Maps& maps = facts.maps;
    ++maps.arrays;
    maps.width = std::max(maps.width, array.width);
    maps.height = std::max(maps.height, array.height);
    maps.layers = std::max(maps.layers, static_cast<std::uint32_t>(array.textures.size()));
    maps.mips = static_cast<std::uint32_t>(std::bit_width(std::max(maps.width, maps.height)));
  }
  facts.skins = scene.skins.size();
  facts.coloredVertices = scene.meshData ? scene.meshData->colors.size() : 0;
  facts.sun = scene.sun.has_value();
  facts.castingSun = facts.sun && scene.sun->shadow;
  facts.ground = scene.ground.has_value();
  facts.lamps = static_cast<std::uint32_t>(scene.lamps.size());
  facts.castingLamps =
      static_cast<std::uint32_t>(std::ranges::count_if(scene.lamps.rows(), &scene::Lamp::shadow));
  for (const scene::Camera& camera : scene.cameras.rows()) facts.cameras.push_back(camera.name);
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
