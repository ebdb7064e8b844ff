// A vertex of a mesh, for the fragment shaders that include meshes/surface.glsl. Slots: skeleton?  @joints,
// morph_targets?  @morph_targets, morph_weights?  @morph_weights, vertex_colors?  @vertex_colors, second_uvs?  @second_uvs,
// materials?  @materials
#include "common/view.glsl"
#ifdef HAS_MATERIALS
#include "scene/materials.glsl"
#endif
#include "scene/mesh_vertex.glsl"

in vec3 normal;
in vec4 tangent;
in vec2 uv;

invariant gl_Position;  // some meshes are drawn twice
out vec3 world_position;
out vec3 world_normal;
out vec4 world_tangent;   // w: sign of the bitangent
out vec2 map_uv;
#ifdef HAS_SECOND_UVS
out vec2 map_uv_2;
#endif
out vec4 previous_clip;
flat out uint row;        // of @materials; the next two are of that row
flat out uint normal_map;
flat out float normal_scale;
#ifdef HAS_THING
flat out uint mesh_thing;
#endif
#ifdef HAS_VERTEX_COLORS
out vec4 own_color;       // linear
#endif
#ifdef HAS_BEHIND
flat out float world_scale;  // world units in a unit of the mesh
#endif

void main() {
  mat4 transform = meshTransform();
  MorphTarget moves = morphed(false);
  vec4 world = transform * meshPosition();
  world_position = world.xyz;
  world_normal = meshNormal(transform, normal + moves.normal);
  world_tangent = vec4(mat3(transform) * (tangent.xyz + moves.tangent), tangent.w);
  map_uv = uv;
#ifdef HAS_SECOND_UVS
  map_uv_2 = second_uv[gl_VertexID].uv;
#endif
#ifdef HAS_VERTEX_COLORS
  own_color = vertex_color[gl_VertexID].color;
#endif
#ifdef HAS_BEHIND
  world_scale = pow(abs(determinant(mat3(transform))), 1.0 / 3.0);
#endif
  row = mesh_row[instance].material;
#ifdef HAS_THING
  mesh_thing = instance + 1u;
#endif
#ifdef HAS_MATERIALS
  normal_map = material[row].normal_map;
  normal_scale = material[row].normal_scale;
#else
  normal_map = 0xffffffffu;
  normal_scale = 1.0;
#endif
  previous_clip = previous_view_projection * (meshPreviousTransform() * meshPreviousPosition());
  gl_Position = view_projection * world;
}
