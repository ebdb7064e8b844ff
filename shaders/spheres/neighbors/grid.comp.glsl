// Makes the grid of spheres/neighbors/grid.glsl by a counting sort, in one group of 256 threads. The order of the
// spheres within a cell is not defined.
// read    instances   the spheres
// write   grid        room for `cells` + 1 words, and one word for each sphere
// params  count       of spheres
//         cells       how many cells the grid has at most, without that of the large spheres
#define GRID_ACCESS coherent
#include "grid.glsl"
#include "scene/instances.glsl"

layout(local_size_x = 256) in;
layout(std140) uniform Parameters {
  uint count;
  uint cells;
};

shared vec3 lows[256];
shared vec3 highs[256];
shared vec2 radii[256];  // x: sum of the logarithms of radii; y: the greatest radius of a sphere that is not large
shared uint sums[256];

// Chooses a small side for the cubes, not below `least`, so that at most `most` of them fill the box. `many`: their
// number along x, y and z, and in all.
void placeCells(vec3 low, vec3 high, float least, uint most, out float side, out uvec4 many) {
  vec3 size = high - low;
  float longest = max(max(size.x, size.y), size.z);
  side = max(longest / float(most), max(least, 1e-6 * longest));
  vec3 along = vec3(1.0);
  for (int i = 0; i < 256; ++i) {
    along = floor(size / side) + 1.0;
    if (along.x * along.y * along.z <= float(most)) break;
    side *= 1.08;
  }
  many = uvec4(uvec3(along), uint(along.x * along.y * along.z));
}

void main() {
  uint self = gl_LocalInvocationIndex;
  // The last cell holds the large spheres. In a loop, software reads a uniform separately for each lane, so loops use
  // the sum `words`, not `cells`.
  uint words = cells + 1u, part = (words + 255u) / 256u;
  uint first = min(self * part, words), last = min(first + part, words);
  for (uint cell = first; cell < last; ++cell) grid_word[cell] = 0u;

  vec3 low = vec3(3.4e38), high = vec3(-3.4e38);
  vec2 radius = vec2(0.0);
  for (uint i = self; i < count; i += 256u) {
    low = min(low, instance[i].center);
    high = max(high, instance[i].center);
    radius.x += log(instance[i].radius);
  }
  lows[self] = low;
  highs[self] = high;
  radii[self] = radius;
  barrier();
  // Every thread adds the values of all threads. A reduction would take more barriers; each makes the program larger,
  // and in software the translation of the program takes longer than its work.
  radius = vec2(0.0);
  for (uint other = 0u; other < 256u; ++other) {
    low = min(low, lows[other]);
    high = max(high, highs[other]);
    radius.x += radii[other].x;
  }
  float large = 2.0 * exp(radius.x / float(count));  // from this radius on a sphere is large
  for (uint i = self; i < count; i += 256u)
    if (instance[i].radius <= large) radius.y = max(radius.y, instance[i].radius);
  radii[self].y = radius.y;
  barrier();
  for (uint other = 0u; other < 256u; ++other) radius.y = max(radius.y, radii[other].y);
  float side;
  uvec4 many;
  placeCells(low, high, radius.y, words - 1u, side, many);
  vec4 corner = vec4(low, side);
  if (self == 0u) {
    grid_low = corner;
    grid_cells = many;
    grid_radii = vec4(radius.y, large, 0.0, 0.0);
  }

  // The loop runs twice, so that the program has its code once. The first turn counts the spheres of each cell, from
  // words that are 0. The second turn finds the start of each cell and stores the spheres; each word advances to the
  // end of its cell.
  for (uint turn = 0u; turn < 2u; ++turn) {
    // Each thread adds up its part of the cells, then adds the sums of the threads before it.
    uint sum = 0u;
    for (uint cell = first; cell < last; ++cell) sum += grid_word[cell];
    sums[self] = sum;
    barrier();
    uint before = 0u;
    for (uint i = 0u; i < self; ++i) before += sums[i];
    for (uint cell = first; cell < last; ++cell) {
      uint here = grid_word[cell];
      grid_word[cell] = before;
      before += here;
    }
    memoryBarrierBuffer();
    barrier();
    for (uint i = self; i < count; i += 256u) {
      uint own = cellIndex(cellOf(instance[i].center, corner, many), many);
      uint at = atomicAdd(grid_word[instance[i].radius > large ? words - 1u : own], 1u);
      if (turn == 1u) grid_word[words + at] = i;
    }
    memoryBarrierBuffer();
    barrier();
  }
}
