// The tiles that discs below kLarge reach, a work group each, in rows of at most kAcross: a device may allow no more than 65535.
// work   buffer; the define WORK_ACCESS is its qualifier, readonly by default
#ifndef DOF_SMALL_WORK_GLSL
#define DOF_SMALL_WORK_GLSL

const uint kAcross = 1024u;

#ifndef WORK_ACCESS
#define WORK_ACCESS readonly
#endif

layout(std430) WORK_ACCESS buffer work {
  uvec3 groups;
  uint count;
  uint tiles_of[];  // x, and y * 65536
};

// Of this work group. Those that are left over in the last row do the first tile again.
ivec2 tileOfGroup() {
  uint i = gl_WorkGroupID.x + gl_WorkGroupID.y * kAcross, of = tiles_of[i < count ? i : 0u];
  return ivec2(of & 65535u, of >> 16);
}

#endif
