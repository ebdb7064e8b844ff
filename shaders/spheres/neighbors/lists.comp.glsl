// Makes the lists of spheres/neighbors/lists.glsl, with one thread for each sphere. Another sphere is a candidate when
// some point of this one lies within its reach. The widest kCandidates are kept, equally wide ones by their rows. A
// nearer candidate may hide a farther one, by the overlap of their caps as seen from this sphere's center. A candidate
// that is nearly hidden is left out.
// read    instances   the spheres
//         grid?       of spheres/neighbors/grid.comp.glsl; without it each sphere tests all others
//         ground?     see scene/ground.glsl
// write   neighbors
// params  count       of spheres
//         cells       as in spheres/neighbors/grid.comp.glsl
//         reach       reach of a sphere, in its radii
#include "common/fast_atan.glsl"
#ifdef HAS_GRID
#include "grid.glsl"
#endif
#include "lists.glsl"
#include "overlap.glsl"
#ifdef HAS_GROUND
#include "scene/ground.glsl"
#endif
#include "scene/instances.glsl"

layout(local_size_x = 32) in;
layout(rgba32f) uniform writeonly image2D neighbors;
layout(std140) uniform Parameters {
  uint count;
  uint cells;
  float reach;
};

const int kCandidates = 120;
const float kHidden = 0.03;  // a sphere is left out when less than this share of its cap is left
const float kImage = 1.3;    // how dark the ground is around a contact point: fitted to path-traced pictures

// Bits of the sine of the half angle, and row; ordered by both, the widest first. The array is in shared memory, a
// column per thread: software would first clear a thread's own array, element by element.
shared uvec2 candidates[kCandidates * 32];
int found = 0;

int candidateOf(int i) { return i * 32 + int(gl_LocalInvocationIndex); }

void consider(uint self, vec4 own, float radii, uint row) {
  vec4 ball = vec4(instance[row].center, instance[row].radius);
  float distance_to = length(ball.xyz - own.xyz), sine = min(ball.w / distance_to, 1.0);
  bool within = distance_to + min(ball.w, own.w) <= max(ball.w, own.w);  // one is within the other
  if (row == self || within || !(distance_to < radii * ball.w + own.w)) return;
  int at = found;
  for (; at > 0; --at) {
    uvec2 other = candidates[candidateOf(at - 1)];
    float sine_before = uintBitsToFloat(other.x);
    if (!(sine > sine_before || (sine == sine_before && row < other.y))) break;
    if (at < kCandidates) candidates[candidateOf(at)] = other;
  }
  if (at == kCandidates) return;
  candidates[candidateOf(at)] = uvec2(floatBitsToUint(sine), row);
  found = min(found + 1, kCandidates);
}

// The half angle of a cap, in radians.
float angleOf(uint sine_bits) {
  float sine = uintBitsToFloat(sine_bits);
  return fastAtan(vec2(sine), vec2(sqrt(max(1.0 - sine * sine, 0.0)))).x;
}

// The share that nearer spheres leave of the cap of a sphere. `angle` is half the cap's; `axis` goes from `center`,
// where it is seen from, to the sphere's center.
float leftOf(float angle, vec3 axis, vec3 center) {
  float left = 1.0, distance_to = length(axis);
  axis /= distance_to;
  for (int j = 0; j < found && left >= kHidden; ++j) {
    uvec2 candidate = candidates[candidateOf(j)];
    vec3 other = instance[candidate.y].center - center;
    float distance_of_other = length(other);
    if (distance_of_other >= distance_to * 0.999999) continue;
    other /= distance_of_other;
    float apart = fastAtan(vec2(length(cross(axis, other))), vec2(dot(axis, other))).x;
    left *= 1.0 - capOverlap(angleOf(candidate.x), angle, apart);
  }
  return left;
}

// In software the translation of this program takes far longer than its work, and grows with each access in its text to
// a buffer, an array or an image. So each access is written once: the loops have extra rounds for the last cell, and
// for what comes before and after the spheres of a list.
void main() {
  float radii = max(reach, 0.0);
#ifdef HAS_GRID
  vec4 least = grid_low;
  uvec4 many = grid_cells;
  float widest = grid_radii.x;
  uint words = cells + 1u;
#else
  uint rows = max(count, 1u);  // not `count` itself, which software would read for each lane in the loop
#endif
#ifdef HAS_GROUND
  float height = ground_row[0].height, ground_radius = ground_row[0].radius;
  vec3 ground_albedo = groundAlbedo(ground_row[0]);
#endif
  uint self = gl_GlobalInvocationID.x;
  if (self >= count) return;
  vec4 own = vec4(instance[self].center, instance[self].radius);
#ifdef HAS_GRID
  float far = radii * widest + own.w;
  ivec3 low = cellOf(own.xyz - far, least, many), high = cellOf(own.xyz + far, least, many), at = low;
  for (bool more = true; more;) {
    more = at.z <= high.z;
    uint cell = more ? cellIndex(at, many) : words - 1u;
    for (uint i = words + (cell == 0u ? 0u : grid_word[cell - 1u]), last = words + grid_word[cell]; i < last; ++i)
      consider(self, own, radii, grid_word[i]);
    ++at.x;
    if (at.x > high.x) at = ivec3(low.x, at.y + 1, at.z);
    if (at.y > high.y) at = ivec3(low.x, low.y, at.z + 1);
  }
#else
  for (uint row = 0u; row < rows; ++row) consider(self, own, radii, row);
#endif

  // Round -2 writes the two texels for all lists, round -1 the image in the ground, and round `found` the end of a list
  // that is shorter.
  int listed = 0;
  for (int i = self == 0u ? -2 : -1; i <= found && listed < MOST_NEIGHBORS; ++i) {
    vec4 ball = vec4(0.0), light = vec4(0.0);
    if (i == -2) {
      ball = vec4(radii, 0.0, 0.0, 0.0);
#ifdef HAS_GROUND
      ball.yzw = vec3(height, ground_radius, 1.0);
      light.rgb = ground_albedo;
#endif
    } else if (i == -1) {
      // The ground around a sphere's contact point is dark. The sphere sees about as much of that as of its own mirror
      // image in the ground.
#ifdef HAS_GROUND
      if (own.y - height <= -own.w) continue;
      ball = vec4(own.x, 2.0 * height - own.y, own.zw);
      light = vec4(ground_albedo, -kImage);
#else
      continue;
#endif
    } else if (i < found) {
      uvec2 candidate = candidates[candidateOf(i)];
      ball = vec4(instance[candidate.y].center, instance[candidate.y].radius);
      float left = leftOf(angleOf(candidate.x), ball.xyz - own.xyz, own.xyz);
      if (left < kHidden) continue;
      float packed_material = packMaterial(left, instance[candidate.y].roughness, instance[candidate.y].metallic);
      light = vec4(instance[candidate.y].albedo, packed_material);
    }
    ivec2 texel = i == -2 ? ivec2(0) : neighborTexel(self, listed++);
    imageStore(neighbors, texel, ball);
    imageStore(neighbors, texel + ivec2(1, 0), light);
  }
}
