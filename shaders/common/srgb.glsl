// sRGB transfer function, IEC 61966-2-1; input 0..1. Above the linear part, 1.055 x^(1/2.4) - 0.055 is fitted by square roots.
// They cost a third of a power, and the error is at most 1e-4, a fortieth of a step of 255.
#ifndef COMMON_SRGB_GLSL
#define COMMON_SRGB_GLSL

vec3 encodeSrgb(vec3 linear) {
  vec3 root = sqrt(linear);
  vec3 curved = root * (0.912702622 + 0.0356437523 * linear) + 0.254492535 * sqrt(root) - 0.132228313 * linear - 0.0705104454;
  return mix(linear * 12.92, curved, greaterThan(linear, vec3(0.0031308)));
}

#endif
