// A table of colors, as the import cube_lut gives it. Takes and gives display-referred, encoded values. Bound `as linear`.
// A 3D table is as wide as high. Curves (a 1D table) are in two slices of rows, or behind the slices of a 3D table that
// is to be looked up with what they give.
#ifndef COMPOSITE_LUT_GLSL
#define COMPOSITE_LUT_GLSL

vec4 lutEntry(sampler3D table, int slice, int i) {
  ivec2 size = textureSize(table, 0).xy;
  return texelFetch(table, ivec3(i % size.x, i / size.x % size.y, slice + i / (size.x * size.y)), 0);
}

// The curves that begin in a slice.
vec3 applyCurves(sampler3D table, int slice, vec3 encoded) {
  // The alpha of the first eight entries has the domain and the number of entries.
  float about[8];
  for (int i = 0; i < 8; ++i) about[i] = lutEntry(table, slice, i).a;
  vec3 low = vec3(about[0], about[2], about[4]), high = vec3(about[1], about[3], about[5]);
  int n = int(about[6]) * 1024 + int(about[7]);
  vec3 at = clamp((encoded - low) / (high - low), 0.0, 1.0) * float(n - 1);
  ivec3 i = min(ivec3(at), n - 2);
  vec3 here = vec3(lutEntry(table, slice, i.r).r, lutEntry(table, slice, i.g).g, lutEntry(table, slice, i.b).b);
  vec3 next = vec3(lutEntry(table, slice, i.r + 1).r, lutEntry(table, slice, i.g + 1).g, lutEntry(table, slice, i.b + 1).b);
  return mix(here, next, at - vec3(i));
}

vec3 applyLut(sampler3D table, vec3 encoded) {
  ivec3 size = textureSize(table, 0);
  if (size.z == 2 && size.x > 2) return applyCurves(table, 0, encoded);
  if (size.z > size.x) encoded = applyCurves(table, size.x, encoded);
  // The alpha of the corners has the domain.
  vec3 low = vec3(texelFetch(table, ivec3(0), 0).a, texelFetch(table, ivec3(0, 1, 0), 0).a,
                  texelFetch(table, ivec3(0, 0, 1), 0).a);
  vec3 high = vec3(texelFetch(table, ivec3(1, 0, 0), 0).a, texelFetch(table, ivec3(1, 1, 0), 0).a,
                   texelFetch(table, ivec3(1, 0, 1), 0).a);
  vec3 at = clamp((encoded - low) / (high - low), 0.0, 1.0);
  return textureLod(table, (at * float(size.x - 1) + 0.5) / vec3(size), 0.0).rgb;  // first and last entries are at texel centers
}

#endif
