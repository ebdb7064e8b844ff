// Meshes seen from above, for ground/heights.frag.glsl. Slots: skeleton?  @joints, morph_targets?  @morph_targets,
// morph_weights?  @morph_weights
#include "common/view.glsl"
#include "scene/mesh_vertex.glsl"

out float height;  // world

void main() {
  vec4 world = meshTransform() * meshPosition();
  height = world.y;
  gl_Position = view_projection * world;
}
