// Finds, for a vertex shader, what neighbours/listed.glsl describes.
// Slots neighbours, irradiance?
#ifndef NEIGHBOURS_ROW_GLSL
#define NEIGHBOURS_ROW_GLSL

#include "neighbours/listed.glsl"
#include "shading/lobe.glsl"

// Of the sphere of that row.
Listed listedOf(uint row) {
  // By a nearest sampler: in software a fetch that is told its level as a float costs less than one by whole numbers.
  vec2 texel = 1.0 / vec2(textureSize(neighbours, 0));
  vec4 common_row = textureLod(neighbours, 0.5 * texel, 0.0);
  Listed listed = Listed(vec3((vec2(neighbourTexel(row, 0)) + 0.5) * texel, texel.x), common_row.x, common_row.w, common_row.y, common_row.z,
                         textureLod(neighbours, vec2(1.5, 0.5) * texel, 0.0).rgb, vec3(0.0), vec3(0.0));
#ifdef HAS_IRRADIANCE
  vec2 lookup = vec2(0.0, 0.5 / float(textureSize(irradiance, 0).y));
  listed.above = sampleEquirect(irradiance, vec2(0.0), lookup).rgb;
  listed.below = sampleEquirect(irradiance, vec2(0.0, 1.0), lookup).rgb;
#endif
  return listed;
}

#endif
