// Light that leaves a surface towards the eye, for whatever has a surface: lighting.frag for the G-buffer, transparent.frag for meshes.
// read    brdf, irradiance?, specular?, environment?, probes?, sh?   see shading/ibl.glsl
//         sun?          see scene/sun.glsl; sun_map?, sun_depth?: shading/sun_shadow.glsl
//         lamps?        see scene/lamps.glsl; lamp_maps?: shading/lamp_shadow.glsl
//         clusters?     which lamps reach where, see clusters.glsl; without it every pixel goes through all lamps
// params  lamp_count    with lamps
//         sky_turn?     see shading/ibl.glsl
// defines MODEL         MODEL_MATERIAL: what each material says; MODEL_COOK_TORRANCE or MODEL_BLINN_PHONG: all alike, with lobes of the same width
//         SOFT_SUN      see shading/sun_shadow.glsl
//         LIT_IS_GREATER   see shading/compare.glsl
#ifndef DEFERRED_LIGHT_GLSL
#define DEFERRED_LIGHT_GLSL

#include "gbuffer.glsl"

#ifndef MODEL_MATERIAL
#define MODEL_MATERIAL 0
#define MODEL_COOK_TORRANCE 1
#define MODEL_BLINN_PHONG 2
#endif
#ifndef MODEL
#define MODEL MODEL_MATERIAL
#endif

#if defined HAS_SKY_TURN || defined HAS_LAMPS
layout(std140) uniform Parameters {
#ifdef HAS_SKY_TURN
  float sky_turn;
#endif
#ifdef HAS_LAMPS
  int lamp_count;
#endif
};
#endif

// Who draws surfaces knows curvature, and widens roughness by it.
#ifndef SPECULAR_AA
#define SPECULAR_AA 0
#endif
#include "shading/direct.glsl"
#ifdef HAS_SUN
#ifdef HAS_SUN_MAP
#include "shading/sun_shadow.glsl"
#else
#include "scene/sun.glsl"
#endif
#endif
#ifdef HAS_LAMPS
#ifdef HAS_LAMP_MAPS
#include "shading/lamp_shadow.glsl"
#else
#include "scene/lamps.glsl"
#endif
#ifdef HAS_CLUSTERS
#include "clusters.glsl"
layout(std430) readonly buffer clusters { uint cluster[]; };
#endif
#endif

struct Point {
  vec3 at, n, v;  // world; n and v are unit, v towards the eye
  float nv;
  Surface surface;
  Response response;
  Phong phong;
  bool is_phong;
};

vec3 towards(Point point, vec3 l) {
#if MODEL == MODEL_COOK_TORRANCE
  return cookTorrance(point.response, point.surface.roughness, point.n, point.v, l);
#elif MODEL == MODEL_BLINN_PHONG
  return blinnPhong(point.phong, point.n, point.v, l);
#else
  if (point.is_phong) return blinnPhong(point.phong, point.n, point.v, l);
  return cookTorrance(point.response, point.surface.roughness, point.n, point.v, l);
#endif
}

// From the environment; `seen` is the share of it that occlusion leaves.
vec3 ambient(Point point, float seen) {
  float roughness = point.is_phong ? roughnessOfExponent(point.phong.exponent) : point.surface.roughness;
  vec3 reflected = vec3(0.0);
#ifdef HAS_SPECULAR
  reflected = reflection(lobeOf(roughness, 0.0), reflect(-point.v, point.n));
#endif
  // Occlusion of the lobe: Lagarde and de Rousiers, "Moving Frostbite to physically based rendering", SIGGRAPH 2014 courses, 4.10.2.
  float seen_reflected = clamp(pow(point.nv + seen, exp2(-16.0 * roughness - 1.0)) - 1.0 + seen, 0.0, 1.0);
  vec3 around = lightAround(point.at, point.n) * seen;
  if (point.is_phong) return point.phong.specular * reflected * seen_reflected + point.phong.diffuse * around;
  return point.response.single * reflected * seen_reflected + (point.response.multiple + point.response.diffuse) * around;
}

#ifdef HAS_LAMPS
vec3 fromLamp(Point point, int i) {
  vec3 l, irradiance_there = lampIrradiance(lamp[i], point.at, l);
  if (dot(point.n, l) <= 0.0 || irradiance_there == vec3(0.0)) return vec3(0.0);
#ifdef HAS_LAMP_MAPS
  if (lamp[i].shadow >= 0 && lamp[i].shadow < textureSize(lamp_maps, 0).z) irradiance_there *= seenOfLamp(lamp[i], point.at, point.n);
#endif
  return towards(point, l) * irradiance_there;
}
#endif

// `model`: mro.a of the G-buffer.
Point pointOf(vec3 at, vec3 n, Surface surface, float model) {
  Point point;
  point.at = at;
  point.n = n;
  point.v = towardsEye(at);
  point.nv = clamp(dot(n, point.v), 0.0, 1.0);
  point.surface = surface;
  point.response = responseOf(surface, point.nv);
  point.is_phong = MODEL == MODEL_BLINN_PHONG || (MODEL == MODEL_MATERIAL && model > 0.0);
  point.phong = phongOf(surface, model > 0.0 ? decodeExponent(model) : exponentOfRoughness(surface.roughness));
  return point;
}

// From the sun and the lamps; `looked_at`: how many lamps it went through. `picture` is the size of what `pixel` counts in.
vec3 direct(Point point, ivec2 pixel, ivec2 picture, out int looked_at) {
  vec3 sum = vec3(0.0);
  looked_at = 0;
#ifdef HAS_SUN
  Sun light = sun_light[0];
  if (dot(point.n, light.direction) > 0.0) {
    vec3 from_sun = towards(point, light.direction) * light.irradiance;
#ifdef HAS_SUN_MAP
    from_sun *= seenOfSun(light, point.at, point.n);
#endif
    sum += from_sun;
  }
#endif
#ifdef HAS_LAMPS
#ifdef HAS_CLUSTERS
  ivec2 tiles = tilesOf(picture), tile = pixel / kTile;
  int words = wordsOf(lamp_count), of_tile = (tile.y * tiles.x + tile.x) * words;
  int of_slice = (tiles.x * tiles.y + sliceOf(viewDistance(point.at))) * words;
  for (int word = 0; word < words; ++word) {
    uint left = ~(cluster[of_tile + word] | cluster[of_slice + word]);
    looked_at += bitCount(left);
    while (left != 0u) {
      sum += fromLamp(point, word * 32 + findLSB(left));
      left &= left - 1u;
    }
  }
#else
  looked_at = lamp_count;
  for (int i = 0; i < lamp_count; ++i) sum += fromLamp(point, i);
#endif
#endif
  return sum;
}

#endif
