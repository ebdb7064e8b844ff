#include "engine/imports/world.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "engine/imports/material_textures.h"

namespace weft::imports {

double WorldFacts::countOf(std::string_view list) const {
  const auto found = std::ranges::find(lists, list, &List::name);
  return found == lists.end() ? 0 : static_cast<double>(found->count);
}

double WorldFacts::meshesOf(std::string_view list) const {
  const auto found = std::ranges::find(lists, list, &List::name);
  return found == lists.end() ? 0 : static_cast<double>(found->meshes);
}

World::World(scene::Scene scene) : scene_(std::move(scene)) {}

void World::setScene(scene::Scene scene) {
  scene_ = std::move(scene);
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
  for (int i = 0; i < scene::kDrawListCount; ++i) {
    const auto list = static_cast<scene::DrawList>(i);
    facts.lists.push_back({scene::drawListNames()[static_cast<std::size_t>(i)],
                           scene::countInstances(scene_, list), scene::countMeshInstances(scene_, list)});
  }
  for (const scene::Sphere& sphere : scene_.spheres.rows())
    if (sphere.lists != 0 && sphere.lists != scene::Sphere{}.lists) ++facts.unusual[sphere.lists];
  for (const scene::MeshInstance& mesh : scene_.meshInstances.rows())
    if (mesh.lists != 0 && mesh.lists != scene::MeshInstance{}.lists) ++facts.unusual[mesh.lists];
  facts.materials = scene_.materials.size();
  for (const MaterialArray& array : batchTextures(scene_)) {
    WorldFacts::Maps& maps = facts.maps;
    ++maps.arrays;
    maps.width = std::max(maps.width, array.width);
    maps.height = std::max(maps.height, array.height);
    maps.layers = std::max(maps.layers, static_cast<std::uint32_t>(array.textures.size()));
    maps.mips = static_cast<std::uint32_t>(std::bit_width(std::max(maps.width, maps.height)));
  }
  facts.skins = scene_.skins.size();
  facts.coloredVertices = scene_.meshData ? scene_.meshData->colors.size() : 0;
  facts.sun = scene_.sun.has_value();
  facts.castingSun = facts.sun && scene_.sun->shadow;
  facts.ground = scene_.ground.has_value();
  facts.lamps = static_cast<std::uint32_t>(scene_.lamps.size());
  facts.castingLamps =
      static_cast<std::uint32_t>(std::ranges::count_if(scene_.lamps.rows(), &scene::Lamp::shadow));
  for (const scene::Camera& camera : scene_.cameras.rows()) facts.cameras.push_back(camera.name);
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
