// The environment behind everything.
// read    sky        equirectangular with mips, `as linear wrap`
// write   radiance   scene-referred, linear; alpha 1
//         velocity   screen UV per frame of a point at infinity
#include "common/view.glsl"
#include "common/equirect.glsl"

uniform sampler2D sky;
in vec2 uv;
#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

void main() {
  vec3 direction = viewRay(uv);
#ifdef HAS_RADIANCE
  // Constant over the picture, and 0 as long as the map is magnified.
  vec2 size = vec2(textureSize(sky, 0));
  radiance = vec4(sampleEquirect(sky, direction, equirectLevel(size.x, pixelAngle()), size.y).rgb, 1.0);
#endif
#ifdef HAS_VELOCITY
  velocity = skyVelocity(uv, direction);
#endif
}
