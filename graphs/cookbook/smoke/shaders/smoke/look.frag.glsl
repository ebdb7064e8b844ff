// The smoke in a box of 1.33 x 2 x 1.33 around the origin, lit from the upper left; each step looks towards the light.
// read    flow     w: smoke
// write   result   encoded picture
#include "common/view.glsl"
#include "common/srgb.glsl"

uniform sampler3D flow;
layout(std140) uniform Parameters { float density; };
in vec2 uv;
out vec4 result;

const vec3 kHalf = vec3(2.0 / 3.0, 1.0, 2.0 / 3.0);

float smokeAt(vec3 p) { return density * textureLod(flow, 0.5 * p / kHalf + 0.5, 0.0).w; }

void main() {
  const vec3 light = normalize(vec3(-0.6, 1.0, 0.5));
  vec3 ray = normalize(viewRay(uv));
  vec3 a = (-kHalf - eye) / ray, b = (kHalf - eye) / ray;
  vec3 low = min(a, b), high = max(a, b);
  float near = max(max(low.x, max(low.y, low.z)), 0.0), far = min(high.x, min(high.y, high.z));

  vec3 radiance = vec3(0.0);
  float through = 1.0;
  const int kSteps = 48;
  float step = (far - near) / float(kSteps);
  for (int i = 0; i < kSteps && near < far && through > 0.01; ++i) {
    vec3 p = eye + ray * (near + step * (float(i) + 0.5));
    float here = smokeAt(p);
    if (here <= 0.0) continue;
    float shade = 0.0;
    for (int k = 0; k < 6; ++k) shade += 0.08 * smokeAt(p + light * (0.08 * float(k) + 0.04));
    float kept = exp(-here * step);
    radiance += through * (1.0 - kept) * (vec3(1.0, 0.94, 0.85) * exp(-shade) + vec3(0.08, 0.1, 0.14));
    through *= kept;
  }
  vec3 behind = mix(vec3(0.02, 0.025, 0.03), vec3(0.12, 0.16, 0.22), uv.y);
  result = vec4(encodeSrgb(clamp(radiance + through * behind, 0.0, 1.0)), 1.0);
}
