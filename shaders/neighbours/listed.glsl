// What all points of a sphere share of what is around it: where its list stands, and the ground. Vertex shaders find it by
// neighbours/row.glsl and hand it on as `flat out Listed listed`: in software an input costs much less than a fetch.
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
  vec3 above, below; // the irradiance map's values straight up and down
};

#endif
