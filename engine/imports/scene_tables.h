// The scene on the CPU and on the device at the time of a frame: the rows of the draw lists, as tables and as what to draw,
// made on first use and renewed when the scene changed or moves. Shared by every provider of a device.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/gl/programs/program.h"
#include "engine/imports/material_textures.h"
#include "engine/imports/row_table.h"
#include "engine/imports/world.h"
#include "engine/scene/frame/mesh_frame.h"
#include "engine/scene/frame/mesh_views.h"
#include "engine/scene/scene.h"
#include "engine/text/diagnostic.h"

namespace weft::imports {

// Meshes on the device: the vertices and indices of all of a scene, once, and of each draw pass what its view sees of a list,
// as commands for one glMultiDrawElementsIndirect.
struct MeshBuffers {
  std::shared_ptr<const scene::MeshData> data;
  std::uint64_t serial = 0;            // another one when the buffers are others
  gl::Buffer vertices, skin, indices;  // without a skin: no mesh has one
};

// `commands`: DrawCommand[count] in a buffer of their own. Count 0: nothing is seen.
struct MeshDraw {
  GLuint vertexArray = 0, commands = 0;
  GLsizei count = 0;
};

// The meshes of one draw pass: where its program wants the attributes, and what it draws. What its view sees is brought up to
// date from outside, with that of other passes.
class MeshPass {
 public:
  // The names of vertex attributes: position, normal, tangent, uv, joints, weights; and `instance`, the row.
  MeshPass(const gl::Reflection& reflection, std::string label);

  scene::MeshView& view() { return view_; }
  // Draws what its view sees now.
  MeshDraw draw(const MeshBuffers& buffers, text::Diagnostics& diagnostics);

 private:
  void attach(const MeshBuffers& buffers);

  std::string label_;
  std::vector<gl::VertexAttribute> vertex_, skin_, instance_;
  gl::VertexArray vertexArray_;
  gl::Buffer visibleRows_, commandBuffer_;
  std::uint64_t serial_ = 0;  // of the buffers that are attached
  GLuint attachedRows_ = 0;
  scene::MeshView view_;
  std::uint64_t sent_ = 0;  // generation of the view that the buffers hold
};

// The columns of a list's spheres, and of its meshes.
Columns<scene::Instance> sphereColumns();
Columns<scene::MeshRow> meshColumns();

class SceneTables {
 public:
  SceneTables();
  // Both must live until the next call.
  void beginFrame(const World& world, const FrameInput& input, std::uint64_t number);

  // The number of a list for the functions below: of one of the scene's, or of a graph's own, which is kept from then on. Those that no
  // graph names any more mostly hold what another list does, and share its rows.
  scene::DrawList listOf(const scene::Selection& selection);
  const scene::Selection& selectionOf(scene::DrawList list) { return of(list).selection; }

  // The spheres of a draw list.
  BufferRef spheres(scene::DrawList list, const RowLayout& layout, text::Diagnostics& diagnostics);
  const std::vector<scene::Instance>& rows(scene::DrawList list);
  std::uint32_t countOf(scene::DrawList list) { return factsOf(list).count; }
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
  // One draw list. What is asked of it several times a frame is kept; looking at every sphere each time would cost with a million.
  struct List {
    scene::Selection selection;
    RowTable<scene::Instance> spheres;
    RowTable<scene::MeshRow> meshes;
    std::uint64_t scene = 0;  // generation of which the next two are
    std::uint32_t count = 0;  // spheres
    bool moving = false;
    std::vector<scene::Instance> rows;
    std::uint64_t generation = 0;  // of the rows
  };
  void add(const scene::Selection& selection, const std::string& label);
  List& of(scene::DrawList list) { return lists_[static_cast<std::size_t>(list)]; }
  const List& factsOf(scene::DrawList list);

  const World* world_ = nullptr;
  const FrameInput* input_ = nullptr;
  std::uint64_t number_ = 0;
  std::pair<double, double> moment_{0, -1};  // time and step, on which all that moves depends
  std::uint64_t moments_ = 0;
  std::deque<List> lists_;                // by number
  std::vector<scene::Selection> chosen_;  // those behind the scene's
  scene::MeshFrame meshFrame_;
  std::uint64_t meshFrameNumber_ = 0;
  MeshBuffers meshBuffers_;  // of the scene that draw() saw last
  MaterialTextures textures_;
};

}  // namespace weft::imports
