// Makes a Lobe of a surface's roughness and curvature, in the vertex or the fragment stage.
// define  SPECULAR_AA: a pixel sees a cone of reflected directions, twice its width over the radius of curvature (ray cones,
// Akenine-Moeller et al., JCGT 10(1), 2021). Mirrors read the environment at the level where a texel is that wide; rough surfaces add its
// variance to that of their lobe (Tokuyoshi and Kaplanyan, "Improved geometric specular antialiasing", I3D 2019, with the curvature known
// instead of derivatives). Nothing depends on the resolution but through that cone.
#ifndef SHADING_LOBE_GLSL
#define SHADING_LOBE_GLSL

#include "shading/environment.glsl"

#ifndef SPECULAR_AA
#define SPECULAR_AA 1
#endif

// `bend`: radians that the normals of a sphere span in a pixel where they face the eye. In the plane of incidence the cone of reflected
// directions is 2 bend / nv wide, across it 2 bend nv; half of their product, which is constant on the sphere, counts, since the
// sampler's filter is two texels wide (that half is also what differs least from supersampling, measured).
Lobe lobeOf(float roughness, float bend) {
  float alpha = alphaOfRoughness(roughness);
#if !SPECULAR_AA
  bend = 0.0;
#endif
  // Variance along each axis: 2 alpha^2 of the lobe, (2 bend)^2 / 12 of the pixel (a box).
  float wider = sqrt(min(alpha * alpha + bend * bend / 6.0, 1.0)), blurred = sqrt(wider);
  Lobe lobe = Lobe(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, vec3(0.0, 1.0, 0.0), SpotShape(0.0, 1.0, 0.0, 0.0), vec3(0.0),
                   spots[0].at.w, 0.0);
#ifdef HAS_IRRADIANCE
  lobe.irradiance_pole = 0.5 / float(textureSize(irradiance, 0).y);
#endif
#ifdef HAS_SPECULAR
  int levels = textureQueryLevels(specular);
  lobe.specular_pole = 0.5 / float(textureSize(specular, 0).y);
  lobe.last_level = float(levels - 1);
  lobe.specular_level = levelOfAlpha(wider, levels);
  // The pixel's part of the width is the same all over a sphere; only the lobe's own changes with the view.
  lobe.level_per_shift = alpha * alpha / max(wider * wider, 1e-12) * lobe.last_level;
  float share = 1.0;
#ifdef HAS_ENVIRONMENT
  // From half of level 0's roughness on `specular` takes over, or where the pixel is as wide as level 0; up to there and between, the
  // environment is as blurred as the lobe is wide.
  vec2 size = vec2(textureSize(environment, 0));
  float most = float(textureQueryLevels(environment) - 1);
#if SPECULAR_AA
  float sharp = min(equirectLevel(size.x, sqrt(2.0 * bend * bend + 4.0 * alpha * alpha)), most);
#else
  float sharp = max(log2(size.y / float(textureSize(specular, 0).y)), equirectLevel(size.x, 2.0 * alpha));
#endif
  lobe.specular_weight = clamp(max(2.0 * roughness / kSharpest - 1.0, 5.0 * blurred / kSharpest - 4.5), 0.0, 1.0);
  lobe.environment_level = lobe.specular_weight < 1.0 ? sharp : most;  // the cheapest to read where it does not count
  lobe.environment_pole = equirectLookup(lobe.environment_level, 0.5 / size.y).y;
  // Cutting the spot out of the environment takes texels that are small beside the window.
  float fine = clamp(2.0 - 25.0 * exp2(lobe.environment_level) * 2.0 * kPi / size.x, 0.0, 1.0);
  share = max(lobe.specular_weight, fine * min(2.0 * blurred / kSharpest, 1.0));
  lobe.spot_cut = lobe.specular_weight < 1.0 ? (share - lobe.specular_weight) / (1.0 - lobe.specular_weight) : 0.0;
#endif
  lobe.spot = towardsSpot(0, sky_turn);
  lobe.spot_light = spots[0].light.rgb * (share / (2.0 * kPi));
  lobe.spot_shape = spotShape(max(alpha, 0.5 * LEAST_ALPHA), min(0.25 * spots[0].light.w + bend * bend / 12.0, 0.25));
#endif
  return lobe;
}

#endif
