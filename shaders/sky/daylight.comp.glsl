// An analytic clear sky with a sun and a plain ground, as an equirectangular map: the environment when none is loaded.
// Sky: Preetham, Shirley and Smits, "A practical analytic model for daylight", SIGGRAPH 1999 (luminance and its x).
// Sun: its light after Rayleigh and aerosol extinction, in a lobe a few degrees wide with the right irradiance, so that a
// small map can hold it. Ground: Lambertian, lit by both.
// write   radiance   rgba16f; scene-referred, 17 kcd/m2 is 1: a white diffuse surface under a high sun is near 1 at exposure 0
// params  elevation  of the sun above the horizon, degrees; the model ends near 2
//         azimuth    of the sun, degrees from +X towards +Z
//         turbidity  2 (clear) to 8 (hazy)
#include "common/equirect_direction.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) uniform writeonly image2D radiance;
layout(std140) uniform Parameters {
  float elevation;
  float azimuth;
  float turbidity;
};

const float kUnit = 0.06;           // per kcd/m2
const float kSunLuminance = 128.0;  // klx above the atmosphere

// Luminance and x of the model at angle `theta` from the zenith and `gamma` from the sun, not normalised.
vec2 perez(float cos_theta, float gamma) {
  float t = turbidity;
  vec2 a = vec2(0.1787 * t - 1.4630, -0.0193 * t - 0.2592);
  vec2 b = vec2(-0.3554 * t + 0.4275, -0.0665 * t + 0.0008);
  vec2 c = vec2(-0.0227 * t + 5.3251, -0.0004 * t + 0.2125);
  vec2 d = vec2(0.1206 * t - 2.5771, -0.0641 * t - 0.8989);
  vec2 e = vec2(-0.0670 * t + 0.3703, -0.0033 * t + 0.0452);
  float cos_gamma = cos(gamma);
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

void main() {
  // Row 0 of the map is the top. What lies outside is not stored.
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  vec3 direction = equirectDirection((vec2(at) + 0.5) / vec2(imageSize(radiance)));
  float high = radians(elevation), theta_sun = 0.5 * kPi - high;
  vec3 sun = vec3(cos(high) * cos(radians(azimuth)), sin(high), cos(high) * sin(radians(azimuth)));

  float cos_gamma = clamp(dot(direction, sun), -1.0, 1.0), gamma = acos(cos_gamma);
  vec2 top = zenith(theta_sun), norm = perez(1.0, theta_sun);
  vec3 sky = kUnit * colorOf(top * perez(max(direction.y, 0.01), gamma) / norm);

  // Optical depths of 680, 550 and 440 nm along the relative air mass of Kasten and Young 1989.
  float air_mass = 1.0 / (sin(high) + 0.50572 * pow(elevation + 6.07995, -1.6364));
  vec3 depth = vec3(0.041, 0.097, 0.243) + (0.046 * turbidity - 0.046) * vec3(0.76, 1.0, 1.34);
  vec3 sun_light = kUnit * kSunLuminance * exp(-depth * air_mass);
  const float kWidth2 = 0.035 * 0.035;  // radians squared; the lobe's integral is pi * kWidth2
  sky += sun_light * exp(-gamma * gamma / kWidth2) / (kPi * kWidth2) * step(gamma, 0.15);

  vec3 sky_light = kUnit * colorOf(top) * kPi;
  vec3 ground = vec3(0.24, 0.21, 0.17) * (sun_light * sun.y + sky_light) / kPi;
  imageStore(radiance, at, vec4(min(mix(ground, sky, smoothstep(-0.012, 0.006, direction.y)), vec3(60000.0)), 1.0));
}
