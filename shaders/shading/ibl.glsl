// Image-based lighting of one surface point: GGX split sum (Karis 2013) with the energy that single scattering loses put
// back (Fdez-Aguera, JCGT 2019: exact for metals in a white furnace whatever the roughness) and a diffuse layer that
// gets what the specular one leaves. Samplers: brdf (`as linear`), irradiance? (`as linear wrap`), and those of shading/lobe.glsl, where
// SPECULAR_AA is too.
// COMPENSATION 0 leaves the lost energy out.
// Parameter sky_turn?: by how much of a full turn the environment is rotated. The includer declares the block Parameters before.
#ifndef SHADING_IBL_GLSL
#define SHADING_IBL_GLSL

#include "common/equirect.glsl"
#include "shading/lobe.glsl"

#ifndef COMPENSATION
#define COMPENSATION 1
#endif

uniform sampler2D brdf;
#ifndef HAS_SKY_TURN
const float sky_turn = 0.0;
#endif

#ifdef HAS_IRRADIANCE
uniform sampler2D irradiance;
#endif

struct Surface {
  vec3 albedo;
  float metallic;
  float roughness;
};

#ifdef HAS_SPECULAR
// Light from around the mirror direction; `lobe` from lobeOf.
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
vec3 reflection(vec3 lobe, vec3 mirror) { return vec3(0.0); }
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
// Mean radiance of the environment around `normal`, weighted by the cosine; `lookup` from equirectLookup.
vec3 fromEnvironment(vec3 normal, vec2 lookup) {
  return sampleEquirect(irradiance, equirectUv(normal) - vec2(sky_turn, 0.0), lookup).rgb;
}
#endif

#endif
