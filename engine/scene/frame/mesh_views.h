// What views see of the frame's meshes: rows in the order in which they are drawn, and their draw commands, for all views at once.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/scene/frame/mesh_frame.h"
#include "engine/scene/sort.h"

namespace weft::scene {

// The inside of each plane is dot(xyz, p) + w >= 0; xyz is unit.
struct Frustum {
  glm::vec4 planes[6];
  int count = 0;
};
// Gribb and Hartmann, "Fast Extraction of Viewing Frustum Planes", 2001, for clip depth 0..1, reversed or not. A plane
// without a normal (the far plane at infinity) is left out.
Frustum frustumOf(const glm::mat4& viewProjection);

// Whether a box may reach into the frustum. True for all that do: also for boxes on a plane within rounding. Empty ones do not.
bool reaches(const Frustum& frustum, const Box& box);

// A command as glMultiDrawElementsIndirect reads it.
struct DrawCommand {
  std::uint32_t count = 0, instanceCount = 0, firstIndex = 0;
  std::int32_t baseVertex = 0;
  std::uint32_t baseInstance = 0;
  friend bool operator==(const DrawCommand&, const DrawCommand&) = default;
};
// Replaces `commands` by one per mesh that is visible: instances baseInstance to baseInstance + instanceCount - 1 of it are
// those elements of `visible`.
void makeCommands(const Scene& scene, std::span<const MeshRow> rows, std::span<const std::uint32_t> visible,
                  std::vector<DrawCommand>& commands);

// One view of one draw list. Keeps its memory from frame to frame.
class MeshView {
 public:
  // Brings those of the views up to date whose list or wish is another than they were made of.
  static void update(const Scene& scene, const MeshFrame& frame, std::span<MeshView* const> views);

  // What to look at, from the next update() on.
  void look(DrawList list, const glm::mat4& view, const glm::mat4& viewProjection, MeshOrder order) {
    wish_ = {list, view, viewProjection, order};
  }

  // Rows of the list, as MeshFrame::rows() has them.
  std::span<const std::uint32_t> visible() const { return visible_; }
  std::span<const DrawCommand> commands() const { return commands_; }
  // Moves when they were made anew; 0: never yet.
  std::uint64_t generation() const { return generation_; }

 private:
  struct Wish {
    DrawList list = DrawList::opaque;
    glm::mat4 view{1}, viewProjection{1};
    MeshOrder order = MeshOrder::by_mesh;
    friend bool operator==(const Wish&, const Wish&) = default;
  };
  void see(const Scene& scene, const MeshFrame& frame, bool little);
  void sort(const MeshFrame& frame);

  Wish wish_, made_;
  bool due_ = false;        // in the present update()
  std::uint64_t rows_ = 0;  // generation of the list that it was made of
  std::uint64_t generation_ = 0;
  std::vector<std::uint8_t> seen_;  // by row of the list
  std::vector<std::uint32_t> visible_;
  std::vector<SortElement> keys_, scratch_;
  std::vector<DrawCommand> commands_;
};

}  // namespace weft::scene
