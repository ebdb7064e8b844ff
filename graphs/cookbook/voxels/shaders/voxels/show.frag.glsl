// The voxels themselves: from one to the next that the ray goes through (Amanatides and Woo 1987).
// read    light
// modify  radiance
#include "common/view.glsl"

uniform sampler3D light;
layout(std140) uniform Parameters { vec3 middle; float width; vec3 sunlight; };
#include "cube.glsl"
in vec2 uv;
out vec4 radiance;

void main() {
  vec3 ray = viewRay(uv), size = vec3(textureSize(light, 0));
  vec3 at = inCube(eye) * size, step = ray / width * size;
  step = mix(step, vec3(1e-6), lessThan(abs(step), vec3(1e-6)));
  vec3 a = -at / step, b = (size - at) / step, low = min(a, b), high = max(a, b);
  float t = max(max(low.x, max(low.y, low.z)), 0.0) + 1e-4, end = min(high.x, min(high.y, high.z));
  while (t < end) {
    vec3 cell = floor(at + t * step);
    vec4 here = texelFetch(light, clamp(ivec3(cell), ivec3(0), ivec3(size) - 1), 0);
    if (here.a > 0.0) {
      radiance = vec4(here.rgb + 0.02, 1.0);
      return;
    }
    vec3 leave = (cell + vec3(greaterThan(step, vec3(0.0))) - at) / step;
    t = min(leave.x, min(leave.y, leave.z)) + 1e-4;
  }
  discard;
}
