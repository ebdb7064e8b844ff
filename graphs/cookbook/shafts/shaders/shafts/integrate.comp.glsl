// Through the cells from the eye on: what arrives of the light of all haze up to the end of each, and what is left of the light behind.
// read    haze   rgb: radiance, a: extinction, per meter
// write   seen   rgb: radiance, a: transmittance
#include "common/view.glsl"
#include "cells.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler3D haze;
layout(rgba16f) uniform writeonly image3D seen;
layout(std140) uniform Parameters { float far; };

void main() {
  ivec2 column = ivec2(gl_GlobalInvocationID.xy);
  ivec3 size = textureSize(haze, 0);
  if (any(greaterThanEqual(column, size.xy))) return;
  float slant = length(viewRay((vec2(column) + 0.5) / vec2(size.xy)));
  vec3 light = vec3(0.0);
  float left = 1.0;
  for (int k = 0; k < size.z; ++k) {
    vec4 here = texelFetch(haze, ivec3(column, k), 0);
    float way = slant * far * (layerStart(float(k) + 1.0, float(size.z)) - layerStart(float(k), float(size.z)));
    float kept = exp(-here.a * way);
    light += left * here.rgb * (here.a > 1e-6 ? (1.0 - kept) / here.a : way);
    left *= kept;
    imageStore(seen, ivec3(column, k), vec4(light, left));
  }
}
