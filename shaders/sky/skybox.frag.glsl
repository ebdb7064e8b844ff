// The environment behind everything. A draw of one "triangle".
// read    sky        equirectangular with mips, `as linear wrap`
//         blurred?   the same, prefiltered for roughness in its levels (ibl/prefilter), from level 1 on instead of it
// write   radiance   scene-referred, linear; alpha 1
//         velocity   screen UV per frame of a point at infinity
// params  sky_turn?  by how much of a full turn the environment is rotated, from +X towards +Z
//         blur?      level of `blurred`; between 0 and 1 a mixture with `sky`
#include "maps.glsl"

noperspective in vec3 direction;
noperspective in vec2 uv;
#ifdef HAS_VELOCITY
noperspective in vec3 before;
#endif
flat in vec2 sky_lookup;
#ifdef HAS_BLURRED
flat in vec2 blurred_lookup;
#endif
#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

void main() {
#ifdef HAS_RADIANCE
  vec2 at = equirectUv(direction) - vec2(sky_turn, 0.0);
  vec3 color = sampleEquirect(sky, at, sky_lookup).rgb;
#ifdef HAS_BLURRED
  color = mix(color, sampleEquirect(blurred, at, blurred_lookup).rgb, min(blur, 1.0));
#endif
  radiance = vec4(color, 1.0);
#endif
#ifdef HAS_VELOCITY
  velocity = uv - (before.xy / max(before.z, 1e-3) * 0.5 + 0.5);
#endif
}
