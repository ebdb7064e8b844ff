// Meshes into a shadow map, seen from the pass's view or a bright spot, see shadow/from_spot.glsl. Slots: skeleton?  @joints,
// morph_targets?  @morph_targets, morph_weights?  @morph_weights, vertex_colors?  @vertex_colors
#include "scene/mesh_vertex.glsl"
#include "shadow/from_spot.glsl"

in vec2 uv;

out vec2 map_uv;
flat out uint row;  // of @materials
#ifdef HAS_THING_IN_FRONT
flat out uint thing;
#endif
#ifdef HAS_VERTEX_COLORS
out float own_alpha;
#endif

void main() {
  map_uv = uv;
#ifdef HAS_VERTEX_COLORS
  own_alpha = vertex_color[gl_VertexID].color.a;
#endif
  row = mesh_row[instance].material;
#ifdef HAS_THING_IN_FRONT
  thing = instance + 1u;
#endif
  gl_Position = lightClip((meshTransform() * meshPosition()).xyz);
}
