// An analytic clear sky with a sun and a plain ground, as an equirectangular map: the environment when none is loaded.
// Sky: Preetham, Shirley and Smits, "A practical analytic model for daylight", SIGGRAPH 1999 (luminance and chromaticity).
// Sun: its light after Rayleigh and aerosol extinction, in a lobe about three degrees wide with the right irradiance, so that a
// small map can hold it. Ground: Lambertian, lit by both.
// write   radiance   scene-referred, 20 kcd/m2 is 1: a white diffuse surface under a high sun is near 1 at exposure 0
// params  elevation  of the sun above the horizon, degrees; the model ends near 2
//         azimuth    of the sun, degrees from +X towards +Z
//         turbidity  2 (clear) to 8 (hazy)
#include "common/equirect.glsl"

layout(std140) uniform Parameters {
  float elevation;
  float azimuth;
  float turbidity;
};
in vec2 uv;
out vec4 radiance;

const float kUnit = 0.05;           // per kcd/m2
const float kSunLuminance = 128.0;  // klx above the atmosphere

// Luminance, x and y of the model at angle `theta` from the zenith and `gamma` from the sun, not normalised.
vec3 perez(float cos_theta, float gamma) {
  float t = turbidity;
  vec3 a = vec3(0.1787 * t - 1.4630, -0.0193 * t - 0.2592, -0.0167 * t - 0.2608);
  vec3 b = vec3(-0.3554 * t + 0.4275, -0.0665 * t + 0.0008, -0.0950 * t + 0.0092);
  vec3 c = vec3(-0.0227 * t + 5.3251, -0.0004 * t + 0.2125, -0.0079 * t + 0.2102);
  vec3 d = vec3(0.1206 * t - 2.5771, -0.0641 * t - 0.8989, -0.0441 * t - 1.6537);
  vec3 e = vec3(-0.0670 * t + 0.3703, -0.0033 * t + 0.0452, -0.0109 * t + 0.0529);
  float cos_gamma = cos(gamma);
  return (1.0 + a * exp(b / cos_theta)) * (1.0 + c * exp(d * gamma) + e * cos_gamma * cos_gamma);
}

vec3 zenith(float theta) {
  float t = turbidity, t2 = theta * theta, t3 = t2 * theta;
  float chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * theta);
  float luminance = (4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192;
  float x = (0.00166 * t3 - 0.00375 * t2 + 0.00209 * theta) * t * t +
            (-0.02903 * t3 + 0.06377 * t2 - 0.03202 * theta + 0.00394) * t +
            (0.11693 * t3 - 0.21196 * t2 + 0.06052 * theta + 0.25886);
  float y = (0.00275 * t3 - 0.00610 * t2 + 0.00317 * theta) * t * t +
            (-0.04214 * t3 + 0.08970 * t2 - 0.04153 * theta + 0.00516) * t +
            (0.15346 * t3 - 0.26756 * t2 + 0.06670 * theta + 0.26688);
  return vec3(max(luminance, 0.0), x, y);
}

vec3 fromYxy(vec3 c) {
  vec3 xyz = vec3(c.x * c.y / c.z, c.x, c.x * (1.0 - c.y - c.z) / c.z);
  return max(mat3(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570) * xyz, vec3(0.0));
}

void main() {
  // Row 0 of the map is the top.
  vec3 direction = equirectDirection(uv);
  float high = radians(elevation), theta_sun = 0.5 * kPi - high;
  vec3 sun = vec3(cos(high) * cos(radians(azimuth)), sin(high), cos(high) * sin(radians(azimuth)));

  float cos_gamma = clamp(dot(direction, sun), -1.0, 1.0), gamma = acos(cos_gamma);
  vec3 top = zenith(theta_sun), norm = perez(1.0, theta_sun);
  vec3 sky = kUnit * fromYxy(top * perez(max(direction.y, 0.01), gamma) / norm);

  // Optical depths of 680, 550 and 440 nm along the relative air mass of Kasten and Young 1989.
  float air_mass = 1.0 / (sin(high) + 0.50572 * pow(elevation + 6.07995, -1.6364));
  vec3 depth = vec3(0.041, 0.097, 0.243) + (0.046 * turbidity - 0.046) * vec3(0.76, 1.0, 1.34);
  vec3 sun_light = kUnit * kSunLuminance * exp(-depth * air_mass);
  const float kWidth2 = 0.022 * 0.022;  // radians squared; the lobe's integral is pi * kWidth2
  sky += sun_light * exp(-gamma * gamma / kWidth2) / (kPi * kWidth2) * step(gamma, 0.12);

  vec3 sky_light = kUnit * fromYxy(top) * kPi;
  vec3 ground = vec3(0.24, 0.21, 0.17) * (sun_light * sun.y + sky_light) / kPi;
  radiance = vec4(min(mix(ground, sky, smoothstep(-0.012, 0.006, direction.y)), vec3(60000.0)), 1.0);
}
