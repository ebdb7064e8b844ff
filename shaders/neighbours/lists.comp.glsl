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
int found = 0;

void consider(uint self, vec4 own, uint row) {
  vec4 ball = vec4(instance[row].center, instance[row].radius);
  float distance_to = length(ball.xyz - own.xyz), sine = min(ball.w / distance_to, 1.0);
  bool within = distance_to + min(ball.w, own.w) <= max(ball.w, own.w);  // one is within the other
  if (row == self || within || !(distance_to < reach * ball.w + own.w)) return;
  int at = found;
  for (; at > 0 && (sine > sines[at - 1] || (sine == sines[at - 1] && row < rows[at - 1])); --at) {
    if (at == kCandidates) continue;
    sines[at] = sines[at - 1];
    rows[at] = rows[at - 1];
  }
  if (at == kCandidates) return;
  sines[at] = sine;
  rows[at] = row;
  found = min(found + 1, kCandidates);
}

// Half angle of the cap of the i-th.
float angleOf(int i) { return fastAtan(vec2(sines[i]), vec2(sqrt(max(1.0 - sines[i] * sines[i], 0.0)))).x; }

// What nearer spheres leave of the cap of the i-th.
float leftOf(int i, vec3 center) {
  vec3 axis = instance[rows[i]].center - center;
  float left = 1.0, distance_to = length(axis), angle = angleOf(i);
  axis /= distance_to;
  for (int j = 0; j < found && left >= kHidden; ++j) {
    vec3 other = instance[rows[j]].center - center;
    float distance_of_other = length(other);
    if (distance_of_other >= distance_to * 0.999999) continue;
    other /= distance_of_other;
    float apart = fastAtan(vec2(length(cross(axis, other))), vec2(dot(axis, other))).x;
    left *= 1.0 - capOverlap(angleOf(j), angle, apart);
  }
  return left;
}

// In software the translation of this takes far longer than its work, and every access to a buffer, an array or an image makes it
// longer. So each stands once: loops have rounds for the last cell, and for what comes before and after the spheres of a list.
void main() {
  uint self = gl_GlobalInvocationID.x;
  if (self >= count) return;
  vec4 own = vec4(instance[self].center, instance[self].radius);
  float far = reach * grid_radii.x + own.w;
  ivec3 low = cellOf(own.xyz - far), high = cellOf(own.xyz + far), at = low;
  for (bool more = true; more;) {
    more = at.z <= high.z;
    uint cell = more ? cellIndex(at) : cells;
    for (uint i = cells + 1u + (cell == 0u ? 0u : grid_word[cell - 1u]), last = cells + 1u + grid_word[cell]; i < last; ++i)
      consider(self, own, grid_word[i]);
    ++at.x;
    if (at.x > high.x) at = ivec3(low.x, at.y + 1, at.z);
    if (at.y > high.y) at = ivec3(low.x, low.y, at.z + 1);
  }

  // Round -2 writes the first texel of all, -1 the ground, and the last one what ends a list that is shorter.
  int listed = 0;
  for (int i = self == 0u ? -2 : -1; i <= found && listed < MOST_NEIGHBOURS; ++i) {
    vec4 ball = vec4(0.0), light = vec4(0.0);
    if (i == -2) {
      ball = vec4(reach);
    } else if (i == -1) {
      // The ground around its foot is dark. A sphere sees about as much of that as of its own image in the ground, and a little beyond.
#ifdef HAS_GROUND
      float height = ground_row[0].height;
      if (own.y - height <= -own.w) continue;
      ball = vec4(own.x, 2.0 * height - own.y, own.zw);
      light = vec4(groundAlbedo(ground_row[0]), -kImage);
#else
      continue;
#endif
    } else if (i < found) {
      float left = leftOf(i, own.xyz);
      if (left < kHidden) continue;
      ball = vec4(instance[rows[i]].center, instance[rows[i]].radius);
      light = vec4(instance[rows[i]].albedo, left);
    }
    ivec2 texel = i == -2 ? ivec2(0) : neighbourTexel(self, listed++);
    imageStore(neighbours, texel, ball);
    imageStore(neighbours, texel + ivec2(1, 0), light);
  }
}
