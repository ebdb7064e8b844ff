// Light lists as bit masks: one bit per lamp for each tile of LAMP_TILE x LAMP_TILE pixels, and for each slice of depth. A pixel is lit by
// the lamps in the masks of both its tile and its slice (after Drobot, "Improved culling for tiled and clustered rendering", SIGGRAPH 2017
// courses). There is a bit for each lamp, in the lamps' order, so no list can overflow. A set bit means that the lamp does not reach: a
// mask that was only cleared leaves out no lamp. A tile has two masks: `clusters` for the depths of the G-buffer in it, and `columns` for
// any depth, for forward passes.
// defines LAMP_TILE    8 or 16, so that the lanes of a tile fill whole words of 32 lamps
//         LAMP_SLICES
#ifndef DEFERRED_CLUSTERS_GLSL
#define DEFERRED_CLUSTERS_GLSL

#include "common/view.glsl"

const float kSlicesPerOctave = 2.5;  // of distance, from the near plane; the last of LAMP_SLICES has no end

int wordsOf(int lamp_count) { return (lamp_count + 31) / 32; }
ivec2 tilesOf(ivec2 size) { return (size + LAMP_TILE - 1) / LAMP_TILE; }
// Number of the tile that a pixel of a target of that size is in.
int tileAt(ivec2 pixel, ivec2 size) { return pixel.y / LAMP_TILE * tilesOf(size).x + pixel.x / LAMP_TILE; }

int sliceOf(float view_distance) {
  return clamp(int(floor(log2(max(view_distance / near_plane, 1e-6)) * kSlicesPerOctave)), 0, LAMP_SLICES - 1);
}

// Distance along the view axis of a world position.
float viewDistance(vec3 position) {
  vec4 back = transpose(view)[2];
  return -(back.x * position.x + back.y * position.y + back.z * position.z + back.w);
}

#endif
