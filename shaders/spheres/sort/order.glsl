// The elements of a draw order: uvec2(key, index), ascending by key, then by index. Keys and padding are those of the
// CPU sort by power (engine/scene/sort.h), so that both give the same order.
#ifndef SORT_ORDER_GLSL
#define SORT_ORDER_GLSL

const uvec2 kPadding = uvec2(0xffffffffu);

// Farther first. -0 equals +0; NaN comes last.
uint depthKey(float depth) {
  uint bits = depth == 0.0 ? 0u : floatBitsToUint(depth);
  bool no_number = (bits & 0x7fffffffu) > 0x7f800000u;  // isnan() may be optimized away
  bits = (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
  return no_number ? 0xffffffffu : ~bits;
}

bool comesAfter(uvec2 a, uvec2 b) { return a.x > b.x || (a.x == b.x && a.y > b.y); }

// Work groups may be folded into rows when there are more than one axis allows.
uint groupIndex() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

#endif
