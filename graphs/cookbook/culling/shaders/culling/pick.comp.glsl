// The boxes that were seen in the frame before.
// read    before     state of each box
// write   list       numbers of boxes
// modify  commands   a draw of them
#include "commands.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer before { uint old_state[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i == 0u) indices = 36u;
  if (i < uint(old_state.length()) && old_state[i] == 2u) add(i);
}
