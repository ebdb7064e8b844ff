// Where each map lies. Splits: equation 7 of Zhang and others 2006. A map holds a ball around its part of the view: so its
// size does not change when the eye turns, and it moves by whole texels, so that shadows do not crawl.
// read    sun       as of @sun
// write   windows   Window[]
#include "common/view.glsl"
#include "scene/sun.glsl"
#include "window.glsl"
layout(local_size_x = 8) in;

layout(std430) writeonly buffer windows { Window window[]; };
layout(std140) uniform Parameters { float reach; float split; bool all; int texels; int maps; };

float endOf(float i) {
  float share = i / float(maps), n = near_plane;
  return mix(n + (reach - n) * share, n * pow(reach / n, share), split);
}

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= maps) return;
  Sun light = sun_light[0];
  float per_unit = length(vec3(light.shadow_matrix[0].x, light.shadow_matrix[1].x, light.shadow_matrix[2].x));

  // The ball through the corners of a frustum from n to f whose half diagonal at distance 1 is k.
  float n = endOf(float(i)), f = endOf(float(i + 1));
  float k2 = 1.0 / (projection[0].x * projection[0].x) + 1.0 / (projection[1].y * projection[1].y);
  float middle = min(0.5 * (n + f) * (1.0 + k2), f), radius = sqrt((f - middle) * (f - middle) + f * f * k2);
  vec3 center = eye - transpose(mat3(view))[2] * middle;

  // A filter reads two texels beyond.
  float size = 2.0 * radius * per_unit * float(texels) / float(texels - 6), texel = size / float(texels);
  vec2 corner = floor(((light.shadow_matrix * vec4(center, 1.0)).xy - 0.5 * size) / texel) * texel;
  if (all) corner = vec2(0.0), size = 1.0, texel = 1.0 / float(texels);
  window[i] = Window(corner, size, f, texel / per_unit, float[3](0.0, 0.0, 0.0));
}
