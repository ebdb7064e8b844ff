// Shows a light probe as a white sphere lit by it.
// read    probes      see gi/probes.glsl
//         irradiance  of the environment, `as linear wrap`
// modify  radiance    scene-referred; alpha 1
//         velocity?   screen UV per frame
//         depth?      near / distance along the view axis (reversed-Z)
// params  gain        factor of what is shown
//         sky_turn    rotation of the environment, in full turns
#include "common/equirect.glsl"
#include "common/view.glsl"
#include "gi/bounce.glsl"
#include "gi/debug.glsl"

in vec3 outwards;
flat in vec3 center;
in vec4 before;

uniform sampler2D irradiance;
out vec4 radiance;
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

vec3 ambient(vec3 direction) {
  return sampleEquirect(irradiance, equirectUv(direction) - vec2(sky_turn, 0.0), vec2(0.0, 0.5 / float(textureSize(irradiance, 0).y))).rgb;
}

void main() {
  vec3 coefficients[9];
  float left = probeAt(center, coefficients);
  Bounce bounce = bounceOf(coefficients, left, normalize(outwards));
  radiance = vec4(gain * bounced(bounce, ambient(bounce.facing), ambient(-bounce.facing)), 1.0);
#ifdef HAS_VELOCITY
  velocity = gl_FragCoord.xy / viewport - (before.xy / max(before.w, 1e-3) * 0.5 + 0.5);
#endif
}
