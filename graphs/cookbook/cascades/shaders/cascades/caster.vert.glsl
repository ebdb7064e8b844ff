// Meshes into one of the maps.
// read    windows   Window[], see cascades/window.glsl
#include "scene/mesh_vertex.glsl"
#include "scene/sun.glsl"
#include "window.glsl"

layout(std430) readonly buffer windows { Window window[]; };
layout(std140) uniform Parameters { int map; };
in vec2 uv;
out vec2 map_uv;
flat out uint row;
#ifdef HAS_VERTEX_COLORS
out float own_alpha;
#endif

void main() {
  map_uv = uv;
#ifdef HAS_VERTEX_COLORS
  own_alpha = vertex_color[gl_VertexID].color.a;
#endif
  row = mesh_row[instance].material;
  vec3 at = (sun_light[0].shadow_matrix * (meshTransform() * meshPosition())).xyz;
  gl_Position = vec4((at.xy - window[map].corner) / window[map].size * 2.0 - 1.0, at.z, 1.0);
}
