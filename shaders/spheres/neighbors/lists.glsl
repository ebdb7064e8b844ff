// For each sphere the list of the other spheres that it sees, at most MOST_NEIGHBORS of them, the widest first. Each
// has two texels:
//   center, radius         a radius of 0 ends a list that is shorter
//   albedo, packMaterial() the share of its cap that nearer spheres leave, seen from the center of the list's own
//   sphere; roughness; metallic
// A list may begin with the mirror image of its own sphere in the ground. Its last number is negative: minus a factor
// on how dark the ground is around the sphere's contact point. Row 0 has two texels for all lists:
//   reach, height, radius, exists   a sphere hides nothing from `reach` of its radii on; the ground's height, radius,
//                                   and 1 if there is a ground
//   albedo                          of the ground
// neighbors   texture, LISTS_ACROSS lists wide
#ifndef SPHERES_NEIGHBORS_LISTS_GLSL
#define SPHERES_NEIGHBORS_LISTS_GLSL

// The first texel of entry `i` in the list of the sphere of that row.
ivec2 neighborTexel(uint row, int i) {
  return ivec2((int(row) % LISTS_ACROSS) * 2 * MOST_NEIGHBORS + 2 * i, int(row) / LISTS_ACROSS + 1);
}

// Three numbers in one float: the whole part has the steps of roughness and metallic, the fraction is half the share.
// All are 0 to 1.
const float kRoughnessSteps = 127.0, kMetallicSteps = 15.0;
float packMaterial(float left, float roughness, float metallic) {
  float steps = floor(metallic * kMetallicSteps + 0.5);
  return 0.5 * left + floor(roughness * kRoughnessSteps + 0.5) + (kRoughnessSteps + 1.0) * steps;
}
// Share, roughness, metallic.
vec3 unpackMaterial(float material) {
  float whole = floor(material), steps = floor(whole * (1.0 / (kRoughnessSteps + 1.0)));
  float roughness = (whole - steps * (kRoughnessSteps + 1.0)) * (1.0 / kRoughnessSteps);
  return vec3(2.0 * (material - whole), roughness, steps * (1.0 / kMetallicSteps));
}

#endif
