// Meshes into a shadow map, seen from the pass's view. Slots: skeleton?  @joints
#include "common/view.glsl"
#include "scene/mesh_vertex.glsl"

in vec2 uv;

out vec2 map_uv;
flat out uint row;  // of @materials

void main() {
  map_uv = uv;
  row = mesh_row[instance].material;
  gl_Position = view_projection * (meshTransform() * vec4(position, 1.0));
}
