// Which part of the environment's maps a surface of some roughness reflects: all that vertex shaders need of shading/ibl.glsl.
// Samplers: irradiance?, specular? and environment? (`as linear wrap`; the last has the mips of a box filter and is what surfaces smoother than
// level 0 of the specular map reflect; without it they are as rough as that level). Block brightest? (`as uniform`): the spot that the
// specular map lacks, see ibl/brightest.glsl; its reflection is in closed form.
// Parameter sky_turn?: by how much of a full turn the environment is rotated. The includer declares the block Parameters before, see
// shading/parameters.glsl.
// SPECULAR_AA: a pixel sees a cone of reflected directions, twice its width over the radius of curvature (ray
// cones, Akenine-Moeller et al., JCGT 10(1), 2021). Mirrors read the environment at the level where a texel is that wide; rough
// surfaces add its variance to that of their lobe (Tokuyoshi and Kaplanyan, "Improved geometric specular antialiasing", I3D
// 2019, with the curvature known instead of derivatives). Nothing depends on the resolution but through that cone.
#ifndef SHADING_LOBE_GLSL
#define SHADING_LOBE_GLSL

#include "common/equirect.glsl"
#include "ibl/roughness_level.glsl"
#ifdef HAS_BRIGHTEST
#include "ibl/brightest.glsl"
#endif

#ifndef SPECULAR_AA
#define SPECULAR_AA 1
#endif

#ifndef HAS_SKY_TURN
const float sky_turn = 0.0;
#endif

#ifdef HAS_IRRADIANCE
uniform sampler2D irradiance;
#endif
#ifdef HAS_SPECULAR
uniform sampler2D specular;
#ifdef HAS_ENVIRONMENT
uniform sampler2D environment;
#endif
#endif

// What a surface of one roughness reads of the maps, and how it sees the brightest spot. The same for a whole sphere.
struct Lobe {
  vec4 maps;     // x level of the environment, y of the specular map, z weight of the latter, w by what Response::lobe.y changes y
  vec4 poles;    // how close v may come to the poles: x of the environment, y of the specular map's level 0, z of the irradiance; w the specular map's last level
  vec3 spot;     // towards it, in the world
  vec4 widths;   // of its reflection, see ibl/brightest.glsl
  float share;   // of its light that is reflected in closed form, over 2 pi
  float cut;     // the share by which what is too bright near the spot (brightest_at.w) is cut out of what is read of the environment
  vec2 glint;    // of a small sphere: where the spot is seen, in pixels; see spheres/glint.glsl
  vec3 shares;   // its share of a pixel at the distance d: z g.x g.y / ((1 + y g.x + g.x^2) (1 + y g.y + g.y^2)), g = exp2(-x |d|)
};

// `bend`: radians the normals of a sphere span in a pixel where they face the eye. In the plane of incidence the cone of reflected
// directions is 2 bend / nv wide, across it 2 bend nv; half of their product, which is constant on the sphere, counts, since the
// sampler's filter is two texels wide (that half is also what differs least from supersampling, measured).
// Not for fragments that have the lobe from the vertex shader (LOBE_IS_FLAT, see shading/light.glsl): a function counts, called or not.
#if !defined LOBE_IS_FLAT || LOBE_IS_FLAT == 0
#ifdef HAS_SPECULAR
Lobe lobeOf(float roughness, float bend) {
  Lobe lobe = Lobe(vec4(0.0), vec4(0.0), vec3(0.0, 1.0, 0.0), vec4(0.0, 1.0, 0.0, 0.0), 0.0, 0.0, vec2(0.0), vec3(0.0, 1.0, 0.0));
  int levels = textureQueryLevels(specular);
  float alpha = alphaOfRoughness(roughness);
  // Variance along each axis: 2 alpha^2 of the lobe, (2 bend)^2 / 12 of the pixel (a box).
#if SPECULAR_AA
  float wider = sqrt(min(alpha * alpha + bend * bend / 6.0, 1.0));
#else
  float wider = alpha;
  bend = 0.0;
#endif
  // The pixel's part of the width is the same all over a sphere; only the lobe's own changes with the view.
  float own = alpha * alpha / max(wider * wider, 1e-12);
  lobe.poles.yw = vec2(0.5 / float(textureSize(specular, 0).y), levels - 1);
  lobe.maps = vec4(0.0, levelOfAlpha(wider, levels), 1.0, own * lobe.poles.w);
#ifdef HAS_IRRADIANCE
  lobe.poles.z = 0.5 / float(textureSize(irradiance, 0).y);
#endif
#ifdef HAS_ENVIRONMENT
  // From half of level 0's roughness on the lobe takes over, or where the pixel is as wide as level 0; up to there and between, the
  // environment is as blurred as the lobe is wide.
  vec2 size = vec2(textureSize(environment, 0));
  float most = float(textureQueryLevels(environment) - 1);
  float blurred = sqrt(wider);
  lobe.maps.z = clamp(max(2.0 * roughness / kSharpest - 1.0, 5.0 * blurred / kSharpest - 4.5), 0.0, 1.0);
#if SPECULAR_AA
  float sharp = min(equirectLevel(size.x, sqrt(2.0 * bend * bend + 4.0 * alpha * alpha)), most);
#else
  float sharp = max(log2(size.y / float(textureSize(specular, 0).y)), equirectLevel(size.x, 2.0 * alpha));
#endif
  lobe.maps.x = lobe.maps.z < 1.0 ? sharp : most;  // the cheapest to read where it does not count
  lobe.poles.x = equirectLookup(lobe.maps.x, 0.5 / size.y).y;
#endif
#ifdef HAS_BRIGHTEST
  lobe.spot = towardsBrightest(sky_turn);
  float share = 1.0;
#ifdef HAS_ENVIRONMENT
  // Cutting it out of the environment takes texels that are small beside the window.
  float fine = clamp(2.0 - 25.0 * exp2(lobe.maps.x) * 2.0 * kPi / size.x, 0.0, 1.0);
  share = max(lobe.maps.z, fine * min(2.0 * blurred / kSharpest, 1.0));
  lobe.cut = lobe.maps.z < 1.0 ? (share - lobe.maps.z) / (1.0 - lobe.maps.z) : 0.0;
#endif
  lobe.share = share / (2.0 * kPi);
  lobe.widths = spotWidths(max(alpha, 0.001), min(0.25 * brightest_light.w + bend * bend / 12.0, 0.25));
#endif
  return lobe;
}
#else
Lobe lobeOf(float roughness, float bend) {
  Lobe lobe = Lobe(vec4(0.0), vec4(0.0), vec3(0.0, 1.0, 0.0), vec4(0.0, 1.0, 0.0, 0.0), 0.0, 0.0, vec2(0.0), vec3(0.0, 1.0, 0.0));
#ifdef HAS_IRRADIANCE
  lobe.poles.z = 0.5 / float(textureSize(irradiance, 0).y);
#endif
  return lobe;
}
#endif
#endif

#endif
