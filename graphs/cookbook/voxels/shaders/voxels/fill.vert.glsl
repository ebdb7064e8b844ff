// A mesh, seen along one of the axes of the cube.
#include "scene/mesh_vertex.glsl"

in vec3 normal;
in vec2 uv;
layout(std140) uniform Parameters { vec3 middle; float width; vec3 sunlight; int axis; };
#include "cube.glsl"
out vec3 world, world_normal;
out vec2 map_uv;
flat out uint row;

void main() {
  mat4 transform = meshTransform();
  world = (transform * meshPosition()).xyz;
  world_normal = meshNormal(transform, normal + morphed(false).normal);
  map_uv = uv;
  row = mesh_row[instance].material;
  vec3 p = 2.0 * inCube(world) - 1.0;
  gl_Position = vec4(axis == 0 ? p.yz : axis == 1 ? p.zx : p.xy, 0.5, 1.0);
}
