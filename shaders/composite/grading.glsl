// Color grading in two halves, one on either side of the tone curve. Neutral: 1, 1 and lift 0, gamma 1, gain 1.
#ifndef COMPOSITE_GRADING_GLSL
#define COMPOSITE_GRADING_GLSL

// Scene-referred, exposed, >= 0. Contrast is a power about middle gray 0.18; saturation mixes with the luminance.
vec3 gradeScene(vec3 color, float saturation, float contrast) {
  color = 0.18 * pow(color / 0.18, vec3(contrast));
  return max(mix(vec3(dot(color, vec3(0.2126, 0.7152, 0.0722))), color, saturation), vec3(0.0));
}

// Display-referred, linear light 0..1. Lift moves black and leaves white, gain scales, gamma above 1 brightens the middle.
vec3 gradeDisplay(vec3 color, vec3 lift, vec3 gamma, vec3 gain) {
  return pow(max(gain * (color + lift * (1.0 - color)), vec3(0.0)), 1.0 / gamma);
}

#endif
