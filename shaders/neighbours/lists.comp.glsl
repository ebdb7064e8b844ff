// The lists of neighbours/lists.glsl, one thread a sphere. Spheres of which some point of this one is nearer than their reach count, the
// widest kCandidates of them; equally wide ones by their rows. Nearer ones may hide them: by caps, seen from this sphere's middle. What is
// hidden nearly whole is left out.
// read    instances   the spheres
//         grid        of neighbours/grid.comp.glsl
//         ground?     see scene/ground.glsl
// write   neighbours
// params  count       spheres
//         cells       as that shader had it
//         reach       in radii
#include "common/fast_atan.glsl"
#include "grid.glsl"
#include "lists.glsl"
#include "overlap.glsl"
#ifdef HAS_GROUND
#include "scene/ground.glsl"
#endif
#include "scene/instances.glsl"

layout(local_size_x = 64) in;
layout(rgba32f) uniform writeonly image2D neighbours;
layout(std140) uniform Parameters {
  uint count;
  uint cells;
  float reach;
};

const int kCandidates = 120;
const float kHidden = 0.03;  // of a cap
const float kImage = 1.3;    // fitted to traced paths

// Ordered by the sine of the half angle, then by row.
uint rows[kCandidates];
float sines[kCandidates];
float angles[kCandidates];
float distances[kCandidates];
float x[kCandidates], y[kCandidates], z[kCandidates];  // of the direction, unit
int found = 0;

void consider(uint self, uint row) {
  if (row == self) return;
  vec3 to = instance[row].center - instance[self].center;
  float distance_to = length(to), radius = instance[row].radius, own = instance[self].radius;
  if (!(distance_to < reach * radius + own)) return;
  if (distance_to + min(radius, own) <= max(radius, own)) return;  // one is within the other
  float sine = min(radius / distance_to, 1.0);
  if (found == kCandidates && (sine < sines[found - 1] || (sine == sines[found - 1] && row > rows[found - 1]))) return;
  int at = min(found, kCandidates - 1);
  for (; at > 0 && (sine > sines[at - 1] || (sine == sines[at - 1] && row < rows[at - 1])); --at) {
    sines[at] = sines[at - 1];
    rows[at] = rows[at - 1];
  }
  sines[at] = sine;
  rows[at] = row;
  found = min(found + 1, kCandidates);
}

void considerCell(uint self, uint cell) {
  uint first = cells + 1u + (cell == 0u ? 0u : grid_word[cell - 1u]), last = cells + 1u + grid_word[cell];
  for (uint i = first; i < last; ++i) consider(self, grid_word[i]);
}

void main() {
  uint self = gl_GlobalInvocationID.x;
  if (self >= count) return;
  if (self == 0u) imageStore(neighbours, ivec2(0), vec4(reach));
  vec3 center = instance[self].center;
  float far = reach * grid_radii.x + instance[self].radius;
  ivec3 low = cellOf(center - far), high = cellOf(center + far);
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i) considerCell(self, cellIndex(ivec3(i, j, k)));
  considerCell(self, cells);

  for (int i = 0; i < found; ++i) {
    vec3 to = instance[rows[i]].center - center;
    float distance_to = length(to);
    distances[i] = distance_to;
    x[i] = to.x / distance_to;
    y[i] = to.y / distance_to;
    z[i] = to.z / distance_to;
    angles[i] = fastAtan(vec2(sines[i]), vec2(sqrt(max(1.0 - sines[i] * sines[i], 0.0)))).x;
  }
  int listed = 0;
#ifdef HAS_GROUND
  // The ground around its foot is dark. A sphere sees about as much of that as of its own image in the ground, and a little beyond.
  float height = ground_row[0].height;
  if (center.y - height > -instance[self].radius) {
    ivec2 texel = neighbourTexel(self, listed++);
    imageStore(neighbours, texel, vec4(center.x, 2.0 * height - center.y, center.z, instance[self].radius));
    imageStore(neighbours, texel + ivec2(1, 0), vec4(groundAlbedo(ground_row[0]), -kImage));
  }
#endif
  for (int i = 0; i < found && listed < MOST_NEIGHBOURS; ++i) {
    float left = 1.0;
    vec3 axis = vec3(x[i], y[i], z[i]);
    for (int j = 0; j < found && left >= kHidden; ++j) {
      if (distances[j] >= distances[i] * 0.999999) continue;
      vec3 other = vec3(x[j], y[j], z[j]);
      float apart = fastAtan(vec2(length(cross(axis, other))), vec2(dot(axis, other))).x;
      left *= 1.0 - capOverlap(angles[j], angles[i], apart);
    }
    if (left < kHidden) continue;
    ivec2 texel = neighbourTexel(self, listed++);
    imageStore(neighbours, texel, vec4(instance[rows[i]].center, instance[rows[i]].radius));
    imageStore(neighbours, texel + ivec2(1, 0), vec4(instance[rows[i]].albedo, left));
  }
  if (listed < MOST_NEIGHBOURS) imageStore(neighbours, neighbourTexel(self, listed), vec4(0.0));
}
