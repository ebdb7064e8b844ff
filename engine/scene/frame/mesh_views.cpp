#include "engine/scene/frame/mesh_views.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/frame/parallel.h"

namespace weft::scene {

namespace {

constexpr std::size_t kFewBoxes = 2048, kFewKeys = 8192;
constexpr std::size_t kLittleViewWork = 8192;  // rows of all views: below, threads cost more than they bring

}  // namespace

Frustum frustumOf(const glm::mat4& m) {
  const auto row = [&](int i) { return glm::vec4(m[0][i], m[1][i], m[2][i], m[3][i]); };
  const glm::vec4 x = row(0), y = row(1), z = row(2), w = row(3);
  Frustum frustum;
  for (const glm::vec4& plane : {w + x, w - x, w + y, w - y, z, w - z}) {
    const float length = glm::length(glm::vec3(plane));
    const float largest = std::max({std::abs(plane.x), std::abs(plane.y), std::abs(plane.z)});
    if (!(largest > 1e-7f * std::abs(plane.w))) continue;
    frustum.planes[frustum.count++] = plane / length;
  }
  return frustum;
}

bool reaches(const Frustum& frustum, const Box& box) {
  bool inside = !box.empty();
  for (int p = 0; p < frustum.count && inside; ++p) {
    const glm::vec4& plane = frustum.planes[p];
    const glm::vec3 farthest(plane.x >= 0 ? box.high.x : box.low.x, plane.y >= 0 ? box.high.y : box.low.y,
                             plane.z >= 0 ? box.high.z : box.low.z);
    const glm::vec3 terms = glm::vec3(plane) * farthest;
    const float rounding =
        4e-6f * (std::abs(terms.x) + std::abs(terms.y) + std::abs(terms.z) + std::abs(plane.w));
    inside = !(terms.x + terms.y + terms.z + plane.w < -rounding);
  }
  return inside;
}

void makeCommands(const Scene& scene, std::span<const MeshRow> rows, std::span<const std::uint32_t> visible,
                  std::vector<DrawCommand>& commands) {
  commands.clear();
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const std::uint32_t mesh = rows[visible[i]].mesh;
    if (i == 0 || rows[visible[i - 1]].mesh != mesh) {
      const Mesh& of = scene.meshes.rows()[mesh];
      commands.push_back({of.indexCount, 0, of.firstIndex, static_cast<std::int32_t>(of.firstVertex),
                          static_cast<std::uint32_t>(i)});
    }
    ++commands.back().instanceCount;
  }
}

void MeshView::look(DrawList list, const glm::mat4& view, const glm::mat4& viewProjection, MeshOrder order) {
  wish_ = {list, view, viewProjection, order};
}

void MeshViews::see(const Scene& scene, const MeshFrame& frame, MeshView& view, bool little) {
  const std::span<const Box> boxes = frame.bounds(view.wish_.list);
  const Frustum frustum = frustumOf(view.wish_.viewProjection);
  view.seen_.resize(boxes.size());
  forRanges(boxes.size(), little ? boxes.size() : kFewBoxes, [&](std::size_t from, std::size_t to) {
    for (std::size_t row = from; row < to; ++row) view.seen_[row] = reaches(frustum, boxes[row]) ? 1 : 0;
  });
  view.visible_.clear();
  view.visible_.reserve(boxes.size());
  for (std::uint32_t row = 0; row < boxes.size(); ++row)
    if (view.seen_[row] != 0) view.visible_.push_back(row);
  if (view.wish_.order != MeshOrder::by_mesh) sort(frame, view);
  makeCommands(scene, frame.rows(view.wish_.list), view.visible_, view.commands_);
}

void MeshViews::sort(const MeshFrame& frame, MeshView& view) {
  const std::span<const Box> boxes = frame.bounds(view.wish_.list);
  const std::span<const MeshRow> rows = frame.rows(view.wish_.list);
  const MeshOrder order = view.wish_.order;
  const float sign = order == MeshOrder::back_to_front ? -1.0f : 1.0f;
  view.keys_.resize(view.visible_.size());
  forRanges(view.keys_.size(), kFewKeys, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const std::uint32_t row = view.visible_[i];
      view.keys_[i] = {order == MeshOrder::by_material
                           ? rows[row].material
                           : depthKey(sign * (view.wish_.view * glm::vec4(boxes[row].center(), 1)).z),
                       row};
    }
  });
  sortElements(view.keys_, view.scratch_);
  for (std::size_t i = 0; i < view.keys_.size(); ++i) view.visible_[i] = view.keys_[i].index;
}

void MeshViews::update(const Scene& scene, const MeshFrame& frame, std::span<MeshView* const> views) {
  due_.clear();
  std::size_t work = 0;
  for (MeshView* view : views) {
    const std::uint64_t rows = frame.generation(view->wish_.list);
    if (view->generation_ != 0 && view->rows_ == rows && view->wish_ == view->made_) continue;
    view->rows_ = rows;
    view->made_ = view->wish_;
    view->generation_ = ++count_;
    due_.push_back(view);
    work += frame.bounds(view->wish_.list).size();
  }
  const bool little = work < kLittleViewWork;
  forRanges(due_.size(), little ? due_.size() : 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) see(scene, frame, *due_[i], little);
  });
}

}  // namespace weft::scene
