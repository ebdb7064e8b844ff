// How many lamps a pixel goes through, as a color: blue 1, green 8, red 64 and more; nearly black 0.
// define  SHOW_LAMPS   1: shaders that include this show it instead of light
#ifndef SHADING_SHOW_LAMPS_GLSL
#define SHADING_SHOW_LAMPS_GLSL

#ifndef SHOW_LAMPS
#define SHOW_LAMPS 0
#endif

#if SHOW_LAMPS
vec3 colorOfLamps(int lamps_tried) {
  float heat = log2(max(float(lamps_tried), 1.0)) / 3.0;
  return lamps_tried == 0 ? vec3(0.02) : clamp(vec3(heat - 1.0, 1.0 - abs(heat - 1.0), 1.0 - heat), 0.0, 1.0);
}
#endif

#endif
