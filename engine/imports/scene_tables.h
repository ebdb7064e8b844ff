// The scene on the CPU and on the device at the time of a frame: the rows of the draw lists, as tables and as what to draw,
// made on first use and renewed when the scene changed or moves. Shared by every provider of a device.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/graph/registry.h"
#include "engine/imports/material_textures.h"
#include "engine/imports/mesh_draws.h"
#include "engine/imports/row_table.h"
#include "engine/imports/world.h"
#include "engine/scene/frame/mesh_frame.h"
#include "engine/scene/frame/mesh_views.h"
#include "engine/scene/scene.h"
#include "engine/text/diagnostic.h"

namespace weft::imports {

// The columns of a list's spheres, and of its meshes.
Columns<scene::Instance> sphereColumns();
Columns<scene::MeshRow> meshColumns();

class SceneTables {
 public:
  SceneTables();
  // Both must live until the next call.
  void beginFrame(const World& world, const FrameInput& input, std::uint64_t number);

  // The spheres of a draw list.
  BufferRef spheres(scene::DrawList list, const RowLayout& layout, text::Diagnostics& diagnostics);
  const std::vector<scene::Instance>& rows(scene::DrawList list);
  std::uint32_t countOf(scene::DrawList list);
  // Moves when a row may be another.
  std::uint64_t generation(scene::DrawList list);
  // False before the first frame.
  bool isMoving(scene::DrawList list) { return world_ && factsOf(list).moving; }

  // Its meshes.
  BufferRef meshes(scene::DrawList list, const RowLayout& layout, text::Diagnostics& diagnostics);
  // Finds out what the views of these passes see of meshes, of all at once. Before draw() of any of them.
  void see(std::span<scene::MeshView* const> views);
  // What the view of `pass` saw in the last see().
  MeshDraw draw(MeshPass& pass, text::Diagnostics& diagnostics);
  const scene::MeshFrame& meshFrame();

  MaterialTextures& textures() { return textures_; }

 private:
  // What is asked of a draw list several times a frame; looking at every sphere each time would cost with a million.
  struct ListFacts {
    std::uint64_t scene = 0;  // generation
    std::uint32_t count = 0;
    bool moving = false;
  };
  struct Rows {
    std::vector<scene::Instance> rows;
    std::uint64_t generation = 0;
  };
  const ListFacts& factsOf(scene::DrawList list);

  const World* world_ = nullptr;
  const FrameInput* input_ = nullptr;
  std::uint64_t number_ = 0;
  std::pair<double, double> moment_{0, -1};  // time and step, on which all that moves depends
  std::uint64_t moments_ = 0;
  ListFacts facts_[scene::kDrawListCount];
  Rows rows_[scene::kDrawListCount];
  std::vector<RowTable<scene::Instance>> sphereTables_;  // per draw list
  std::vector<RowTable<scene::MeshRow>> meshTables_;
  scene::MeshFrame meshFrame_;
  std::uint64_t meshFrameNumber_ = 0;
  scene::MeshViews meshViews_;
  MeshBuffers meshBuffers_;
  MaterialTextures textures_;
};

}  // namespace weft::imports
