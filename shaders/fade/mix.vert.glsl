// A triangle over the whole picture.
#include "common/fullscreen.glsl"

void main() {
  vec2 uv;
  gl_Position = fullscreenPosition(uv);
}
