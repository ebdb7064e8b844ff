// A ball around everything in the scene, as a sun at the zenith would see it: the import `sun` with the direction [0, 1, 0].
// read  ball  `as uniform`
#ifndef SHADOW_BALL_GLSL
#define SHADOW_BALL_GLSL

#include "shadow/rows.glsl"

struct Ball {
  float texel;         // world units, of a map of this ball from any side
  mat4 shadow_matrix;  // world to u, v and depth, 0 to 1: seen from above
};
layout(std140) uniform ball { Ball ball_row[1]; };

// Its middle and radius.
vec4 ballAround() {
  vec4 x = ball_row[0].shadow_matrix[0], y = ball_row[0].shadow_matrix[1], z = ball_row[0].shadow_matrix[2];
  vec3 from_middle = 0.5 - ball_row[0].shadow_matrix[3].xyz;
  float per_unit = length(vec3(x.x, y.x, z.x));
  vec3 middle = vec3(dot(x.xyz, from_middle), dot(y.xyz, from_middle), dot(z.xyz, from_middle)) / (per_unit * per_unit);
  return vec4(middle, 0.5 / per_unit);
}

// A map of the ball, seen from the direction `towards` a light.
MapRows mapFrom(vec3 towards) {
  vec4 around = ballAround();
  vec3 side = normalize(abs(towards.y) < 0.9 ? vec3(towards.z, 0.0, -towards.x) : vec3(0.0, -towards.z, towards.y));
  float per_unit = 0.5 / around.w;
  vec3 u = side * per_unit, v = cross(towards, side) * per_unit, depth = towards * per_unit;
  return MapRows(vec4(u, 0.5 - dot(u, around.xyz)), vec4(v, 0.5 - dot(v, around.xyz)), vec4(depth, 0.5 - dot(depth, around.xyz)));
}

#endif
