// Of a fullscreen pass: a slot and a parameter that the vertex shader reads, and what it hands on.
// read    scale     1x1
// params  offset
#include "common/fullscreen.glsl"

uniform sampler2D scale;
layout(std140) uniform Parameters { float offset; };
out vec2 uv;
flat out float whole;

void main() {
  gl_Position = fullscreenPosition(uv);
  whole = texelFetch(scale, ivec2(0), 0).r + offset;
}
