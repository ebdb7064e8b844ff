// Color grading in two halves, before and after the tone curve. Neutral: saturation 1, contrast 1; lift 0, gamma 1, gain 1.
#ifndef COMPOSITE_GRADING_GLSL
#define COMPOSITE_GRADING_GLSL

// Scene-referred, exposed, >= 0. Contrast is a power about middle gray 0.18; saturation mixes with the luminance.
vec3 gradeScene(vec3 color, float saturation, float contrast) {
  color = 0.18 * pow(color / 0.18, vec3(contrast));
  return max(mix(vec3(dot(color, vec3(0.2126, 0.7152, 0.0722))), color, saturation), vec3(0.0));
}

// Display-referred, linear light 0..1. Lift moves black and keeps white, gain scales, a gamma above 1 brightens the midtones.
vec3 gradeDisplay(vec3 color, vec3 lift, vec3 gamma, vec3 gain) {
  return pow(max(gain * (color + lift * (1.0 - color)), vec3(0.0)), 1.0 / gamma);
}

#endif
