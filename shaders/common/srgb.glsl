// sRGB transfer function, IEC 61966-2-1; input 0..1.
#ifndef COMMON_SRGB_GLSL
#define COMMON_SRGB_GLSL

vec3 encodeSrgb(vec3 linear) {
  vec3 curved = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(linear * 12.92, curved, greaterThan(linear, vec3(0.0031308)));
}

#endif
