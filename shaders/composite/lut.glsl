// A 3D table of colours, as the import cube_lut gives it: display-referred, encoded, in and out. Bound `as linear`.
#ifndef COMPOSITE_LUT_GLSL
#define COMPOSITE_LUT_GLSL

vec3 applyLut(sampler3D table, vec3 encoded) {
  // The domain stands in the alpha of the corners.
  vec3 low = vec3(texelFetch(table, ivec3(0), 0).a, texelFetch(table, ivec3(0, 1, 0), 0).a,
                  texelFetch(table, ivec3(0, 0, 1), 0).a);
  vec3 high = vec3(texelFetch(table, ivec3(1, 0, 0), 0).a, texelFetch(table, ivec3(1, 1, 0), 0).a,
                   texelFetch(table, ivec3(1, 0, 1), 0).a);
  vec3 at = clamp((encoded - low) / (high - low), 0.0, 1.0);
  float n = float(textureSize(table, 0).x);
  return textureLod(table, (at * (n - 1.0) + 0.5) / n, 0.0).rgb;  // first and last entries are at texel centres
}

#endif
