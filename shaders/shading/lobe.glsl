// Which part of the environment's maps a surface of some roughness reflects: all that vertex shaders need of shading/ibl.glsl.
// Samplers: specular? and environment? (`as linear wrap`; the latter has the mips of a box filter and takes the place of the specular
// map's level 0).
// SPECULAR_AA: a pixel sees a cone of reflected directions, twice its width over the radius of curvature (ray
// cones, Akenine-Moeller et al., JCGT 10(1), 2021). Mirrors read the environment at the level where a texel is that wide; rough
// surfaces add its variance to that of their lobe (Tokuyoshi and Kaplanyan, "Improved geometric specular antialiasing", I3D
// 2019, with the curvature known instead of derivatives). Nothing depends on the resolution but through that cone.
#ifndef SHADING_LOBE_GLSL
#define SHADING_LOBE_GLSL

#include "common/equirect.glsl"
#include "ibl/roughness_level.glsl"

#ifndef SPECULAR_AA
#define SPECULAR_AA 1
#endif

#ifdef HAS_SPECULAR
uniform sampler2D specular;
#ifdef HAS_ENVIRONMENT
uniform sampler2D environment;
#endif
#endif

// What of the maps a sphere reads: x level of the environment, y level of the specular map, z weight of the latter; at weight 1
// the environment's last level, whose lookup is cheapest where branches save nothing. `bend`:
// radians its normals span in a pixel where they face the eye. In the plane of incidence the cone of reflected directions is
// 2 bend / nv wide, across it 2 bend nv; half of their product, which is constant on the sphere, counts, since the sampler's
// filter is two texels wide (that half is also what differs least from supersampling, measured).
#ifdef HAS_SPECULAR
vec3 lobeOf(float roughness, float bend) {
  int levels = textureQueryLevels(specular);
  float level = levelOfRoughness(roughness, levels);
#if SPECULAR_AA
  // Variance along each axis: 2 alpha^2 of the lobe, (2 bend)^2 / 12 of the pixel (a box).
  float alpha = alphaOfRoughness(roughness);
  level = levelOfRoughness(sqrt(sqrt(min(alpha * alpha + bend * bend / 6.0, 1.0))), levels);
#endif
#ifdef HAS_ENVIRONMENT
  vec2 size = vec2(textureSize(environment, 0));
  float last = float(textureQueryLevels(environment) - 1);
#if SPECULAR_AA
  float sharp = min(equirectLevel(size.x, sqrt(2.0) * bend), last);
#else
  float sharp = max(log2(size.y / float(textureSize(specular, 0).y)), 0.0);
#endif
  float weight = min(levelOfRoughness(roughness, levels), 1.0);
  return vec3(weight < 1.0 ? sharp : last, max(level, 1.0), weight);
#else
  return vec3(0.0, level, 1.0);
#endif
}
#else
vec3 lobeOf(float roughness, float bend) { return vec3(0.0); }
#endif

#endif
