// An analytic clear sky with a sun and a plain ground, as an equirectangular map: the environment when none is loaded.
// Sky: Preetham, Shirley and Smits, "A practical analytic model for daylight", SIGGRAPH 1999 (luminance and its x).
// Sun: its light after Rayleigh and aerosol extinction, in a lobe a few degrees wide with the right irradiance, so that a
// small map can hold it; sky/skybox draws the disc, and shadows are as soft as one of 0.533 degrees. Ground: Lambertian, lit by both;
// towards the horizon it fades into the sky above, as far as the air is hazy.
// Each thread makes the 2 x 2 texels of level 0 that are one of level 1, and that one.
// read    scene_sun?   `as uniform`, a row of @sun, which lights by itself: then the sky is that of this sun, without a lobe
// write   radiance, radiance_1   levels 0 and 1, rgba16f; scene-referred, 17 kcd/m2 is 1: a white diffuse surface under a high sun is near
//                                1 at exposure 0; alpha 0 in level 0, for a sky that is smooth between its texels
//         rest, rest_1           the same without the sun
//         brightest              see ibl/brightest.glsl: the lobe
//         disc                   two vec4: direction and radius of the sun that is seen, radians; its irradiance on a surface that faces it
// params  elevation  of the sun above the horizon, degrees; the model ends near 2
//         azimuth    of the sun, degrees from +X towards +Z
//         turbidity  2 (clear) to 8 (hazy)
//         gain       what the sky's light is multiplied by, but not the sun's
#include "common/equirect_direction.glsl"
#include "ibl/spot.glsl"

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
#ifdef HAS_SCENE_SUN
#include "scene/sun_row.glsl"
layout(std140) uniform scene_sun { Sun scene_row[1]; };
#endif
#ifdef HAS_BRIGHTEST
layout(std430) writeonly buffer brightest {
  Spot spots[kSpots];
  int spot_count;
  float sun_radius;
};
#endif
#ifdef HAS_DISC
layout(std430) writeonly buffer disc {
  vec4 disc_at;
  vec4 disc_light;
};
#endif
layout(std140) uniform Parameters {
  float elevation;
  float azimuth;
  float turbidity;
  float gain;
};

const float kUnit = 0.06;           // per kcd/m2
const float kSunLuminance = 128.0;  // klx above the atmosphere
const float kSunRadius = radians(0.2665);

// Luminance and x of the model at the angle theta from the zenith and `gamma` from the sun, not normalized.
vec2 perez(float cos_theta, float gamma, float cos_gamma) {
  float t = turbidity;
  vec2 a = vec2(0.1787 * t - 1.4630, -0.0193 * t - 0.2592);
  vec2 b = vec2(-0.3554 * t + 0.4275, -0.0665 * t + 0.0008);
  vec2 c = vec2(-0.0227 * t + 5.3251, -0.0004 * t + 0.2125);
  vec2 d = vec2(0.1206 * t - 2.5771, -0.0641 * t - 0.8989);
  vec2 e = vec2(-0.0670 * t + 0.3703, -0.0033 * t + 0.0452);
  return (1.0 + a * exp(b / cos_theta)) * (1.0 + c * exp(d * gamma) + e * cos_gamma * cos_gamma);
}

vec2 zenith(float theta) {
  float t = turbidity, t2 = theta * theta, t3 = t2 * theta;
  float chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * theta);
  float luminance = (4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192;
  float x = (0.00166 * t3 - 0.00375 * t2 + 0.00209 * theta) * t * t +
            (-0.02903 * t3 + 0.06377 * t2 - 0.03202 * theta + 0.00394) * t +
            (0.11693 * t3 - 0.21196 * t2 + 0.06052 * theta + 0.25886);
  return vec2(max(luminance, 0.0), x);
}

// The model's own y turns purple at the horizon; y is taken from the CIE daylight locus (Judd et al. 1964) instead.
vec3 colorOf(vec2 luminance_x) {
  float luminance = luminance_x.x, x = luminance_x.y, y = (2.870 - 3.000 * x) * x - 0.275;
  vec3 xyz = vec3(x, y, 1.0 - x - y) * (luminance / y);
  return max(mat3(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570) * xyz, vec3(0.0));
}

const float kWidth2 = 0.035 * 0.035;  // of the sun's lobe, radians squared; its integral is pi times this

// At so many radians above the horizon, and from +X towards +Z.
vec3 towards(float height, float along) { return vec3(cos(height) * cos(along), sin(height), cos(height) * sin(along)); }

float luminanceOf(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }
float most(vec3 color) { return max(color.r, max(color.g, color.b)); }

void main() {
  ivec2 corner = 2 * ivec2(gl_GlobalInvocationID.xy);
#ifdef HAS_SCENE_SUN
  Sun sun = scene_row[0];
  float height = asin(clamp(sun.direction.y, -1.0, 1.0)), along = atan(sun.direction.z, sun.direction.x + 1e-9);
#else
  float height = radians(elevation), along = radians(azimuth);
#endif
  float high = max(height, radians(2.0)), theta_sun = 0.5 * kPi - high;
  vec3 to_sun = towards(high, along);
  vec2 top = zenith(theta_sun), scale = top / perez(1.0, theta_sun, to_sun.y);

  // Optical depths of 680, 550 and 440 nm along the relative air mass of Kasten and Young 1989.
  float air_mass = 1.0 / (sin(high) + 0.50572 * pow(degrees(high) + 6.07995, -1.6364));
  vec3 depth = vec3(0.041, 0.097, 0.243) + (0.046 * turbidity - 0.046) * vec3(0.76, 1.0, 1.34);
  vec3 sun_light = kUnit * kSunLuminance * exp(-depth * air_mass);
#ifdef HAS_SCENE_SUN
  // A sun brighter than 100 klx, as it is in units of less light, brightens its sky as well. Below the horizon half as much is left for every
  // 0.8 degrees: where civil twilight ends, at -6, a two-hundredth of what there is at 0.
  float unit = gain * kUnit * clamp(luminanceOf(sun.irradiance) / (100.0 * kUnit), 1.0, 2e4) * exp2(1.27 * min(degrees(height), 0.0));
  sun_light = sun.irradiance;
  vec3 peak = vec3(0.0);
  float radius = asin(sqrt(max(1.0 - sun.cos_angle * sun.cos_angle, 0.0)));
#else
  float unit = gain * kUnit;
  vec3 peak = sun_light / (kPi * kWidth2);
  float radius = kSunRadius;
#endif
  vec3 sky_light = unit * colorOf(top) * kPi;
  vec3 ground = vec3(0.24, 0.21, 0.17) * (sun_light * max(sin(height), 0.0) + sky_light) / kPi;
  float haze = 0.01 + 0.01 * turbidity;

  vec3 sum = vec3(0.0), sum_rest = vec3(0.0);
  float weights = 0.0;
#ifdef HAS_REST
  ivec2 size = imageSize(rest);  // nobody reads `radiance` where only the background is drawn
#else
  ivec2 size = imageSize(radiance);
#endif
  int texels = size.x > 1 ? 4 : 1;  // not a constant: unrolled, the loop takes longer to translate
  for (int i = 0; i < texels; ++i) {
    // Row 0 of the map is the top. Texels outside are not stored.
    ivec2 texel = corner + ivec2(i & 1, i >> 1);
    vec3 direction = equirectDirection((vec2(texel) + 0.5) / vec2(size));
    float cos_gamma = clamp(dot(direction, to_sun), -1.0, 1.0), gamma = acos(cos_gamma);
    vec3 sky = unit * colorOf(scale * perez(max(direction.y, 0.01), gamma, cos_gamma));
    vec3 lobe = peak * exp(-gamma * gamma / kWidth2) * step(gamma, 0.15) * smoothstep(-0.011, 0.007, direction.y);
    vec3 without = mix(ground, sky, exp(min(direction.y, 0.0) / haze)), color = without + lobe;
    imageStore(radiance, texel, vec4(color, 0.0));
    float weight = length(direction.xz);  // of its share of the sphere
    weights += weight;
    sum += weight * color;
#ifdef HAS_REST
    imageStore(rest, texel, vec4(without, 0.0));
    sum_rest += weight * without;
#endif
  }
#ifdef HAS_RADIANCE_1
  imageStore(radiance_1, corner / 2, vec4(sum / weights, 1.0));
#endif
#ifdef HAS_REST_1
  imageStore(rest_1, corner / 2, vec4(sum_rest / weights, 1.0));
#endif

  if (corner != ivec2(0)) return;
#ifdef HAS_BRIGHTEST
  for (int i = 0; i < kSpots; ++i) spots[i] = kNoSpot;
  spot_count = 0;
#ifndef HAS_SCENE_SUN
  // The horizon hides what is below it of a Gaussian: the rest of its light, where that is on average, and how wide.
  float x = (high + 0.003) / sqrt(kWidth2);
  float seen = 1.0 / (1.0 + exp(-x * (2.257 + 0.2018 * x * x))), lean = exp(-x * x) / (sqrt(2.0 * kPi) * seen);
  vec3 up = normalize(vec3(0.0, 1.0, 0.0) - to_sun.y * to_sun + vec3(1e-6, 0.0, 0.0));
  // Lookups of the map that leave the sun out are cut a little above the sky around it.
  vec3 around = unit * colorOf(scale * perez(max(to_sun.y, 0.01), 0.0, 1.0));
  spots[0].at = vec4(normalize(to_sun + up * (sqrt(0.5 * kWidth2) * lean)), 1.25 * most(around));
  spots[0].light = vec4(sun_light * seen, 0.5 * kWidth2 * (1.0 - 0.5 * lean * (sqrt(2.0) * x + lean)));
  spot_count = 1;
#endif
  sun_radius = radius;
#endif
#ifdef HAS_DISC
  // A high sun is brighter than half floats are: it is drawn larger instead, up to 0.68 degrees.
  disc_at = vec4(towards(height, along), max(radius, sqrt(most(sun_light) / (kPi * 64000.0))));
  disc_light = vec4(sun_light, 0.0);
#endif
}
