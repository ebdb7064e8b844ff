// A screen-space rectangle around each sphere: the bounds by the sphere's tangent planes through the eye (Mara and
// McGuire, JCGT 2013), one pixel wider for the soft edge. Handles the eye outside, inside and beside, and spheres behind.
// OCTAGON: with the diagonal planes as well, for geometry "octagon"; a sixth fewer pixels that the sphere does not cover.
// read    order?        uvec2(key, index) per instance: the instance to draw i-th is element i's index
#include "common/view.glsl"
#include "scene/instances.glsl"
#include "shading/parameters.glsl"
#include "shading/lobe.glsl"
#include "spheres/glint_of.glsl"
#define VERTEX_STAGE
#include "spheres/billboard_varyings.glsl"

#ifndef OCTAGON
#define OCTAGON 0
#endif

#ifdef HAS_ORDER
layout(std430) readonly buffer order { uvec2 order_element[]; };
#endif

// Slopes x / -z between the two tangents from the eye to the circle at (x, z = distance in front).
vec2 slopeBounds(float x, float z, float r) {
  float tangent2 = x * x + z * z - r * r;
  if (tangent2 <= 0.0) return vec2(-1e9, 1e9);
  float tangent = sqrt(tangent2);
  vec2 left = vec2(x * tangent - z * r, z * tangent + x * r), right = vec2(x * tangent + z * r, z * tangent - x * r);
  return vec2(left.y > 0.0 ? max(left.x / left.y, -1e9) : -1e9, right.y > 0.0 ? min(right.x / right.y, 1e9) : 1e9);
}

// The coverage ramp, one pixel wide, adds pi/12 square pixels to any convex shape (Steiner's formula: the variance of a
// unit box is 1/12). The silhouette is moved inwards by the shift that takes exactly that away again, a root of
// pi s^2 - L s + pi/12 = 0 with L the perimeter. On a small sphere that holds only in the mean over all places within a pixel,
// so there a square of the same area takes over: what it covers of each pixel adds up to its area wherever it lies.
vec2 edgeOf(float major, float minor) {
  float radius = sqrt(major * minor);
  float perimeter = kPi * (3.0 * (major + minor) - sqrt((3.0 * major + minor) * (major + 3.0 * minor)));  // Ramanujan
  return vec2(kPi / 6.0 / (perimeter + sqrt(max(perimeter * perimeter - kPi * kPi / 3.0, 0.0))), radius < 1.8 ? radius * sqrt(kPi) : 0.0);
}

void main() {
#ifdef HAS_ORDER
  uint row = order_element[gl_InstanceID].y;
#else
  uint row = uint(gl_InstanceID);
#endif
  Instance self = instance[row];
  vec3 c = (view * vec4(self.center, 1.0)).xyz;
  float r = self.radius, z = -c.z;
  float bend = max(z, 0.0) / r;
  Lobe lobe = lobeOf(self.roughness, lookupAngle() * bend);
  Glint glint = glintOf(lobe, self.center, r, pixelAngle() * bend);
  writeLobe(lobe, glint, row);

  vec2 focal = vec2(projection[0].x, projection[1].y) * 0.5 * viewport;  // pixels per unit of slope
  bool in_front = z > r * 1.0001;
  // Slope that pixel offsets count from: the center's, or the axis.
  vec2 anchor = in_front ? c.xy / z : vec2(0.0), edge = vec2(0.0);
  float d2 = dot(c, c), r2 = r * r;
  if (in_front) {
    float f = sqrt(focal.x * focal.y), depth2 = z * z - r2;
    edge = edgeOf(f * r * sqrt(d2 - r2) / depth2, f * r * inversesqrt(depth2));
  }

  vec2 anchor_pixel = ((anchor * vec2(projection[0].x, projection[1].y) - projection[2].xy) * 0.5 + 0.5) * viewport;
  mat3 to_world = transpose(mat3(view));
  sphere = vec4(c, r);
  albedo_roughness = vec4(self.albedo, self.roughness);
  edge_metallic = vec4(edge, self.metallic, in_front ? near_plane : -near_plane);
  anchor_slope = vec4(anchor_pixel, 1.0 / focal);
  right_eye = vec4(to_world[0], eye.x);
  up_eye = vec4(to_world[1], eye.y);
  before_eye = vec4(0.0, 0.0, 0.0, eye.z);
#ifdef HAS_VELOCITY
  before_eye.xyz = (previous_view_projection * vec4(eye - (self.center - self.previous_center), 1.0)).xyw;
#endif

  // Slopes between the tangent planes along x and y, a pixel wider on each side.
  vec2 pixel = 1.0 / focal;
  vec2 bounds_x = slopeBounds(c.x, z, r) + vec2(-pixel.x, pixel.x), bounds_y = slopeBounds(c.y, z, r) + vec2(-pixel.y, pixel.y);
  vec2 low = vec2(bounds_x.x, bounds_y.x), high = vec2(bounds_x.y, bounds_y.y);
#if OCTAGON
  // And along both diagonals, unless a plane is nearly beside the eye, or the sphere is so small that in software the edges between the
  // triangles cost more than the corners: pixels are shaded in blocks of 4 x 2, twice where an edge crosses. So the long edges are
  // horizontal. Pairs from bottom to top, the left one first: on the lower side, at the lower and the upper end of the left and right side,
  // on the upper side.
  const float kHalf = 0.70710678, kFar = 8.0, kLeast = 56.0;  // kLeast: pixels across
  vec2 wider = vec2(-1.25, 1.25) * max(pixel.x, pixel.y);  // half a pixel of shift (edgeOf), 0.71 of a slanted ramp
  vec2 sum = (slopeBounds((c.x + c.y) * kHalf, z, r) + wider) / kHalf;
  vec2 difference = (slopeBounds((c.x - c.y) * kHalf, z, r) + wider) / kHalf;
  vec4 far = max(max(abs(bounds_x), abs(bounds_y)).xyxy, abs(vec4(sum, difference)));
  bool octagon = max(max(far.x, far.y), max(far.z, far.w)) < kFar && all(greaterThan((high - low) * focal, vec2(kLeast)));
  if (!octagon) sum = difference = vec2(-1e30, 1e30);
  bool right = (gl_VertexID & 1) != 0;
  int pair = gl_VertexID >> 1;
  vec2 slope = vec2(right ? high.x : low.x, pair < 2 ? low.y : high.y);
  bool at_end = pair == 0 || pair == 3, lower = pair < 2;
  if (at_end && right) slope.x = min(slope.x, lower ? difference.y + slope.y : sum.y - slope.y);
  if (at_end && !right) slope.x = max(slope.x, lower ? sum.x - slope.y : difference.x + slope.y);
  if (!at_end && lower) slope.y = max(slope.y, right ? slope.x - difference.y : sum.x - slope.x);
  if (!at_end && !lower) slope.y = min(slope.y, right ? sum.y - slope.x : slope.x - difference.x);
#else
  const bool octagon = false;
  vec2 slope = vec2((gl_VertexID & 1) == 0 ? low.x : high.x, gl_VertexID >> 1 == 0 ? low.y : high.y);
#endif
  vec2 ndc = slope * vec2(projection[0].x, projection[1].y) - projection[2].xy;
  if (!octagon) ndc = clamp(ndc, -1.0, 1.0);
  // Behind the near plane, without extent or not a number: nothing to draw.
  bool visible = z + r > near_plane && r > 0.0 && d2 < 1e30;
  gl_Position = visible ? vec4(ndc, 0.5, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
