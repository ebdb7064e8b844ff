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
shared vec2 radii[256];  // sum of logarithms, greatest
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
  for (uint hop = 128u; hop > 0u; hop /= 2u) {
    if (self < hop) {
      lows[self] = min(lows[self], lows[self + hop]);
      highs[self] = max(highs[self], highs[self + hop]);
      radii[self].x += radii[self + hop].x;
    }
    barrier();
  }
  float large = 2.0 * exp(radii[0].x / float(count));
  radius.y = 0.0;
  for (uint i = self; i < count; i += 256u)
    if (instance[i].radius <= large) radius.y = max(radius.y, instance[i].radius);
  radii[self].y = radius.y;
  barrier();
  for (uint hop = 128u; hop > 0u; hop /= 2u) {
    if (self < hop) radii[self].y = max(radii[self].y, radii[self + hop].y);
    barrier();
  }
  if (self == 0u) {
    grid_radii = vec4(radii[0].y, large, 0.0, 0.0);
    placeCells(lows[0], highs[0], radii[0].y);
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
