#include "common/view.glsl"
#include "scene/mesh_vertex.glsl"

flat out uint row;

void main() {
  row = mesh_row[instance].material;
  gl_Position = view_projection * (meshTransform() * vec4(position, 1.0));
}
