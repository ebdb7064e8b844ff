#include "engine/scene/frame/mesh_views.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

void MeshView::see(const Scene& scene, const MeshFrame& frame, bool little) {
  const std::span<const Box> boxes = frame.bounds(wish_.list);
  const Frustum frustum = frustumOf(wish_.viewProjection);
  seen_.resize(boxes.size());
  forRanges(boxes.size(), little ? boxes.size() : kFewBoxes, [&](std::size_t from, std::size_t to) {
    for (std::size_t row = from; row < to; ++row) seen_[row] = reaches(frustum, boxes[row]) ? 1 : 0;
  });
  visible_.clear();
  visible_.reserve(boxes.size());
  for (std::uint32_t row = 0; row < boxes.size(); ++row)
    if (seen_[row] != 0) visible_.push_back(row);
  if (wish_.order != MeshOrder::by_mesh) sort(frame);
  makeCommands(scene, frame.rows(wish_.list), visible_, commands_);
}

void MeshView::sort(const MeshFrame& frame) {
  const std::span<const Box> boxes = frame.bounds(wish_.list);
  const std::span<const MeshRow> rows = frame.rows(wish_.list);
  const float sign = wish_.order == MeshOrder::back_to_front ? -1.0f : 1.0f;
  keys_.resize(visible_.size());
  forRanges(keys_.size(), kFewKeys, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const std::uint32_t row = visible_[i];
      keys_[i] = {wish_.order == MeshOrder::by_material
                      ? rows[row].material
                      : depthKey(sign * (wish_.view * glm::vec4(boxes[row].center(), 1)).z),
                  row};
    }
  });
  sortElements(keys_, scratch_);
  for (std::size_t i = 0; i < keys_.size(); ++i) visible_[i] = keys_[i].index;
}

void MeshView::update(const Scene& scene, const MeshFrame& frame, std::span<MeshView* const> views) {
  std::size_t work = 0;
  for (MeshView* view : views) {
    const std::uint64_t rows = std::exchange(view->rows_, frame.generation(view->wish_.list));
    view->due_ = view->generation_ == 0 || view->rows_ != rows || !(view->wish_ == view->made_);
    if (!view->due_) continue;
    view->made_ = view->wish_;
    ++view->generation_;
    work += frame.bounds(view->wish_.list).size();
  }
  const bool little = work < kLittleViewWork;
  forRanges(views.size(), little ? views.size() : 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i)
      if (views[i]->due_) views[i]->see(scene, frame, little);
  });
}

}  // namespace weft::scene
