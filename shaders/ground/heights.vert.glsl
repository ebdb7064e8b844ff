// Meshes seen from above, for ground/heights.frag.glsl. Slots: skeleton?  @joints
#include "common/view.glsl"
#include "scene/mesh_vertex.glsl"

out float height;  // world

void main() {
  vec4 world = meshTransform() * vec4(position, 1.0);
  height = world.y;
  gl_Position = view_projection * world;
}
