// The sky of daylight.comp.glsl without its sun.
// params  elevation, azimuth, turbidity   see there
#ifndef SKY_DAYLIGHT_GLSL
#define SKY_DAYLIGHT_GLSL

#include "common/equirect.glsl"

const float kUnit = 0.06;           // per kcd/m2
const float kSunLuminance = 128.0;  // klx above the atmosphere

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

struct Daylight {
  vec3 to_sun;
  vec3 sun_light;  // irradiance of the sun on a surface that faces it
  vec3 ground;     // radiance
  vec2 scale;      // what perez() is multiplied by
};

Daylight daylight() {
  float high = radians(elevation), theta_sun = 0.5 * kPi - high;
  vec3 to_sun = vec3(cos(high) * cos(radians(azimuth)), sin(high), cos(high) * sin(radians(azimuth)));
  vec2 top = zenith(theta_sun), scale = top / perez(1.0, theta_sun, to_sun.y);

  // Optical depths of 680, 550 and 440 nm along the relative air mass of Kasten and Young 1989.
  float air_mass = 1.0 / (sin(high) + 0.50572 * pow(elevation + 6.07995, -1.6364));
  vec3 depth = vec3(0.041, 0.097, 0.243) + (0.046 * turbidity - 0.046) * vec3(0.76, 1.0, 1.34);
  vec3 sun_light = kUnit * kSunLuminance * exp(-depth * air_mass);
  vec3 sky_light = kUnit * colorOf(top) * kPi;
  vec3 ground = vec3(0.24, 0.21, 0.17) * (sun_light * to_sun.y + sky_light) / kPi;
  return Daylight(to_sun, sun_light, ground, scale);
}

// Of sky and ground in a direction, at the angle `gamma` from the sun.
vec3 radianceOf(Daylight day, vec3 direction, float gamma, float cos_gamma) {
  vec3 sky = kUnit * colorOf(day.scale * perez(max(direction.y, 0.01), gamma, cos_gamma));
  return mix(day.ground, sky, exp(min(direction.y, 0.0) / (0.01 + 0.01 * turbidity)));
}

#endif
