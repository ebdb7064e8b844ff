// The environment as background: in a "fullscreen" pass, or a draw of one "triangle".
// read    sky        equirectangular with mips, `as linear wrap`; texels wider than a pixel are smoothed, see common/equirect.glsl,
//                    unless alpha is 0 in level 0
//         blurred?   the same, prefiltered for roughness in its levels (ibl/prefilter), from roughness 0.1 on instead of it
//         brightest? the spots that `blurred` lacks, see ibl/brightest.glsl
//         disc?      the sun that `sky` and `blurred` lack, see sky/daylight.comp.glsl; instead of `brightest`
//         air?       see fog/sky.glsl
//         enlarged?  what WIDE drew, see skybox.vert.glsl, `as linear`: taken instead of looking up, and nothing is drawn where FINE draws
// write   radiance   scene-referred, linear; alpha 1
//         velocity   screen UV per frame of a point at infinity
// params  sky_turn?  rotation of the environment, in full turns, from +X towards +Z
//         blur?      four times the roughness of a mirror that would blur it so; up to 0.4 a mix with `sky`
#include "fog/sky.glsl"
#include "maps.glsl"

noperspective in vec3 direction;
noperspective in vec2 uv;
#ifdef HAS_ENLARGED
noperspective in vec2 enlarged_uv;
#endif
#ifdef HAS_VELOCITY
noperspective in vec3 before;
#endif
flat in vec2 sky_lookup;
flat in vec3 sky_smooth;
#ifdef HAS_BLURRED
flat in vec2 blurred_lookup;
flat in vec3 blurred_smooth;
flat in float blurred_share;
#ifdef HAS_BRIGHTEST
flat in vec3 spots_blur;
#endif
#endif
#ifdef HAS_DISC
flat in vec3 sun;
flat in vec2 disc_edge;
flat in vec3 disc_radiance;
#endif
#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

void main() {
#ifdef HAS_RADIANCE
#ifdef HAS_ENLARGED
  vec3 color = textureLod(enlarged, enlarged_uv, 0.0).rgb;
#else
  vec2 at = equirectUv(direction) - vec2(sky_turn, 0.0);
  vec3 color = sampleEquirectSmooth(sky, at, sky_lookup, sky_smooth.xy, sky_smooth.z).rgb;
#ifdef HAS_BLURRED
  color = mix(color, sampleEquirectSmooth(blurred, at, blurred_lookup, blurred_smooth.xy, blurred_smooth.z).rgb, blurred_share);
#endif
#endif
#if defined HAS_BLURRED && defined HAS_BRIGHTEST
#ifdef HAS_DISC
  const int lobes = 1;
#else
  int lobes = spot_count;
#endif
  for (int i = 0; i < lobes; ++i) {
#ifdef HAS_DISC
    vec3 towards = sun;
    vec4 light = vec4(disc_light.rgb, spots_blur.z);
#else
    vec3 towards = towardsSpot(i, sky_turn);
    vec4 light = spots[i].light;
#endif
    float cosine = dot(normalize(direction), towards);
    SpotShape shape = spotShape(spots_blur.x, 0.25 * light.w);
    color += light.rgb * (spots_blur.y * spotDistribution(shape, 0.5 - 0.5 * cosine, 1.0, max(cosine, 0.0), 1.0));
  }
#endif
#ifdef HAS_DISC
  float along = max(dot(direction, sun), 1e-6);
  float inside = smoothstep(0.0, 1.0, disc_edge.x - disc_edge.y * length(direction - along * sun) / along);
  color += disc_radiance * (inside * clamp(0.5 + disc_edge.y * direction.y / along, 0.0, 1.0));  // the earth hides what is below the horizon
#endif
#ifdef HAS_AIR
  color = mix(fog_light.rgb, color, throughFogOfSky(direction));
#endif
  radiance = vec4(color, 1.0);
#endif
#ifdef HAS_VELOCITY
  velocity = uv - (before.xy / max(before.z, 1e-3) * 0.5 + 0.5);
#endif
}
