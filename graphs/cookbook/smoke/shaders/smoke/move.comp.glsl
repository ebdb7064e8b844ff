// Velocity and smoke after a step, before the pressure: carried along by the velocity, pushed up where there is smoke, and
// turned where the flow turns. Cells per second; a step is at most a thirtieth of a second.
// read    before   xyz: velocity, w: smoke (0..1)
// write   moved    the same
#include "common/view.glsl"
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform sampler3D before;
layout(rgba16f) uniform writeonly image3D moved;
layout(std140) uniform Parameters { float rise; float swirl; float dissipate; };

vec3 velocityAt(ivec3 cell) { return texelFetch(before, clamp(cell, ivec3(0), textureSize(before, 0) - 1), 0).xyz; }

vec3 curlAt(ivec3 cell) {
  vec3 x = velocityAt(cell + ivec3(1, 0, 0)) - velocityAt(cell - ivec3(1, 0, 0));
  vec3 y = velocityAt(cell + ivec3(0, 1, 0)) - velocityAt(cell - ivec3(0, 1, 0));
  vec3 z = velocityAt(cell + ivec3(0, 0, 1)) - velocityAt(cell - ivec3(0, 0, 1));
  return 0.5 * vec3(y.z - z.y, z.x - x.z, x.y - y.x);
}

void main() {
  ivec3 cell = ivec3(gl_GlobalInvocationID), size = textureSize(before, 0);
  if (any(greaterThanEqual(cell, size))) return;
  float step = delta_time > 0.0 ? min(delta_time, 1.0 / 30.0) : 1.0 / 60.0;
  vec3 from = vec3(cell) + 0.5 - step * velocityAt(cell);
  vec4 here = textureLod(before, from / vec3(size), 0.0);

  vec3 curl = curlAt(cell);
  vec3 towards = vec3(length(curlAt(cell + ivec3(1, 0, 0))) - length(curlAt(cell - ivec3(1, 0, 0))),
                      length(curlAt(cell + ivec3(0, 1, 0))) - length(curlAt(cell - ivec3(0, 1, 0))),
                      length(curlAt(cell + ivec3(0, 0, 1))) - length(curlAt(cell - ivec3(0, 0, 1))));
  if (dot(towards, towards) > 1e-6) here.xyz += step * swirl * 8.0 * cross(normalize(towards), curl);
  here.y += step * rise * 40.0 * here.w;
  here.w *= exp(-dissipate * step);

  // The hot spot, which wanders a little.
  vec3 spot = vec3(size) * vec3(0.5, 0.1, 0.5) + 2.0 * vec3(sin(1.7 * time), 0.0, cos(2.3 * time));
  float near = smoothstep(6.0, 3.0, distance(vec3(cell), spot));
  here.w = max(here.w, near);
  imageStore(moved, cell, here);
}
