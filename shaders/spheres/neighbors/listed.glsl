// Reads the lists of spheres/neighbors/lists.glsl in fragments.
// read    neighbors   not `as linear`
#ifndef SPHERES_NEIGHBORS_LISTED_GLSL
#define SPHERES_NEIGHBORS_LISTED_GLSL

#include "spheres/neighbors/lists.glsl"

uniform sampler2D neighbors;

// The ground, as the lists have it.
struct GroundPlane {
  float exists;  // 1: there is one
  float height;
  float radius;  // of its surface, about the world's Y axis
  vec3 albedo;
};

// The list of one sphere.
struct NeighborList {
  vec2 first;    // texture coordinates of its first texel
  float texel;   // width of a texel
  float reach;   // distance at which a sphere hides nothing more, in its radii
  GroundPlane ground;
};

struct Neighbor {
  vec3 center;   // world
  float radius;  // 0: the list has ended
};

// By a nearest sampler: in software a lookup with a level costs less than a fetch by integers.
vec4 listTexel(NeighborList list, int i) {
  return textureLod(neighbors, vec2(list.first.x + float(i) * list.texel, list.first.y), 0.0);
}

Neighbor neighborOf(NeighborList list, int i) {
  vec4 ball = listTexel(list, 2 * i);
  return Neighbor(ball.xyz, ball.w);
}
// Albedo and packed material: see lists.glsl.
vec4 neighborMaterial(NeighborList list, int i) { return listTexel(list, 2 * i + 1); }

NeighborList listOf(uint row) {
  vec2 texel = 1.0 / vec2(textureSize(neighbors, 0));
  vec4 common_row = textureLod(neighbors, 0.5 * texel, 0.0);
  vec3 albedo = textureLod(neighbors, vec2(1.5, 0.5) * texel, 0.0).rgb;
  GroundPlane ground = GroundPlane(common_row.w, common_row.y, common_row.z, albedo);
  return NeighborList((vec2(neighborTexel(row, 0)) + 0.5) * texel, texel.x, common_row.x, ground);
}

#endif
