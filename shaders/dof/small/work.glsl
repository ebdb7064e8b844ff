// The tiles that discs below kLarge reach, a work group each, in rows of at most kAcross: a device may allow no more than 65535.
#ifndef DOF_SMALL_WORK_GLSL
#define DOF_SMALL_WORK_GLSL

const uint kAcross = 1024u;

layout(std430) buffer work {
  uvec3 groups;
  uint count;
  uint tiles_of[];  // x, and y * 65536
};

void addWork(ivec2 tile) {
  uint i = atomicAdd(count, 1u);
  tiles_of[i] = uint(tile.x + (tile.y << 16));
  atomicMax(groups.x, min(i + 1u, kAcross));
  atomicMax(groups.y, i / kAcross + 1u);
  groups.z = 1u;
}

// Of this work group. Those that are left over in the last row do the first tile again.
ivec2 tileOfGroup() {
  uint i = gl_WorkGroupID.x + gl_WorkGroupID.y * kAcross, of = tiles_of[i < count ? i : 0u];
  return ivec2(of & 65535u, of >> 16);
}

#endif
