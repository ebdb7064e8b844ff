// What all points of a sphere share of what is around it: where its list stands, and the ground.
// Slot neighbours, see neighbours/lists.glsl; not `as linear`.
#ifndef NEIGHBOURS_LISTED_GLSL
#define NEIGHBOURS_LISTED_GLSL

#include "neighbours/lists.glsl"

uniform sampler2D neighbours;

struct Listed {
  vec3 first;        // in the texture: place of the list's first texel, width of a texel
  float reach;       // how far away a sphere hides anything, in radii
  float is_ground;   // 1: there is one
  float height, radius;
  vec3 albedo;       // of the ground
};

// Of the sphere of that row.
Listed listedOf(uint row) {
  // By a nearest sampler: in software a fetch that is told its level as a float costs less than one by whole numbers.
  vec2 texel = 1.0 / vec2(textureSize(neighbours, 0));
  vec4 common_row = textureLod(neighbours, 0.5 * texel, 0.0);
  return Listed(vec3((vec2(neighbourTexel(row, 0)) + 0.5) * texel, texel.x), common_row.x, common_row.w, common_row.y, common_row.z,
                textureLod(neighbours, vec2(1.5, 0.5) * texel, 0.0).rgb);
}

#endif
