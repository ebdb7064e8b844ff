// The shading model of surfaces in the G-buffer: Cook-Torrance or Blinn-Phong. Include it before shading/light.glsl.
// define  MODEL   MODEL_MATERIAL: what each material says; MODEL_COOK_TORRANCE or MODEL_BLINN_PHONG: one for all, with lobes of the same
//                 width
#ifndef DEFERRED_SHADING_MODEL_GLSL
#define DEFERRED_SHADING_MODEL_GLSL

#ifndef MODEL_MATERIAL
#define MODEL_MATERIAL 0
#define MODEL_COOK_TORRANCE 1
#define MODEL_BLINN_PHONG 2
#endif
#ifndef MODEL
#define MODEL MODEL_MATERIAL
#endif

// The G-buffer's roughness is already widened by the curvature.
#ifndef SPECULAR_AA
#define SPECULAR_AA 0
#endif

#include "common/view.glsl"
#include "shading/brdf.glsl"
#include "shading/point.glsl"
#ifdef HAS_MATERIAL_LAYERS
#include "shading/layers.glsl"
#endif

Point pointAt(vec3 position, vec3 normal, float sky_visible) {
  vec3 v = towardsEye(position);
  return Point(position, normal, v, reflect(-v, normal), clamp(dot(normal, v), 0.0, 1.0), sky_visible);
}

// `exponent`: the material's, 0 where it is Cook-Torrance.
Response modelResponse(Surface surface, float exponent, float nv) {
  Response response = responseOf(surface, nv);
  bool is_phong = MODEL == MODEL_BLINN_PHONG || (MODEL == MODEL_MATERIAL && exponent > 0.0);
  if (is_phong) response = phongResponse(surface, exponent > 0.0 ? exponent : exponentOfRoughness(surface.roughness));
  return response;
}

// Radiance towards the eye of the environment's light. Occlusion of the lobe: Lagarde and de Rousiers, "Moving Frostbite to physically
// based rendering", SIGGRAPH 2014 courses, 4.10.2.
vec3 ambientRadiance(Point point, Response response, Ambient ambient) {
#ifdef HAS_MATERIAL_LAYERS
  if (layers.on) return layeredAmbient(point, response, ambient);
#endif
  float visible = point.sky_visible, width = exp2(-16.0 * response.roughness - 1.0);
  float lobe_visible = clamp(pow(point.nv + visible, width) - 1.0 + visible, 0.0, 1.0);
#if SEES_SCENE
  return ambientWithScene(ambient, response.multiple, response.diffuse, lobe_visible, visible);
#else
  return ambient.reflected * lobe_visible + (response.multiple + response.diffuse) * ambient.mean * visible;
#endif
}

// Radiance towards the eye for an irradiance of 1 from the unit direction `l`.
vec3 directRadiance(Point point, Response response, vec3 l) {
#ifdef HAS_MATERIAL_LAYERS
  if (layers.on) return layeredDirect(point, response, l);
#endif
#if MODEL == MODEL_COOK_TORRANCE
  return cookTorrance(response, point.normal, point.to_eye, l);
#elif MODEL == MODEL_BLINN_PHONG
  return blinnPhong(response, point.normal, point.to_eye, l);
#else
  if (response.exponent > 0.0) return blinnPhong(response, point.normal, point.to_eye, l);
  return cookTorrance(response, point.normal, point.to_eye, l);
#endif
}

#endif
