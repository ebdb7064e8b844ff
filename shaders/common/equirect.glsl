// Equirectangular maps: u = atan2(z, x) / 2pi + 1/2, v = 1/2 - asin(y) / pi, row 0 at the top (+Y).
// Samplers are expected `as linear wrap`: u wraps, and v is kept half a texel inside so that the poles do not wrap too.
// Every lookup has an explicit level, so no derivative is taken where u jumps from 1 to 0 and there is no seam.
#ifndef COMMON_EQUIRECT_GLSL
#define COMMON_EQUIRECT_GLSL

const float kPi = 3.14159265358979;

// The direction need not be normalized. Both angles as in fastAtan() of common/fast_atan.glsl; the second is between -pi/2 and pi/2.
vec2 equirectUv(vec3 direction) {
  vec2 ax = vec2(abs(direction.x), length(direction.xz)), ay = abs(direction.zy);
  vec2 t = min(ax, ay) / max(max(ax, ay), 1e-30);
  vec2 s = t * t;
  vec2 r = ((((-0.01172120 * s + 0.05265332) * s - 0.11643287) * s + 0.19354346) * s - 0.33262347) * s + 0.99997726;
  r *= t;
  r = mix(r, 0.5 * kPi - r, greaterThan(ay, ax));
  r.x = direction.x < 0.0 ? kPi - r.x : r.x;
  r = mix(r, -r, lessThan(direction.zy, vec2(0.0)));
  return vec2(0.5 + r.x * (0.5 / kPi), 0.5 - r.y * (1.0 / kPi));
}

// Level at which a texel of the map at the equator is as wide as `angle` radians; 0 when the map is magnified.
float equirectLevel(float base_width, float angle) {
  return max(log2(angle * base_width * (0.5 / kPi)), 0.0);
}

// For a lookup at `level` of a map: the level, and how close v may come to the poles, which at level 0 is `pole`, half a texel.
vec2 equirectLookup(float level, float pole) {
  float texels = uintBitsToFloat(uint(127 + int(ceil(level))) << 23);  // exp2 of a whole number: a texel of the coarser level
  return vec2(level, texels * pole);
}

// Linear lookup; `lookup` from equirectLookup. u may lie outside 0..1: subtracting part of a turn moves the map's content by it about +Y,
// from +X towards +Z.
vec4 sampleEquirect(sampler2D map, vec2 map_uv, vec2 lookup) {
  return textureLod(map, vec2(map_uv.x, clamp(map_uv.y, lookup.y, 1.0 - lookup.y)), lookup.x);
}

// Pixels of `angle` radians across a texel of a level with so many rows.
float texelWidth(float rows, float angle) { return kPi / (rows * angle); }

// The share of a lookup that is cubic: 0 up to where a texel is as wide as a pixel, 1 from where it is twice as wide. A linear lookup shows
// such texels as squares.
float splineShare(float rows, float angle) { return clamp(texelWidth(rows, angle) - 1.0, 0.0, 1.0); }

// sampleEquirect() on the texels of a level of `size`, with `share` of a cubic B-spline in the weights and the rest linear. Four linear lookups
// have the weights of 16 texels: each takes two texels along both axes, at the place between them that has the weights' ratio.
vec4 sampleEquirectSmooth(sampler2D map, vec2 map_uv, vec2 lookup, vec2 size, float share) {
  vec2 at = map_uv * size - 0.5, f = fract(at), g = 1.0 - f;
  vec2 first = share / 6.0 * g * g * g, last = share / 6.0 * f * f * f;
  vec2 after = mix(f, (((-3.0 * f + 3.0) * f + 3.0) * f + 1.0) / 6.0, share), high = after + last;
  vec2 low = 1.0 - high, from = (floor(at) + 0.5 - first / low) / size, to = (floor(at) + 1.5 + last / high) / size;
  if (share == 0.0) from = to = map_uv;  // no return: software drivers run both sides of a branch
  return low.y * (low.x * sampleEquirect(map, from, lookup) + high.x * sampleEquirect(map, vec2(to.x, from.y), lookup)) +
         high.y * (low.x * sampleEquirect(map, vec2(from.x, to.y), lookup) + high.x * sampleEquirect(map, to, lookup));
}

#endif
