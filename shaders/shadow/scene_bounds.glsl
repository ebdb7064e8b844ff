// The bounding sphere of the scene, from the shadow map of a sun at the zenith: the import `sun` with the direction [0, 1, 0].
// read    scene_bounds   `as uniform`
#ifndef SHADOW_SCENE_BOUNDS_GLSL
#define SHADOW_SCENE_BOUNDS_GLSL

#include "shadow/rows.glsl"

struct SceneBounds {
  float texel;         // world units, of a map of this sphere from any side
  mat4 shadow_matrix;  // world to u, v and depth, 0 to 1: seen from above
};
layout(std140) uniform scene_bounds { SceneBounds bounds_row[1]; };

// xyz: its center; w: its radius.
vec4 boundingSphere() {
  vec4 x = bounds_row[0].shadow_matrix[0], y = bounds_row[0].shadow_matrix[1], z = bounds_row[0].shadow_matrix[2];
  vec3 from_center = 0.5 - bounds_row[0].shadow_matrix[3].xyz;
  float per_unit = length(vec3(x.x, y.x, z.x));
  vec3 center = vec3(dot(x.xyz, from_center), dot(y.xyz, from_center), dot(z.xyz, from_center)) / (per_unit * per_unit);
  return vec4(center, 0.5 / per_unit);
}

// A map of the sphere, seen from the direction `towards` a light.
MapRows mapFrom(vec3 towards) {
  vec4 bounds = boundingSphere();
  vec3 side = normalize(abs(towards.y) < 0.9 ? vec3(towards.z, 0.0, -towards.x) : vec3(0.0, -towards.z, towards.y));
  float per_unit = 0.5 / bounds.w;
  vec3 u = side * per_unit, v = cross(towards, side) * per_unit, depth = towards * per_unit;
  return MapRows(vec4(u, 0.5 - dot(u, bounds.xyz)), vec4(v, 0.5 - dot(v, bounds.xyz)), vec4(depth, 0.5 - dot(depth, bounds.xyz)));
}

#endif
