// Sky and ground.
// write   result   encoded picture
#include "common/srgb.glsl"
#include "common/view.glsl"
#include "light.glsl"

in vec2 uv;
out vec4 result;

void main() {
  vec3 ray = viewRay(uv);
  vec3 color = skyAt(normalize(ray));
  if (ray.y < 0.0) {
    float way = -eye.y / ray.y * length(ray);
    color = mix(skyAt(normalize(ray * vec3(1.0, 0.0, 1.0))), vec3(0.36, 0.34, 0.3), exp(-0.012 * way));
  }
  result = vec4(encodeSrgb(clamp(color, 0.0, 1.0)), 1.0);
}
