#include "common/mouse.glsl"
out vec4 result;
void main() { result = mouse_state[0].position.xyxy; }
