// Image-based lighting of one surface point: GGX split sum (Karis 2013) with the energy that single scattering loses put
// back (Fdez-Aguera, JCGT 2019: exact for metals in a white furnace whatever the roughness) and a diffuse layer that
// gets what the specular one leaves. Samplers: brdf (`as linear`), irradiance?, specular? and environment? (`as linear wrap`;
// the last one has the mips of a box filter and takes the place of the specular map's level 0).
// COMPENSATION 0 leaves the lost energy out.
// SPECULAR_AA: a pixel sees a cone of reflected directions, twice its width over the radius of curvature (ray
// cones, Akenine-Moeller et al., JCGT 10(1), 2021). Mirrors read the environment at the level where a texel is that wide; rough
// surfaces add its variance to that of their lobe (Tokuyoshi and Kaplanyan, "Improved geometric specular antialiasing", I3D
// 2019, with the curvature known instead of derivatives). Nothing depends on the resolution but through that cone.
// probes (with sh?): light that other things throw back is added to the diffuse light, see gi/bounce.glsl.
// Parameter sky_turn?: by how much of a full turn the environment is rotated. The includer declares the block Parameters before.
#ifndef SHADING_IBL_GLSL
#define SHADING_IBL_GLSL

#include "common/equirect.glsl"
#include "ibl/roughness_level.glsl"
#ifdef HAS_PROBES
#include "gi/bounce.glsl"
#endif

#ifndef COMPENSATION
#define COMPENSATION 1
#endif
#ifndef SPECULAR_AA
#define SPECULAR_AA 1
#endif

uniform sampler2D brdf;
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

struct Surface {
  vec3 albedo;
  float metallic;
  float roughness;
};

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
#if SPECULAR_AA
  float sharp = min(equirectLevel(size.x, sqrt(2.0) * bend), float(textureQueryLevels(environment) - 1));
#else
  float sharp = max(log2(size.y / float(textureSize(specular, 0).y)), 0.0);
#endif
  float weight = min(levelOfRoughness(roughness, levels), 1.0);
  return vec3(weight < 1.0 ? sharp : float(textureQueryLevels(environment) - 1), max(level, 1.0), weight);
#else
  return vec3(0.0, level, 1.0);
#endif
}

// Light from around the mirror direction.
vec3 reflection(vec3 lobe, vec3 mirror) {
  vec2 at = equirectUv(mirror) - vec2(sky_turn, 0.0);
  vec3 sum = vec3(0.0);
  if (lobe.z > 0.0) sum = lobe.z * sampleEquirect(specular, at, lobe.y, float(textureSize(specular, 0).y)).rgb;
#ifdef HAS_ENVIRONMENT
  if (lobe.z < 1.0) sum += (1.0 - lobe.z) * sampleEquirect(environment, at, lobe.x, float(textureSize(environment, 0).y)).rgb;
#endif
  return sum;
}
#else
vec3 lobeOf(float roughness, float bend) { return vec3(0.0); }
#endif

// What a surface does with light, seen at the cosine `nv`: the share that single scattering reflects, the share that comes out after
// several, spread all round, and the share of the diffuse layer below.
struct Response {
  vec3 f0, single, multiple, diffuse;
};
Response responseOf(Surface surface, float nv) {
  vec2 split = textureLod(brdf, vec2(nv, surface.roughness), 0.0).rg;
  vec3 f0 = mix(vec3(0.04), surface.albedo, surface.metallic);
  vec3 single = f0 * split.x + split.y;
  vec3 diffuse = surface.albedo * (1.0 - surface.metallic);
#if COMPENSATION
  float lost = 1.0 - split.x - split.y;
  vec3 average = f0 + (1.0 - f0) / 21.0;  // Schlick's Fresnel over the hemisphere
  vec3 multiple = single * average * lost / (1.0 - lost * average);
  return Response(f0, single, multiple, diffuse * (1.0 - single - multiple));
#else
  return Response(f0, single, vec3(0.0), diffuse * (1.0 - single));
#endif
}

#ifdef HAS_IRRADIANCE
vec3 fromEnvironment(vec3 normal) {
  return sampleEquirect(irradiance, equirectUv(normal) - vec2(sky_turn, 0.0), 0.0, float(textureSize(irradiance, 0).y)).rgb;
}
#endif

// Mean radiance around `normal` at `position`, weighted by the cosine: of the environment, and of the probes. Both are of the world;
// without probes the position is of no account.
vec3 lightAround(vec3 position, vec3 normal) {
  vec3 around = vec3(0.0);
#ifdef HAS_IRRADIANCE
  around = fromEnvironment(normal);
#ifdef HAS_PROBES
  Bounce bounce = bounceAt(position, normal);
  around += bounced(bounce, fromEnvironment(bounce.facing), fromEnvironment(-bounce.facing));
#endif
#endif
  return around;
}

// `position`, `normal` and `mirror` are of the world, `nv` the cosine of the normal to the eye, 0..1; `lobe` from lobeOf.
vec3 shade(Surface surface, vec3 position, vec3 normal, vec3 mirror, float nv, vec3 lobe) {
  vec3 around = lightAround(position, normal), reflected = vec3(0.0);
#ifdef HAS_SPECULAR
  reflected = reflection(lobe, mirror);
#endif
  Response response = responseOf(surface, nv);
  return response.single * reflected + (response.multiple + response.diffuse) * around;
}

#endif
