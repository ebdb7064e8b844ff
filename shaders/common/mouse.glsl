// The mouse, the import @mouse under the slot `mouse`. Points are in pixels of the presented picture from its lower left corner,
// as gl_FragCoord counts them: the middle of the lower left pixel is (0.5, 0.5).
#ifndef COMMON_MOUSE_GLSL
#define COMMON_MOUSE_GLSL

struct Mouse {
  vec2 position;  // last position over the picture
  vec2 dragged;   // last position while the left button was held
  vec2 pressed;   // position of the last press of the left button
  uint down;      // 1 while the left button is held, else 0
  uint clicked;   // 1 in the frame in which the left button went down, else 0
};
layout(std430) readonly buffer mouse { Mouse mouse_state[]; };

// Shadertoy's iMouse: xy is `dragged`, zw is `pressed`; z is negative unless the button is held, w unless it just went down.
vec4 shadertoyMouse() {
  Mouse m = mouse_state[0];
  return vec4(m.dragged, m.down != 0u ? m.pressed.x : -m.pressed.x, m.clicked != 0u ? m.pressed.y : -m.pressed.y);
}

#endif
