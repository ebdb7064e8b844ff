// Which other spheres a sphere sees, at most MOST_NEIGHBOURS, the widest first; radius 0 ends a list that is shorter. A texture, two texels each: centre
// and radius; albedo, and what packMatter makes of the share of its cap that nearer spheres leave, seen from the middle of the sphere whose list
// this is, and of its roughness and metallic. The last is negative for the image of that sphere itself in the ground, and then the share alone.
// The first texel of all says how far away a sphere hides anything, in radii; height of the ground; radius of its surface; 1 if there is a ground.
// The second one is the ground's albedo.
// neighbours   texture, LISTS_ACROSS lists wide
#ifndef NEIGHBOURS_LISTS_GLSL
#define NEIGHBOURS_LISTS_GLSL

ivec2 neighbourTexel(uint row, int i) { return ivec2((int(row) % LISTS_ACROSS) * 2 * MOST_NEIGHBOURS + 2 * i, int(row) / LISTS_ACROSS + 1); }

// Whole steps of roughness and metallic, and below them half the share.
const float kRoughnessSteps = 127.0, kMetallicSteps = 15.0;
float packMatter(float left, float roughness, float metallic) {
  return 0.5 * left + floor(roughness * kRoughnessSteps + 0.5) + (kRoughnessSteps + 1.0) * floor(metallic * kMetallicSteps + 0.5);
}
// Share, roughness, metallic.
vec3 unpackMatter(float packed_matter) {
  float whole = floor(packed_matter), steps = floor(whole * (1.0 / (kRoughnessSteps + 1.0)));
  return vec3(2.0 * (packed_matter - whole), (whole - steps * (kRoughnessSteps + 1.0)) * (1.0 / kRoughnessSteps), steps * (1.0 / kMetallicSteps));
}

#endif
