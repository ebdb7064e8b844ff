#include "engine/scene/frame/cull.h"

#include <algorithm>
#include <cmath>

namespace weft::scene {

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

void cull(const Frustum& frustum, std::span<const Box> boxes, std::vector<std::uint32_t>& visible) {
  visible.resize(boxes.size());
  visible.resize(cullRows(frustum, boxes, 0, boxes.size(), visible.data()));
}

std::size_t cullRows(const Frustum& frustum, std::span<const Box> boxes, std::size_t from, std::size_t to,
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

}  // namespace weft::scene
