#include "engine/imports/scene_tables.h"

#include <algorithm>

namespace weft::imports {

std::span<const graph::TableColumn> sphereColumns() {
  static const std::vector<graph::TableColumn> columns = {{"center", "vec3", "world"},
                                                          {"radius", "float", "world units"},
                                                          {"previous_center", "vec3", "of the frame before"},
                                                          {"roughness", "float", "perceptual"},
                                                          {"albedo", "vec3", "linear; F0 of a metal"},
                                                          {"metallic", "float", "0 to 1"}};
  return columns;
}

std::span<const graph::TableColumn> meshColumns() {
  static const std::vector<graph::TableColumn> columns = {
      {"transform", "mat4", "model to world"},
      {"previous_transform", "mat4", "of the frame before"},
      {"material", "uint", "row of @materials"},
      {"first_joint", "uint", "of @joints; of a mesh whose weights are not 0"}};
  return columns;
}

SceneTables::SceneTables() {
  for (const std::string& name : scene::drawListNames()) {
    sphereTables_.emplace_back(name);
    meshTables_.emplace_back(name + " meshes");
  }
}

void SceneTables::beginFrame(const World& world, const FrameInput& input, std::uint64_t number) {
  world_ = &world;
  input_ = &input;
  number_ = number;
  const auto moment = std::pair(input.time, input.deltaTime);
  if (moment != moment_) ++moments_;
  moment_ = moment;
}

const SceneTables::ListFacts& SceneTables::factsOf(scene::DrawList list) {
  ListFacts& facts = facts_[static_cast<std::size_t>(list)];
  if (facts.scene != world_->sceneGeneration())
    facts = {.scene = world_->sceneGeneration(),
             .count = static_cast<std::uint32_t>(scene::countInstances(world_->scene(), list)),
             .moving = scene::isMoving(world_->scene(), list)};
  return facts;
}

std::uint32_t SceneTables::countOf(scene::DrawList list) {
  return factsOf(list).count;
}

std::uint64_t SceneTables::generation(scene::DrawList list) {
  const std::uint64_t still = world_->sceneGeneration() << 32;
  return factsOf(list).moving ? still + moments_ : still;
}

const std::vector<scene::Instance>& SceneTables::rows(scene::DrawList list) {
  Rows& mine = rows_[static_cast<std::size_t>(list)];
  const std::uint64_t wanted = generation(list);
  if (mine.generation != wanted) {
    scene::fillInstances(world_->scene(), list, input_->time, input_->time - input_->deltaTime, mine.rows);
    mine.generation = wanted;
  }
  return mine.rows;
}

BufferRef SceneTables::spheres(scene::DrawList list, const RowLayout& layout,
                               base::Diagnostics& diagnostics) {
  const auto fill = [&](const RowLayout& wanted, std::vector<std::byte>& bytes) {
    const std::vector<scene::Instance>& all = rows(list);
    RowWriter writer(wanted, all.size(), bytes);
    for (std::size_t i = 0; i < all.size(); ++i) {
      writer.put(i, 0, all[i].center);
      writer.put(i, 1, all[i].radius);
      writer.put(i, 2, all[i].previous_center);
      writer.put(i, 3, all[i].roughness);
      writer.put(i, 4, all[i].albedo);
      writer.put(i, 5, all[i].metallic);
    }
  };
  return sphereTables_[static_cast<std::size_t>(list)].get(layout, generation(list), fill, diagnostics);
}

const scene::MeshFrame& SceneTables::meshFrame() {
  if (meshFrameNumber_ != number_) {
    meshFrame_.update(world_->scene(), world_->sceneGeneration(), input_->time,
                      input_->time - input_->deltaTime);
    meshFrameNumber_ = number_;
  }
  return meshFrame_;
}

std::uint64_t SceneTables::meshGeneration(scene::DrawList list) {
  return meshFrame().generation(list);
}

BufferRef SceneTables::meshes(scene::DrawList list, const RowLayout& layout, base::Diagnostics& diagnostics) {
  const auto fill = [&](const RowLayout& wanted, std::vector<std::byte>& bytes) {
    const std::span<const scene::MeshRow> all = meshFrame().rows(list);
    RowWriter writer(wanted, all.size(), bytes);
    for (std::size_t i = 0; i < all.size(); ++i) {
      writer.put(i, 0, all[i].transform);
      writer.put(i, 1, all[i].previous_transform);
      writer.put(i, 2, all[i].material);
      writer.put(i, 3, all[i].first_joint);
    }
  };
  return meshTables_[static_cast<std::size_t>(list)].get(layout, meshGeneration(list), fill, diagnostics);
}

void SceneTables::see(std::span<scene::MeshView* const> views) {
  meshViews_.update(world_->scene(), meshFrame(), views);
}

MeshDraw SceneTables::draw(MeshPass& pass, base::Diagnostics& diagnostics) {
  if (!meshBuffers_.renew(world_->scene(), world_->sceneGeneration(), diagnostics)) return {};
  return pass.draw(meshBuffers_, diagnostics);
}

void SceneTables::setThreads(int threads) {
  meshFrame_.setThreads(threads);
  meshViews_.setThreads(threads);
}

}  // namespace weft::imports
