// Which other spheres a sphere sees, at most MOST_NEIGHBOURS, the widest first; radius 0 ends a list that is shorter. A texture, two texels each: centre
// and radius; albedo, and the share of its cap that nearer spheres leave, seen from the middle of the sphere whose list this is.
// The share is
// negative for the image of that sphere itself in the ground. The first texel of all says in x how far away a sphere hides anything, in radii.
// neighbours   texture, LISTS_ACROSS lists wide
#ifndef NEIGHBOURS_LISTS_GLSL
#define NEIGHBOURS_LISTS_GLSL

ivec2 neighbourTexel(uint row, int i) { return ivec2((int(row) % LISTS_ACROSS) * 2 * MOST_NEIGHBOURS + 2 * i, int(row) / LISTS_ACROSS + 1); }

#endif
