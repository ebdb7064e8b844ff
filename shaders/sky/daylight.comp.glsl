// An analytic clear sky with a sun and a plain ground, as an equirectangular map: the environment when none is loaded.
// Sky: Preetham, Shirley and Smits, "A practical analytic model for daylight", SIGGRAPH 1999 (luminance and its x).
// Sun: its light after Rayleigh and aerosol extinction, in a lobe a few degrees wide with the right irradiance, so that a
// small map can hold it; sky/sun.glsl draws the disc that is seen. Ground: Lambertian, lit by both; towards the horizon it fades into the sky above, as far as the air is hazy.
// Each thread makes the 2 x 2 texels of level 0 that are one of level 1, and that one.
// write   radiance, radiance_1   levels 0 and 1, rgba16f; scene-referred, 17 kcd/m2 is 1: a white diffuse surface under a high sun is near
//                                1 at exposure 0
//         rest, rest_1           the same without the sun
//         sun                    two vec4, `brightest` of ibl/brightest.glsl
// params  elevation  of the sun above the horizon, degrees; the model ends near 2
//         azimuth    of the sun, degrees from +X towards +Z
//         turbidity  2 (clear) to 8 (hazy)
#include "common/equirect_direction.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) uniform writeonly image2D radiance;
#ifdef HAS_RADIANCE_1
layout(rgba16f) uniform writeonly image2D radiance_1;
#endif
#ifdef HAS_REST
layout(rgba16f) uniform writeonly image2D rest;
#endif
#ifdef HAS_REST_1
layout(rgba16f) uniform writeonly image2D rest_1;
#endif
#ifdef HAS_SUN
layout(std430) writeonly buffer sun {
  vec4 at;
  vec4 light;
};
#endif
layout(std140) uniform Parameters {
  float elevation;
  float azimuth;
  float turbidity;
};

#include "daylight.glsl"

const float kWidth2 = 0.035 * 0.035;  // of the sun's lobe, radians squared; its integral is pi times this

float most(vec3 color) { return max(color.r, max(color.g, color.b)); }

void main() {
  ivec2 corner = 2 * ivec2(gl_GlobalInvocationID.xy);
  Daylight day = daylight();
  vec3 to_sun = day.to_sun, sun_light = day.sun_light, peak = sun_light / (kPi * kWidth2);

#if defined HAS_REST || defined HAS_SUN
  // Light above this belongs to the sun. Near 16 times the mean luminance, as in ibl/brightest.comp, while the sun is not low in haze.
  vec3 around = kUnit * colorOf(day.scale * perez(max(to_sun.y, 0.01), 0.0, 1.0));
  float limit = max(most(peak) * (0.005906 + 0.0000673 * elevation), 2.0 * most(around));
#endif

  vec3 sum = vec3(0.0), sum_rest = vec3(0.0);
  int texels = imageSize(radiance).x > 1 ? 4 : 1;  // not a constant: unrolled, the loop takes longer to translate
  for (int i = 0; i < texels; ++i) {
    // Row 0 of the map is the top. Texels outside are not stored.
    ivec2 texel = corner + ivec2(i & 1, i >> 1);
    vec3 direction = equirectDirection((vec2(texel) + 0.5) / vec2(imageSize(radiance)));
    float cos_gamma = clamp(dot(direction, to_sun), -1.0, 1.0), gamma = acos(cos_gamma);
    vec3 lobe = peak * exp(-gamma * gamma / kWidth2) * step(gamma, 0.15) * smoothstep(-0.011, 0.007, direction.y);
    vec3 color = min(radianceOf(day, direction, gamma, cos_gamma) + lobe, vec3(60000.0));
    imageStore(radiance, texel, vec4(color, 1.0));
    sum += color;
#ifdef HAS_REST
    color *= min(limit / most(color), 1.0);
    imageStore(rest, texel, vec4(color, 1.0));
    sum_rest += color;
#endif
  }
#ifdef HAS_RADIANCE_1
  imageStore(radiance_1, corner / 2, vec4(0.25 * sum, 1.0));
#endif
#ifdef HAS_REST_1
  imageStore(rest_1, corner / 2, vec4(0.25 * sum_rest, 1.0));
#endif

#ifdef HAS_SUN
  if (corner != ivec2(0)) return;
  // Sky and lobe, around + peak g with g = exp(-gamma^2 / kWidth2), cut in proportion where their largest channel is above the limit: for g
  // from `least` to 1. Integrals over gamma^2 in closed form, in units of kWidth2.
  float highest = most(peak), base = most(around), above = limit - base;
  float least = clamp(above / highest, 0.0, 1.0), reach = -log(max(least, 1e-6));
  float lobe = 1.0 - least - reach * above / highest;
  float moment = 1.0 - (1.0 + reach) * least - 0.5 * reach * reach * above / highest;
  float share_of_sky = reach - limit / base * log(limit / (max(least, 1e-6) * (base + highest)));
  // The horizon hides what is below it of a Gaussian: the rest of its light, where that is on average, and how wide.
  float x = (radians(elevation) + 0.003) / sqrt(kWidth2);
  float seen = 1.0 / (1.0 + exp(-x * (2.257 + 0.2018 * x * x))), lean = exp(-x * x) / (sqrt(2.0 * kPi) * seen);
  vec3 up = normalize(vec3(0.0, 1.0, 0.0) - to_sun.y * to_sun + vec3(1e-6, 0.0, 0.0));
  at = vec4(normalize(to_sun + up * (sqrt(0.5 * kWidth2) * lean)), limit);
  light = vec4(kPi * kWidth2 * seen * (peak * lobe + (around - peak * (base / highest)) * share_of_sky),
               0.5 * kWidth2 * moment / max(lobe, 1e-6) * (1.0 - 0.5 * lean * (sqrt(2.0) * x + lean)));
#endif
}
