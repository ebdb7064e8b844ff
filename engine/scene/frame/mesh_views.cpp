#include "engine/scene/frame/mesh_views.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/frame/parallel.h"

namespace weft::scene {

namespace {

constexpr std::uint32_t kPart = 2048;  // rows that are culled together
constexpr std::size_t kFewKeys = 8192;
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

std::size_t cull(const Frustum& frustum, std::span<const Box> boxes, std::size_t from, std::size_t to,
                 std::uint32_t* visible) {
  std::size_t count = 0;
  for (std::size_t i = from; i < to; ++i) {
    const Box& box = boxes[i];
    if (box.empty()) continue;
    bool outside = false;
    for (int p = 0; p < frustum.count && !outside; ++p) {
      const glm::vec4& plane = frustum.planes[p];
      const glm::vec3 farthest(plane.x >= 0 ? box.high.x : box.low.x, plane.y >= 0 ? box.high.y : box.low.y,
                               plane.z >= 0 ? box.high.z : box.low.z);
      const glm::vec3 terms = glm::vec3(plane) * farthest;
      const float rounding =
          4e-6f * (std::abs(terms.x) + std::abs(terms.y) + std::abs(terms.z) + std::abs(plane.w));
      outside = terms.x + terms.y + terms.z + plane.w < -rounding;
    }
    if (!outside) visible[count++] = static_cast<std::uint32_t>(i);
  }
  return count;
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

void MeshViews::cullPart(const MeshFrame& frame, Part part) {
  MeshView& view = *due_[part.view];
  const std::span<const Box> boxes = frame.bounds(view.wish_.list);
  const std::size_t from = std::size_t{part.part} * kPart, to = std::min(from + kPart, boxes.size());
  view.partCounts_[part.part] =
      static_cast<std::uint32_t>(cull(view.frustum_, boxes, from, to, view.visible_.data() + from));
}

// Moves together what the parts found, each at its own place.
void MeshViews::join(MeshView& view) {
  std::size_t count = 0;
  for (std::size_t part = 0; part < view.partCounts_.size(); ++part) {
    const auto from = view.visible_.begin() + static_cast<std::ptrdiff_t>(part * kPart);
    std::copy(from, from + view.partCounts_[part],
              view.visible_.begin() + static_cast<std::ptrdiff_t>(count));
    count += view.partCounts_[part];
  }
  view.visible_.resize(count);
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
  parts_.clear();
  std::size_t work = 0;
  for (MeshView* view : views) {
    const std::uint64_t rows = frame.generation(view->wish_.list);
    if (view->generation_ != 0 && view->rows_ == rows && view->wish_ == view->made_) continue;
    const std::size_t count = frame.bounds(view->wish_.list).size();
    view->rows_ = rows;
    view->made_ = view->wish_;
    view->frustum_ = frustumOf(view->wish_.viewProjection);
    view->visible_.resize(count);
    view->partCounts_.assign((count + kPart - 1) / kPart, 0);
    view->generation_ = ++count_;
    for (std::uint32_t part = 0; part < view->partCounts_.size(); ++part)
      parts_.push_back({static_cast<std::uint32_t>(due_.size()), part});
    due_.push_back(view);
    work += count;
  }
  if (due_.empty()) return;
  const bool little = work < kLittleViewWork;
  forRanges(parts_.size(), little ? parts_.size() : 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) cullPart(frame, parts_[i]);
  });
  forRanges(due_.size(), little ? due_.size() : 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      MeshView& view = *due_[i];
      join(view);
      if (view.wish_.order != MeshOrder::by_mesh) sort(frame, view);
      makeCommands(scene, frame.rows(view.wish_.list), view.visible_, view.commands_);
    }
  });
}

}  // namespace weft::scene
