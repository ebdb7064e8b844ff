// What a surface does with light from everywhere: GGX split sum (Karis 2013) with the energy that single scattering loses put
// back (Fdez-Aguera, JCGT 2019: exact for metals in a white furnace whatever the roughness) and a diffuse layer that
// gets what the specular one leaves. A partial metal is that share of metal beside a dielectric. shading/light.glsl reads the environment's
// maps by it.
// Samplers: brdf (`as linear`) and those of shading/lobe.glsl, where SPECULAR_AA is too.
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

struct Surface {
  vec3 albedo;
  float metallic;
  float roughness;
};

// What a surface does with light, seen at the cosine `nv`: the share that single scattering reflects, the share that comes out after
// several, spread all round, and the share of the diffuse layer below.
struct Response {
  vec3 f0, single, multiple, diffuse;
  vec2 lobe;  // how the lobe differs from that of V = N, see ibl/brdf.comp
};
Response responseOf(Surface surface, float nv) {
  vec4 split = textureLod(brdf, vec2(nv, surface.roughness), 0.0);
  float metallic = surface.metallic, dielectric = 0.04 * split.x + split.y;
  Response response;
  response.f0 = mix(vec3(0.04), surface.albedo, metallic);
  response.single = response.f0 * split.x + split.y;
  response.multiple = vec3(0.0);
  response.lobe = split.zw;
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

#endif
