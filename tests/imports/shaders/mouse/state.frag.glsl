// The row of @mouse as numbers: position and dragged in even columns, pressed, down and clicked in odd ones. Slots: mouse; result.
#include "common/mouse.glsl"

out vec4 result;

void main() {
  Mouse m = mouse_state[0];
  result = int(gl_FragCoord.x) % 2 == 0 ? vec4(m.position, m.dragged) : vec4(m.pressed, float(m.down), float(m.clicked));
}
