// Material evaluation, independent of the lights: GGX split sum (Karis 2013) with the energy that single scattering loses put back
// (Fdez-Aguera, JCGT 2019: exact for metals in a white furnace at any roughness) and a diffuse layer that gets what the specular one
// leaves. A partial metal is that share of metal beside a dielectric.
// read    brdf           the table of ibl/brdf.comp.glsl, `as linear`
// defines COMPENSATION   0 leaves the lost energy out
#ifndef SHADING_MATERIAL_GLSL
#define SHADING_MATERIAL_GLSL

#include "ibl/roughness_level.glsl"

#ifndef COMPENSATION
#define COMPENSATION 1
#endif

uniform sampler2D brdf;

struct Surface {
  vec3 albedo;
  float metallic;
  float roughness;
};

// A surface seen from one direction.
struct Response {
  vec3 f0, f90;       // reflectance at normal and at grazing incidence
  vec3 single;        // share of the environment's light that single scattering reflects
  vec3 multiple;      // share that leaves after several bounces, in all directions
  vec3 diffuse;       // share that the diffuse layer below reflects
  float roughness;    // of the specular lobe
  float exponent;     // of a Blinn-Phong surface; 0: Cook-Torrance
  // How the lobe differs from that of a view along the normal, see ibl/brdf.comp.glsl:
  float lean;         // from the mirror direction to the normal
  float level_shift;  // share of the specular map's levels
};

// `nv`: cosine between normal and view.
Response responseOf(Surface surface, float nv) {
  vec4 split = textureLod(brdf, vec2(nv, surface.roughness), 0.0);
  float metallic = surface.metallic, dielectric = 0.04 * split.x + split.y;
  Response response;
  response.f0 = mix(vec3(0.04), surface.albedo, metallic);
  response.f90 = vec3(1.0);
  response.single = response.f0 * split.x + split.y;
  response.multiple = vec3(0.0);
  response.roughness = surface.roughness;
  response.exponent = 0.0;
  response.lean = split.z;
  response.level_shift = split.w;
#if COMPENSATION
  // Schlick's Fresnel over the hemisphere is f0 + (1 - f0) / 21 on average.
  float lost = 1.0 - split.x - split.y, average = 0.04 + 0.96 / 21.0;
  vec3 metal = surface.albedo * split.x + split.y, average_metal = surface.albedo * (20.0 / 21.0) + 1.0 / 21.0;
  float several = dielectric * average * lost / (1.0 - lost * average);
  response.multiple = mix(vec3(several), metal * average_metal * lost / (1.0 - lost * average_metal), metallic);
  dielectric += several;
#endif
  response.diffuse = surface.albedo * ((1.0 - metallic) * (1.0 - dielectric));
  return response;
}

// Exponent and roughness of lobes of equal width (Walter et al., EGSR 2007).
float exponentOfRoughness(float roughness) {
  float alpha = max(alphaOfRoughness(roughness), 0.01);
  return max(2.0 / (alpha * alpha) - 2.0, 1.0);
}
float roughnessOfExponent(float exponent) { return sqrt(sqrt(2.0 / (exponent + 2.0))); }

// Of a Blinn-Phong surface. The diffuse part gets what the specular one leaves.
Response phongResponse(Surface surface, float exponent) {
  vec3 specular = mix(vec3(0.04), surface.albedo, surface.metallic);
  vec3 diffuse = surface.albedo * (1.0 - surface.metallic) * (1.0 - specular);
  return Response(specular, vec3(1.0), specular, vec3(0.0), diffuse, roughnessOfExponent(exponent), exponent, 0.0, 0.0);
}

#endif
