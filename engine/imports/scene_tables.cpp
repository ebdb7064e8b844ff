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
  for (int i = 0; i < scene::kDrawListCount; ++i)
    add(static_cast<scene::DrawList>(i), scene::drawListNames()[static_cast<std::size_t>(i)]);
}

void SceneTables::add(const scene::Selection& selection, const std::string& label) {
  lists_.push_back({.selection = selection,
                    .spheres = {label, sphereColumns()},
                    .meshes = {label + " meshes", meshColumns()},
                    .rows = {}});
}

scene::DrawList SceneTables::listOf(const scene::Selection& selection) {
  const auto known = std::ranges::find(lists_, selection, &List::selection);
  const auto list = static_cast<scene::DrawList>(known - lists_.begin());
  if (known == lists_.end()) {
    add(selection, "draw list");
    chosen_.push_back(selection);
    meshFrameNumber_ = 0;
  }
  return list;
}

void SceneTables::beginFrame(const World& world, const FrameInput& input, std::uint64_t number) {
  world_ = &world;
  input_ = &input;
  number_ = number;
  const auto moment = std::pair(input.time, input.deltaTime);
  if (moment != moment_) ++moments_;
  moment_ = moment;
}

const SceneTables::List& SceneTables::factsOf(scene::DrawList list) {
  List& mine = of(list);
  if (mine.scene != world_->sceneGeneration()) {
    mine.scene = world_->sceneGeneration();
    mine.count = static_cast<std::uint32_t>(scene::countInstances(world_->scene(), mine.selection));
    mine.moving = scene::isMoving(world_->scene(), mine.selection);
  }
  return mine;
}

std::uint32_t SceneTables::countOf(scene::DrawList list) {
  return factsOf(list).count;
}

std::uint64_t SceneTables::generation(scene::DrawList list) {
  const std::uint64_t still = world_->sceneGeneration() << 32;
  return factsOf(list).moving ? still + moments_ : still;
}

const std::vector<scene::Instance>& SceneTables::rows(scene::DrawList list) {
  List& mine = of(list);
  const std::uint64_t wanted = generation(list);
  if (mine.generation != wanted) {
    scene::fillInstances(world_->scene(), mine.selection, input_->time, input_->time - input_->deltaTime,
                         mine.rows);
    mine.generation = wanted;
  }
  return mine.rows;
}

BufferRef SceneTables::spheres(scene::DrawList list, const RowLayout& layout,
                               text::Diagnostics& diagnostics) {
  const auto all = [&] { return std::span(rows(list)); };
  return of(list).spheres.get(layout, generation(list), all, diagnostics);
}

const scene::MeshFrame& SceneTables::meshFrame() {
  if (meshFrameNumber_ != number_) {
    meshFrame_.update(world_->scene(), world_->sceneGeneration(), input_->time,
                      input_->time - input_->deltaTime, chosen_);
    meshFrameNumber_ = number_;
  }
  return meshFrame_;
}

BufferRef SceneTables::meshes(scene::DrawList list, const RowLayout& layout, text::Diagnostics& diagnostics) {
  const auto all = [&] { return meshFrame().rows(list); };
  return of(list).meshes.get(layout, meshFrame().generation(list), all, diagnostics);
}

void SceneTables::see(std::span<scene::MeshView* const> views) {
  meshViews_.update(world_->scene(), meshFrame(), views);
}

MeshDraw SceneTables::draw(MeshPass& pass, text::Diagnostics& diagnostics) {
  if (!meshBuffers_.renew(world_->scene(), world_->sceneGeneration(), diagnostics)) return {};
  return pass.draw(meshBuffers_, diagnostics);
}

}  // namespace weft::imports
