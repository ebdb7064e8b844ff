// What views see of the frame's meshes: rows in the order in which they are drawn, and the draw commands for them. All views of a
// frame are culled at once, as tasks (engine/scene/frame/tasks.h). Does not: place meshes (engine/scene/frame/mesh_frame.h), or
// know passes or GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "engine/scene/frame/cull.h"
#include "engine/scene/frame/mesh_frame.h"
#include "engine/scene/frame/tasks.h"
#include "engine/scene/sort.h"

namespace weft::scene {

// How the visible rows are ordered: those of a mesh together, or by the depth of their boxes' centres, farthest first, as
// what one sees through must be drawn. Equal depths by row.
enum class MeshOrder : std::uint8_t { by_mesh, back_to_front };

// One view of one draw list. Keeps its memory from frame to frame.
class MeshView {
 public:
  // What to look at, from the next update() on.
  void look(DrawList list, const glm::mat4& view, const glm::mat4& viewProjection, MeshOrder order);

  // Rows of the list, as MeshFrame::rows() has them.
  std::span<const std::uint32_t> visible() const { return visible_; }
  std::span<const DrawCommand> commands() const { return commands_; }
  // Moves when they were made anew; 0: never yet.
  std::uint64_t generation() const { return generation_; }

 private:
  friend class MeshViews;
  struct Wish {
    DrawList list = DrawList::opaque;
    glm::mat4 view{1}, viewProjection{1};
    MeshOrder order = MeshOrder::by_mesh;
    friend bool operator==(const Wish&, const Wish&) = default;
  };
  Wish wish_, made_;
  std::uint64_t rows_ = 0;  // generation of the list that it was made of
  std::uint64_t generation_ = 0;
  Frustum frustum_;
  std::vector<std::uint32_t> visible_, partCounts_;
  std::vector<SortElement> keys_, scratch_;
  std::vector<DrawCommand> commands_;
};

class MeshViews {
 public:
  MeshViews();
  // The same as MeshFrame::setThreads().
  void setThreads(int threads) { threads_ = threads; }
  // Brings the views up to date whose list or wish is another than they were made of.
  void update(const Scene& scene, const MeshFrame& frame, std::span<MeshView* const> views);
  const FrameTasks& tasks() const { return tasks_; }
  FrameTasks& tasks() { return tasks_; }

 private:
  // Rows of a view that are culled together.
  struct Part {
    std::uint32_t view = 0, part = 0;
  };
  // What the tasks work on in the present update(). Stands still when a MeshViews moves.
  struct Job {
    const Scene* scene = nullptr;
    const MeshFrame* frame = nullptr;
    std::vector<MeshView*> due;
    std::vector<Part> parts;
  };
  static std::vector<FrameTask> makeTasks(Job* job);
  static void cullPart(const Job& job, Part part);
  static void join(MeshView& view);
  static void makeKeys(const Job& job, MeshView& view);
  static void sort(MeshView& view);

  std::unique_ptr<Job> job_;
  FrameTasks tasks_;
  int threads_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace weft::scene
