// What surfaces as the G-buffer has them do with light: Cook-Torrance or Blinn-Phong, and ambient occlusion. For shading/light.glsl, which
// this includes.
// defines MODEL   MODEL_MATERIAL: what each material says; MODEL_COOK_TORRANCE or MODEL_BLINN_PHONG: all alike, with lobes of the same width
#ifndef DEFERRED_LIGHT_GLSL
#define DEFERRED_LIGHT_GLSL

#include "common/view.glsl"

#ifndef MODEL_MATERIAL
#define MODEL_MATERIAL 0
#define MODEL_COOK_TORRANCE 1
#define MODEL_BLINN_PHONG 2
#endif
#ifndef MODEL
#define MODEL MODEL_MATERIAL
#endif

// Who draws surfaces knows curvature, and widens roughness by it.
#ifndef SPECULAR_AA
#define SPECULAR_AA 0
#endif
#include "shading/light.glsl"

// The rest of the surface, which findPoint() says: the share of the environment that occlusion leaves, and whether it is Blinn-Phong.
float seen = 1.0;
bool is_phong = false;
Phong phong;

// `exponent`: the material's, 0 where it is Cook-Torrance.
void finishPoint(inout Point point, float exponent) {
  point.v = towardsEye(point.at);
  point.nv = clamp(dot(point.n, point.v), 0.0, 1.0);
  point.mirror = reflect(-point.v, point.n);
  is_phong = MODEL == MODEL_BLINN_PHONG || (MODEL == MODEL_MATERIAL && exponent > 0.0);
  phong = phongOf(point.surface, exponent > 0.0 ? exponent : exponentOfRoughness(point.surface.roughness));
  // Of a Blinn-Phong surface that of a lobe as wide.
  point.roughness = is_phong ? roughnessOfExponent(phong.exponent) : point.surface.roughness;
}

void finishResponse(inout Response response) {
  if (is_phong) response = Response(phong.specular, phong.specular, vec3(0.0), phong.diffuse, vec2(0.0));
}

vec3 throwAround(Point point, Response response, vec3 reflected, vec3 around) {
  // Occlusion of the lobe: Lagarde and de Rousiers, "Moving Frostbite to physically based rendering", SIGGRAPH 2014 courses, 4.10.2.
  float seen_reflected = clamp(pow(point.nv + seen, exp2(-16.0 * point.roughness - 1.0)) - 1.0 + seen, 0.0, 1.0);
  return reflected * seen_reflected + (response.multiple + response.diffuse) * around * seen;
}

vec3 throwFrom(Point point, Response response, vec3 l) {
#if MODEL == MODEL_COOK_TORRANCE
  return cookTorrance(response, point.surface.roughness, point.n, point.v, l);
#elif MODEL == MODEL_BLINN_PHONG
  return blinnPhong(phong, point.n, point.v, l);
#else
  if (is_phong) return blinnPhong(phong, point.n, point.v, l);
  return cookTorrance(response, point.surface.roughness, point.n, point.v, l);
#endif
}

#endif
