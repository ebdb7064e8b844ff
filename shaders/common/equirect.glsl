// Equirectangular maps: u = atan2(z, x) / 2pi + 1/2, v = 1/2 - asin(y) / pi, row 0 at the top (+Y).
// Samplers are expected `as linear wrap`: u wraps, and v is kept half a texel inside so that the poles do not wrap too.
// Every lookup names its level, so no derivative is taken where u jumps from 1 to 0 and there is no seam.
#ifndef COMMON_EQUIRECT_GLSL
#define COMMON_EQUIRECT_GLSL

const float kPi = 3.14159265358979;

// atan(y, x) of two angles at once, with an error below 1.1e-5 rad (a sixth of a percent of a texel of a 1024 map); x and y not both
// zero. Odd polynomial of degree 11 on [0, 1]: Hastings, "Approximations for Digital Computers", 1955, sheet 11.
vec2 fastAtan(vec2 y, vec2 x) {
  vec2 ax = abs(x), ay = abs(y);
  vec2 t = min(ax, ay) / max(max(ax, ay), 1e-30);
  vec2 s = t * t;
  vec2 r = ((((-0.01172120 * s + 0.05265332) * s - 0.11643287) * s + 0.19354346) * s - 0.33262347) * s + 0.99997726;
  r *= t;
  r = mix(r, 0.5 * kPi - r, greaterThan(ay, ax));
  r = mix(r, kPi - r, lessThan(x, vec2(0.0)));
  return mix(r, -r, lessThan(y, vec2(0.0)));
}

// The direction need not be normalised.
vec2 equirectUv(vec3 direction) {
  vec2 angles = fastAtan(direction.zy, vec2(direction.x, length(direction.xz)));
  return vec2(0.5 + angles.x * (0.5 / kPi), 0.5 - angles.y * (1.0 / kPi));
}

// Level at which a texel of the map at the equator is as wide as `angle` radians; 0 when the map is magnified.
float equirectLevel(float base_width, float angle) {
  return max(log2(angle * base_width * (0.5 / kPi)), 0.0);
}

// For a lookup at `level` of a map whose level 0 is `height` texels high: the level, and how close v may come to the poles.
vec2 equirectLookup(float level, float height) {
  float texels = uintBitsToFloat(uint(127 + int(ceil(level))) << 23);  // exp2 of a whole number: a texel of the coarser level
  return vec2(level, 0.5 * texels / height);
}

// Linear lookup; `lookup` from equirectLookup. u may lie outside 0..1: subtracting part of a turn moves the map's content by it about +Y,
// from +X towards +Z.
vec4 sampleEquirect(sampler2D map, vec2 map_uv, vec2 lookup) {
  return textureLod(map, vec2(map_uv.x, clamp(map_uv.y, lookup.y, 1.0 - lookup.y)), lookup.x);
}

#endif
