#include "engine/imports/scene_tables.h"

#include <algorithm>

namespace weft::imports {

void SceneTables::beginFrame(const World& world, const FrameInput& input, std::uint64_t number) {
  world_ = &world;
  input_ = &input;
  number_ = number;
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
  return factsOf(list).moving ? still + number_ : still;
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

BufferRef SceneTables::table(scene::DrawList list, const InstanceLayout& layout,
                             base::Diagnostics& diagnostics) {
  Table* table = nullptr;
  for (auto& each : tables_)
    if (each->list == list && each->layout == layout) table = each.get();
  if (!table) {
    tables_.push_back(std::make_unique<Table>());
    table = tables_.back().get();
    table->list = list;
    table->layout = layout;
  }
  const std::uint64_t wanted = generation(list);
  if (table->generation != wanted) {
    writeInstances(layout, rows(list), bytes_);
    if (bytes_.empty()) bytes_.assign(std::max(layout.stride, 16u), std::byte{0});
    if (!table->buffer || table->buffer.bytes() != bytes_.size()) {
      auto buffer = gl::Buffer::create(bytes_.size(), GL_DYNAMIC_STORAGE_BIT,
                                       scene::drawListNames()[static_cast<std::size_t>(list)], diagnostics);
      if (!buffer) return {};
      table->buffer = std::move(*buffer);
    }
    gl::uploadBuffer(table->buffer.id(), 0, bytes_);
    table->generation = wanted;
  }
  return {table->buffer.id(), table->buffer.bytes()};
}

}  // namespace weft::imports
