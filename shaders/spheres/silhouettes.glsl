// The part of a sphere's share of a pixel that the spheres in front of it leave. Included after to_world and
// spheres/billboard_varyings.glsl.
// read    silhouettes?   the import silhouettes: uvec4(first, number, 0, 0) per instance, then per sphere in front of it the bits of
//                        vec4(center from the eye, radius)
#ifndef SPHERES_SILHOUETTES_GLSL
#define SPHERES_SILHOUETTES_GLSL

#ifdef HAS_SILHOUETTES
layout(std430) readonly buffer silhouettes { uvec4 silhouette[]; };

// Spheres are blended back to front: of a share `a` of the pixel that lies behind another share `b`, blending leaves a (1 - b), as if the
// two edges were independent. This is the factor of `a` by which exactly what lies outside of `b` is left. `inside`: signed distance in
// pixels from the sphere's own edge, whose normal is `outwards`; `v` is the ray, `vv` its squared length. Both edges are straight within a
// pixel; eight rows of it are exact. Where several spheres are in front, each takes its part of what the others leave.
float leftBehind(float inside, vec2 outwards, vec3 v, float vv) {
  float left = 1.0;
  // First and number of the spheres in front. They are not valid when the buffer belongs to another list than the one drawn.
  uint rows = uint(silhouette.length());
  uvec2 in_front = silhouette[min(readRow(), rows - 1u)].xy;
  if (in_front.x >= rows || in_front.y > min(rows - in_front.x, 32u)) in_front.y = 0u;
  for (uint i = 0u; i < in_front.y; ++i) {
    vec4 other = uintBitsToFloat(silhouette[in_front.x + i]);
    vec3 c = transpose(to_world) * other.xyz, cv = cross(c, v);  // in view space
    // The other silhouette is a conic, too: half its gradient, and the signed distance in pixels to first order.
    float along_c = dot(c, v), r2 = other.w * other.w;
    vec2 others = ((dot(c, c) - r2) * v.xy - along_c * c.xy) * anchor_slope.zw;
    float per_steep = 1.0 / max(length(others), 1e-30), outside = 0.5 * (dot(cv, cv) - r2 * vv) * per_steep;
    others *= per_steep;
    if (abs(outside) > 0.70710678 || along_c <= 0.0) continue;
    // Along the axis that the edges cross rather than follow.
    bool turned = abs(outwards.x) + abs(others.x) < abs(outwards.y) + abs(others.y);
    vec2 along = turned ? vec2(outwards.y, others.y) : vec2(outwards.x, others.x);
    vec2 beside = turned ? vec2(outwards.x, others.x) : vec2(outwards.y, others.y);
    // In a row, what is inside an edge goes from one end of the pixel to the edge, and inside both is the lesser part where both begin at the
    // same end, else what is more than a whole row.
    vec2 per = 1.0 / max(abs(along), 1e-4), first = vec2(inside, -outside) * per, slope = beside * per;
    float same = along.x * along.y < 0.0 ? -1.0 : 1.0, beyond = 0.0;
    vec2 within = vec2(0.5);
    for (float row = -0.4375; row < 0.5; row += 0.125) {
      vec2 to = clamp(first - slope * row, -0.5, 0.5);
      within += 0.125 * to;
      beyond += 0.125 * max(to.x - same * to.y, 0.0);
    }
    vec3 sums = vec3(within, same > 0.0 ? within.x - beyond : beyond);  // inside the one, inside the other, inside both
    left *= (sums.x - sums.z) / max(sums.x * (1.0 - sums.y), 1e-4);
  }
  return left;
}
#endif

#endif
