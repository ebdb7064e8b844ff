// Which other spheres a sphere sees, at most kMost, the widest first; radius 0 ends a list that is shorter. A texture, two texels each: centre
// and radius; albedo, and the share of its cap that nearer spheres leave, seen from the middle of the sphere whose list this is.
// The share is
// negative for the image of that sphere itself in the ground. The first texel of all says in x how far away a sphere hides anything, in radii.
// neighbours   texture
#ifndef NEIGHBOURS_LISTS_GLSL
#define NEIGHBOURS_LISTS_GLSL

// graphs/neighbours.json makes room for so many.
const int kMost = 48, kListsAcross = 64;

ivec2 neighbourTexel(uint row, int i) { return ivec2((int(row) % kListsAcross) * 2 * kMost + 2 * i, int(row) / kListsAcross + 1); }

#endif
