// The grid of neighbours/grid.glsl: a counting sort, by one group of 256 threads. The order within a cell is any.
// read    instances   the spheres
// write   grid        room for `cells` + 1 words and one a sphere
// params  count       spheres
//         cells       at most so many, without the one of the large spheres
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
shared vec2 radii[256];  // sum of logarithms, greatest; the first at last from which radius on a sphere is large
shared uint sums[256];

// Cubes of which `cells` at most fill the box, as small as they may be.
void placeCells(vec3 low, vec3 high, float least) {
  vec3 size = high - low;
  float longest = max(max(size.x, size.y), size.z), side = max(longest / float(cells), max(least, 1e-6 * longest));
  vec3 along = vec3(1.0);
  for (int i = 0; i < 256; ++i) {
    along = floor(size / side) + 1.0;
    if (along.x * along.y * along.z <= float(cells)) break;
    side *= 1.08;
  }
  grid_low = vec4(low, side);
  grid_cells = uvec4(uvec3(along), uint(along.x * along.y * along.z));
}

uint cellOfSphere(uint i) { return instance[i].radius > grid_radii.y ? cells : cellIndex(cellOf(instance[i].center)); }

void main() {
  uint self = gl_LocalInvocationIndex;
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
  // One thread goes through all parts: each barrier makes the program larger, and in software its translation takes longer than its work.
  if (self == 0u) {
    for (uint other = 1u; other < 256u; ++other) {
      low = min(low, lows[other]);
      high = max(high, highs[other]);
      radius.x += radii[other].x;
    }
    radii[0].x = 2.0 * exp(radius.x / float(count));
  }
  barrier();
  float large = radii[0].x;
  radius.y = 0.0;
  for (uint i = self; i < count; i += 256u)
    if (instance[i].radius <= large) radius.y = max(radius.y, instance[i].radius);
  radii[self].y = radius.y;
  barrier();
  if (self == 0u) {
    for (uint other = 1u; other < 256u; ++other) radius.y = max(radius.y, radii[other].y);
    grid_radii = vec4(radius.y, large, 0.0, 0.0);
    placeCells(low, high, radius.y);
  }
  for (uint cell = self; cell <= cells; cell += 256u) grid_word[cell] = 0u;
  memoryBarrierBuffer();
  barrier();

  for (uint i = self; i < count; i += 256u) atomicAdd(grid_word[cellOfSphere(i)], 1u);
  memoryBarrierBuffer();
  barrier();

  // Where each cell begins: each thread adds up a part of the cells, then takes what the threads before it have.
  uint part = (cells + 256u) / 256u, first = min(self * part, cells + 1u), last = min(first + part, cells + 1u), sum = 0u;
  for (uint cell = first; cell < last; ++cell) sum += grid_word[cell];
  sums[self] = sum;
  barrier();
  uint before = 0u;
  for (uint i = 0u; i < self; ++i) before += sums[i];
  for (uint cell = first; cell < last; ++cell) {
    uint many = grid_word[cell];
    grid_word[cell] = before;
    before += many;
  }
  memoryBarrierBuffer();
  barrier();

  // Beginnings move on to the ends.
  for (uint i = self; i < count; i += 256u) grid_word[cells + 1u + atomicAdd(grid_word[cellOfSphere(i)], 1u)] = i;
}
