// A ball around everything in the scene, as a sun at the zenith would see it: the import `sun` with the direction [0, 1, 0].
// read  ball
#ifndef SHADOW_BALL_GLSL
#define SHADOW_BALL_GLSL

struct Ball {
  float texel;         // world units, of a map of this ball from any side
  mat4 shadow_matrix;  // world to u, v and depth, 0 to 1: seen from above
};
layout(std430) readonly buffer ball { Ball ball_row[]; };

// Its middle and radius.
vec4 ballAround() {
  mat4 above = ball_row[0].shadow_matrix;
  float per_unit = length(vec3(above[0].x, above[1].x, above[2].x));
  return vec4(transpose(mat3(above)) * (0.5 - above[3].xyz) / (per_unit * per_unit), 0.5 / per_unit);
}

// World to u, v and depth of a map of the ball, seen from the direction `towards` a light.
mat4 mapFrom(vec3 towards) {
  vec4 around = ballAround();
  vec3 middle = around.xyz;
  vec3 side = normalize(abs(towards.y) < 0.9 ? vec3(towards.z, 0.0, -towards.x) : vec3(0.0, -towards.z, towards.y));
  mat3 axes = mat3(side, cross(towards, side), towards) * (0.5 / around.w);
  return transpose(mat4(vec4(axes[0], 0.5 - dot(axes[0], middle)), vec4(axes[1], 0.5 - dot(axes[1], middle)),
                        vec4(axes[2], 0.5 - dot(axes[2], middle)), vec4(0.0, 0.0, 0.0, 1.0)));
}

#endif
