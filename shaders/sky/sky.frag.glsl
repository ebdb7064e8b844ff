// The environment as seen by the view, behind everything.
// read    environment  equirectangular map; any sampler: the four texels are fetched and filtered here
// write   radiance     scene-referred, linear
#include "common/view.glsl"
#include "common/equirect.glsl"

uniform sampler2D environment;
in vec2 uv;
out vec4 radiance;

void main() {
  int level = min(int(equirectLevel(float(textureSize(environment, 0).x), lookupAngle())),
                  textureQueryLevels(environment) - 1);
  ivec2 size = textureSize(environment, level);
  vec2 p = equirectUv(viewRay(uv)) * vec2(size) - 0.5;
  vec2 base = floor(p);
  vec2 f = p - base;
  ivec2 a = ivec2(base), b = a + 1;
  a.x = a.x < 0 ? a.x + size.x : a.x;
  b.x = b.x >= size.x ? b.x - size.x : b.x;
  a.y = max(a.y, 0);
  b.y = min(b.y, size.y - 1);
  vec3 top = mix(texelFetch(environment, a, level).rgb, texelFetch(environment, ivec2(b.x, a.y), level).rgb, f.x);
  vec3 bottom = mix(texelFetch(environment, ivec2(a.x, b.y), level).rgb, texelFetch(environment, b, level).rgb, f.x);
  radiance = vec4(mix(top, bottom, f.y), 1.0);
}
