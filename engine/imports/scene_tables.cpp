#include "engine/imports/scene_tables.h"

#include <algorithm>

namespace weft::imports {

Columns<scene::Instance> sphereColumns() {
  using Row = scene::Instance;
  return {column<Row, &Row::center>("center", "world"),
          column<Row, &Row::radius>("radius", "world units"),
          column<Row, &Row::previous_center>("previous_center", "of the frame before"),
          column<Row, &Row::roughness>("roughness", "perceptual"),
          column<Row, &Row::albedo>("albedo", "linear; F0 of a metal"),
          column<Row, &Row::metallic>("metallic", "0 to 1")};
}

Columns<scene::MeshRow> meshColumns() {
  using Row = scene::MeshRow;
  return {column<Row, &Row::transform>("transform", "model to world"),
          column<Row, &Row::previous_transform>("previous_transform", "of the frame before"),
          column<Row, &Row::material>("material", "row of @materials"),
          column<Row, &Row::first_joint>("first_joint", "of @joints; of a mesh whose weights are not 0")};
}

SceneTables::SceneTables() {
  for (const std::string& name : scene::drawListNames()) {
    sphereTables_.emplace_back(name, sphereColumns());
    meshTables_.emplace_back(name + " meshes", meshColumns());
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
                               text::Diagnostics& diagnostics) {
  const auto all = [&] { return std::span(rows(list)); };
  return sphereTables_[static_cast<std::size_t>(list)].get(layout, generation(list), all, diagnostics);
}

const scene::MeshFrame& SceneTables::meshFrame() {
  if (meshFrameNumber_ != number_) {
    meshFrame_.update(world_->scene(), world_->sceneGeneration(), input_->time,
                      input_->time - input_->deltaTime);
    meshFrameNumber_ = number_;
  }
  return meshFrame_;
}

BufferRef SceneTables::meshes(scene::DrawList list, const RowLayout& layout, text::Diagnostics& diagnostics) {
  const auto all = [&] { return meshFrame().rows(list); };
  return meshTables_[static_cast<std::size_t>(list)].get(layout, meshFrame().generation(list), all,
                                                         diagnostics);
}

void SceneTables::see(std::span<scene::MeshView* const> views) {
  meshViews_.update(world_->scene(), meshFrame(), views);
}

MeshDraw SceneTables::draw(MeshPass& pass, text::Diagnostics& diagnostics) {
  if (!meshBuffers_.renew(world_->scene(), world_->sceneGeneration(), diagnostics)) return {};
  return pass.draw(meshBuffers_, diagnostics);
}

}  // namespace weft::imports
