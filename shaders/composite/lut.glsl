// A table of colors, as the import cube_lut gives it. Takes and gives display-referred, encoded values. Bound `as linear`.
// A 3D table is as deep as it is wide. A 1D table (three curves) is not, and has its entries along rows.
#ifndef COMPOSITE_LUT_GLSL
#define COMPOSITE_LUT_GLSL

vec4 lutEntry(sampler3D table, int i) {
  int width = textureSize(table, 0).x;
  return texelFetch(table, ivec3(i % width, i / width, 0), 0);
}

vec3 applyCurves(sampler3D table, vec3 encoded) {
  // The alpha of the first eight entries has the domain and the number of entries.
  vec3 low = vec3(lutEntry(table, 0).a, lutEntry(table, 2).a, lutEntry(table, 4).a);
  vec3 high = vec3(lutEntry(table, 1).a, lutEntry(table, 3).a, lutEntry(table, 5).a);
  int n = int(lutEntry(table, 6).a) * 1024 + int(lutEntry(table, 7).a);
  vec3 at = clamp((encoded - low) / (high - low), 0.0, 1.0) * float(n - 1);
  ivec3 i = min(ivec3(at), n - 2);
  vec3 here = vec3(lutEntry(table, i.r).r, lutEntry(table, i.g).g, lutEntry(table, i.b).b);
  vec3 next = vec3(lutEntry(table, i.r + 1).r, lutEntry(table, i.g + 1).g, lutEntry(table, i.b + 1).b);
  return mix(here, next, at - vec3(i));
}

vec3 applyLut(sampler3D table, vec3 encoded) {
  ivec3 size = textureSize(table, 0);
  if (size.x != size.z) return applyCurves(table, encoded);
  // The alpha of the corners has the domain.
  vec3 low = vec3(texelFetch(table, ivec3(0), 0).a, texelFetch(table, ivec3(0, 1, 0), 0).a,
                  texelFetch(table, ivec3(0, 0, 1), 0).a);
  vec3 high = vec3(texelFetch(table, ivec3(1, 0, 0), 0).a, texelFetch(table, ivec3(1, 1, 0), 0).a,
                   texelFetch(table, ivec3(1, 0, 1), 0).a);
  vec3 at = clamp((encoded - low) / (high - low), 0.0, 1.0);
  float n = float(size.x);
  return textureLod(table, (at * (n - 1.0) + 0.5) / n, 0.0).rgb;  // first and last entries are at texel centers
}

#endif
