// Image-based lighting of one surface point: GGX split sum (Karis 2013) with the energy that single scattering loses put
// back (Fdez-Aguera, JCGT 2019: exact for metals in a white furnace whatever the roughness) and a diffuse layer that
// gets what the specular one leaves. Samplers: brdf (`as linear`), irradiance? and specular? (`as linear wrap`).
// COMPENSATION 0 leaves the lost energy out. Parameter sky_turn?: by how much of a full turn the environment is rotated.
#ifndef SPHERES_SHADING_GLSL
#define SPHERES_SHADING_GLSL

#include "common/equirect.glsl"
#include "ibl/roughness_level.glsl"

#ifndef COMPENSATION
#define COMPENSATION 1
#endif

uniform sampler2D brdf;
#ifdef HAS_SKY_TURN
layout(std140) uniform Parameters { float sky_turn; };
#else
const float sky_turn = 0.0;
#endif

#ifdef HAS_IRRADIANCE
uniform sampler2D irradiance;
#endif
#ifdef HAS_SPECULAR
uniform sampler2D specular;
#endif

struct Surface {
  vec3 albedo;
  float metallic;
  float roughness;
};

// `normal` and `mirror` are world directions, `nv` their cosine to the eye, 0..1.
vec3 shade(Surface surface, vec3 normal, vec3 mirror, float nv) {
  vec3 around = vec3(0.0), reflected = vec3(0.0);
#ifdef HAS_IRRADIANCE
  around = sampleEquirect(irradiance, normal, sky_turn, 0.0, float(textureSize(irradiance, 0).y)).rgb;
#endif
#ifdef HAS_SPECULAR
  float level = levelOfRoughness(surface.roughness, textureQueryLevels(specular));
  reflected = sampleEquirect(specular, mirror, sky_turn, level, float(textureSize(specular, 0).y)).rgb;
#endif
  vec2 split = textureLod(brdf, vec2(nv, surface.roughness), 0.0).rg;
  vec3 f0 = mix(vec3(0.04), surface.albedo, surface.metallic);
  vec3 single = f0 * split.x + split.y;
  vec3 diffuse = surface.albedo * (1.0 - surface.metallic);
#if COMPENSATION
  float lost = 1.0 - split.x - split.y;
  vec3 average = f0 + (1.0 - f0) / 21.0;  // Schlick's Fresnel over the hemisphere
  vec3 multiple = single * average * lost / (1.0 - lost * average);
  return single * reflected + (multiple + diffuse * (1.0 - single - multiple)) * around;
#else
  return single * reflected + diffuse * (1.0 - single) * around;
#endif
}

#endif
