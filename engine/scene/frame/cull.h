// Frustum culling of boxes, and the draw commands of what is left. Does not: cull by occlusion or size, or know GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/scene/frame/mesh_frame.h"
#include "engine/scene/scene.h"

namespace weft::scene {

// The inside of each plane is dot(xyz, p) + w >= 0; xyz is unit.
struct Frustum {
  glm::vec4 planes[6];
  int count = 0;
};
// Gribb and Hartmann, "Fast Extraction of Viewing Frustum Planes", 2001, for clip depth 0..1, reversed or not. A plane
// without a normal (the far plane at infinity) is left out.
Frustum frustumOf(const glm::mat4& viewProjection);

// Replaces `visible` by the ascending rows whose box may reach into the frustum. Never leaves out a box that does: boxes
// on a plane within rounding stay. Empty boxes are left out.
void cull(const Frustum& frustum, std::span<const Box> boxes, std::vector<std::uint32_t>& visible);
// The same for the rows `from` to `to`: writes what may be seen to `visible`, which has room for all, and returns how many.
std::size_t cullRows(const Frustum& frustum, std::span<const Box> boxes, std::size_t from, std::size_t to,
                     std::uint32_t* visible);

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

}  // namespace weft::scene
