// The environment behind everything.
// read    sky        equirectangular with mips, `as linear wrap`
//         blurred?   the same, prefiltered for roughness in its levels (ibl/prefilter): instead of it
// write   radiance   scene-referred, linear; alpha 1
//         velocity   screen UV per frame of a point at infinity
// params  sky_turn?  by how much of a full turn the environment is rotated, from +X towards +Z
//         blur?      level of `blurred`
// FADE    mixes sky_before or blurred_before (1 - fade) and the above (parameter fade)
#include "common/view.glsl"
#include "common/equirect.glsl"

#ifndef FADE
#define FADE 0
#endif
#ifdef HAS_BLURRED
uniform sampler2D blurred;
#if FADE
uniform sampler2D blurred_before;
#endif
#else
uniform sampler2D sky;
#if FADE
uniform sampler2D sky_before;
#endif
#endif
#if defined HAS_SKY_TURN || defined HAS_BLUR || FADE
layout(std140) uniform Parameters {
#ifdef HAS_SKY_TURN
  float sky_turn;
#endif
#ifdef HAS_BLUR
  float blur;
#endif
#if FADE
  float fade;
#endif
};
#endif
#ifndef HAS_SKY_TURN
const float sky_turn = 0.0;
#endif
#ifndef HAS_BLUR
const float blur = 0.0;
#endif
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
  vec2 at = equirectUv(direction) - vec2(sky_turn, 0.0);
  // The level is constant over the picture, and 0 as long as the map is magnified.
#ifdef HAS_BLURRED
  vec2 size = vec2(textureSize(blurred, 0));
  float level = max(equirectLevel(size.x, pixelAngle()), blur);
  radiance = vec4(sampleEquirect(blurred, at, level, size.y).rgb, 1.0);
#if FADE
  radiance.rgb = mix(sampleEquirect(blurred_before, at, level, size.y).rgb, radiance.rgb, fade);
#endif
#else
  vec2 size = vec2(textureSize(sky, 0));
  radiance = vec4(sampleEquirect(sky, at, equirectLevel(size.x, pixelAngle()), size.y).rgb, 1.0);
#if FADE
  size = vec2(textureSize(sky_before, 0));
  radiance.rgb = mix(sampleEquirect(sky_before, at, equirectLevel(size.x, pixelAngle()), size.y).rgb, radiance.rgb, fade);
#endif
#endif
#endif
#ifdef HAS_VELOCITY
  velocity = skyVelocity(uv, direction);
#endif
}
