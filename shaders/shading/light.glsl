// Light that leaves a surface towards the eye: of the environment, the sun and lamps. This has main(); a shader that includes it says what
// surface there is, what that does with light, and where the result goes:
//   void findPoint(out Point point)                                  may discard
//   void finishResponse(inout Response response)                     of surfaces that are not Cook-Torrance
//   vec3 throwAround(Point point, Response response, vec3 reflected, vec3 around)   what leaves of light from everywhere: `reflected` is what
//        single scattering reflects of it, `around` its mean weighted by the cosine
//   vec3 throwFrom(Point point, Response response, vec3 l)           what leaves for an irradiance of 1 from the unit direction l
//   void putLight(Point point, vec3 from_around, vec3 from_lights, int lamps_tried)   how many lamps it went through
// read    brdf, irradiance?, specular?, environment?, brightest?   see shading/ibl.glsl; without one its light is missing
//         probes?, sh?  light that other things throw back, see gi/bounce.glsl
//         neighbours?   with LOBE_IS_FLAT: what spheres hide of each other, see neighbours/surround.glsl; it says which sphere it is:
//   vec2 sphereOf()
//         sun?          see scene/sun.glsl; sun_map?, sun_depth?: shading/sun_shadow.glsl
//         light_maps?, light_depths?, ball?   see shading/mesh_shadow.glsl; in place of sun_map
//         lamps?        see scene/lamps.glsl; lamp_maps?: shading/lamp_shadow.glsl
//         clusters?, slices?   which lamps reach where, see deferred/clusters.glsl (forward, `clusters` is its `columns`); without
//                       both every pixel goes through all lamps
// params  lamp_count    with lamps
//         sky_turn?     see shading/ibl.glsl
// defines SOFT_SUN         see shading/sun_shadow.glsl
//         LOBE_IS_FLAT     the vertex shader has called lobeOf, with the curvature, and hands it on: shading/handed.glsl
// A variant without sun and lamps is as if there was no code for them. All is one function: drivers put each function into those that call
// it, and every level of calls costs them that again.
#ifndef SHADING_LIGHT_GLSL
#define SHADING_LIGHT_GLSL

#ifndef LOBE_IS_FLAT
#define LOBE_IS_FLAT 0
#endif

#include "shading/parameters.glsl"
#include "shading/direct.glsl"
#ifdef HAS_PROBES
#include "gi/bounce.glsl"
#endif
#if defined HAS_NEIGHBOURS && LOBE_IS_FLAT
#define SEES_NEIGHBOURS 1
#include "neighbours/surround.glsl"
#else
#define SEES_NEIGHBOURS 0
#endif
#ifdef HAS_SUN_MAP
#include "shading/sun_shadow.glsl"
#elif defined HAS_SUN
#include "scene/sun.glsl"
#endif
#ifdef HAS_LAMP_MAPS
#include "shading/lamp_shadow.glsl"
#elif defined HAS_LAMPS
#include "scene/lamps.glsl"
#endif
#if defined HAS_LIGHT_MAPS && defined HAS_LIGHT_DEPTHS && defined HAS_BALL && !defined HAS_SUN_MAP
#define SEES_MESHES 1
#include "shading/mesh_shadow.glsl"
#else
#define SEES_MESHES 0
#endif
#if defined HAS_LAMPS && (defined HAS_CLUSTERS || defined HAS_SLICES)
#include "deferred/clusters.glsl"
#endif
#ifdef HAS_CLUSTERS
layout(std430) readonly buffer clusters { uint cluster[]; };
#endif
#ifdef HAS_SLICES
layout(std430) readonly buffer slices { uint slice_word[]; };
#endif

#if LOBE_IS_FLAT
#include "shading/handed.glsl"
#endif

struct Point {
  vec3 at, n, v;    // world; n and v are unit, v towards the eye
  vec3 mirror;      // v reflected at the surface
  float nv;         // N.V, 0..1
  float roughness;  // of the lobe; with LOBE_IS_FLAT of no account
  Surface surface;
};
void findPoint(out Point point);
void finishResponse(inout Response response);
vec3 throwAround(Point point, Response response, vec3 reflected, vec3 around);
vec3 throwFrom(Point point, Response response, vec3 l);
void putLight(Point point, vec3 from_around, vec3 from_lights, int lamps_tried);
#if SEES_NEIGHBOURS
vec2 sphereOf();  // row in the draw list, radius
#endif

float coverage = 1.0;  // of the pixel, for the spot's reflection; findPoint may set it

void main() {
  Point point;
  findPoint(point);
#ifdef HAS_RADIANCE
  Response response = responseOf(point.surface, point.nv);
  finishResponse(response);

#if LOBE_IS_FLAT
  Lobe lobe = handedLobe();
#else
  Lobe lobe = lobeOf(point.roughness, 0.0);
#endif
  vec3 mirrored = mix(point.mirror, point.n, response.lobe.x);
#if SEES_NEIGHBOURS
  vec2 row_and_radius = sphereOf();
  Surround surround = surroundOf(listedOf(uint(row_and_radius.x)), point.at, point.n, mirrored, point.surface.roughness, point.surface.albedo, lobe);
  // Light of the ground where nothing stands, and what is in its place in the environment.
  GroundLight on_ground = groundLight(lobe, around_above.rgb);
  vec3 open_ground = mix(around_below.rgb, surround.soil.albedo * (on_ground.sky + on_ground.spot + on_ground.sun), surfaceOf(surround.soil, point.at));
#endif
#if SEES_MESHES
  vec2 past_meshes = seenOfLights(point.at, point.n, sky_turn);
#if SEES_NEIGHBOURS
  // Spheres may stand in both.
  past_meshes = min(past_meshes, vec2(surround.sun_seen, surround.spot_seen));
  surround.sun_seen = past_meshes.x;
  surround.spot_seen = past_meshes.y;
#endif
#endif
  // What single scattering reflects of the environment.
  vec3 reflected = vec3(0.0);
#ifdef HAS_SPECULAR
  float near_spot = dot(point.mirror, lobe.spot), level = min(lobe.maps.y + response.lobe.y * lobe.maps.w, lobe.poles.w);
#if SEES_NEIGHBOURS
  mirrored = overGround(surround, mirrored);
#endif
  vec2 axis = equirectUv(mirrored) - vec2(sky_turn, 0.0);
  reflected = sampleEquirect(specular, axis, equirectLookup(level, lobe.poles.y)).rgb;
#ifdef HAS_ENVIRONMENT
  vec3 sharp = sampleEquirect(environment, axis, vec2(lobe.maps.x, lobe.poles.x)).rgb;
#ifdef HAS_BRIGHTEST
  // The spot is not to be seen twice.
  sharp -= (near_spot > kNearCosine ? lobe.cut : 0.0) * max(sharp - brightest_at.w, 0.0);
#endif
  reflected = mix(sharp, reflected, lobe.maps.z);
#endif
#if SEES_NEIGHBOURS
  reflected = skyAndGround(surround, on_ground, reflected) * surround.mirror_seen +
              hiddenLight(surround, point.at, point.n, row_and_radius.y, point.surface.albedo, point.surface.metallic,
                          alphaOfRoughness(point.surface.roughness), lobe, on_ground);
#endif
  reflected *= response.single;
#ifdef HAS_BRIGHTEST
  // GGX, Smith's height-correlated masking (Heitz, JCGT 2014) and Schlick's Fresnel, for one direction.
  float nv = point.nv, nl = max(dot(point.n, lobe.spot), 0.0), a2 = lobe.widths.x;
  float h2 = max(2.0 + 4.0 * nv * nl - 2.0 * near_spot, 1e-6);  // |V + L|^2
  float masking = nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2);
  float strength = spotDistribution(lobe.widths, max(h2 - (nv + nl) * (nv + nl), 0.0), h2, nl, max(masking, 1e-6));
#if LOBE_IS_FLAT
  vec2 g = exp2(-abs(gl_FragCoord.xy - lobe.glint) * lobe.shares.x), by = 1.0 + g * (lobe.shares.y + g);
  strength += lobe.shares.z * g.x * g.y / (by.x * by.y * max(coverage, 0.1));
#endif
  float m = 1.0 - 0.5 * sqrt(h2), m2 = m * m;
#if SEES_NEIGHBOURS
  strength *= surround.spot_seen;
#elif SEES_MESHES
  strength *= past_meshes.y;
#endif
  reflected += (response.f0 + (1.0 - response.f0) * (m2 * m2 * m)) * brightest_light.rgb * (lobe.share * strength);
#endif
#endif

  vec3 around = vec3(0.0);
#ifdef HAS_IRRADIANCE
  vec2 lookup = vec2(0.0, lobe.poles.z);
  vec3 facing = point.n;
#if SEES_NEIGHBOURS
  facing = surround.bent;
#endif
  vec4 mapped = sampleEquirect(irradiance, equirectUv(facing) - vec2(sky_turn, 0.0), lookup);
  around = mapped.rgb;
#if SEES_NEIGHBOURS
  around = aroundSeen(surround, point.n, lobe, around, mapped.a, around_below.rgb, open_ground);
#elif SEES_MESHES && defined HAS_BRIGHTEST
  // The map has the spot's light in it.
  around = max(around - spotAround().rgb * (mapped.a * (1.0 - past_meshes.y)), vec3(0.0));
#endif
#ifdef HAS_PROBES
  vec3 coefficients[9];
  float bounce_left = probeAt(point.at, coefficients);
  Bounce bounce = bounceOf(coefficients, bounce_left, point.n);
  vec2 there = equirectUv(bounce.facing) - vec2(sky_turn, 0.0), behind = vec2(there.x + 0.5, 1.0 - there.y);
  around += bounced(bounce, sampleEquirect(irradiance, there, lookup).rgb, sampleEquirect(irradiance, behind, lookup).rgb);
#endif
#endif
  vec3 from_around = throwAround(point, response, reflected, around), from_lights = vec3(0.0);
  int lamps_tried = 0;

#ifdef HAS_SUN
  Sun light = sun_light[0];
  if (dot(point.n, light.direction) > 0.0) {
    from_lights = throwFrom(point, response, light.direction) * light.irradiance;
#ifdef HAS_SUN_MAP
    from_lights *= seenInMap(shadowedSun(light), point.at, point.n);
#endif
#if SEES_NEIGHBOURS
    from_lights *= surround.sun_seen;
#elif SEES_MESHES
    from_lights *= past_meshes.x;
#endif
  }
#endif

#ifdef HAS_LAMPS
  int words = (lamp_count + 31) / 32;
#ifdef HAS_CLUSTERS
  ivec2 tile = ivec2(gl_FragCoord.xy) / LAMP_TILE;
  int of_tile = (tile.y * tilesOf(ivec2(viewport)).x + tile.x) * words;
#endif
#ifdef HAS_SLICES
  int of_slice = sliceOf(viewDistance(point.at)) * words;
#endif
  for (int word = 0; word < words; ++word) {
    uint left = 0xffffffffu >> max(32 * word + 32 - lamp_count, 0);
#ifdef HAS_CLUSTERS
    left &= ~cluster[of_tile + word];
#endif
#ifdef HAS_SLICES
    left &= ~slice_word[of_slice + word];
#endif
    lamps_tried += bitCount(left);
    for (; left != 0u; left &= left - 1u) {
      Lamp self = lamp[word * 32 + findLSB(left)];
      vec3 l, there = lampIrradiance(self, point.at, l);
      if (dot(point.n, l) <= 0.0 || there == vec3(0.0)) continue;
#ifdef HAS_LAMP_MAPS
      if (self.shadow >= 0 && self.shadow < textureSize(lamp_maps, 0).z) there *= seenOfLamp(self, point.at, point.n);
#endif
      from_lights += throwFrom(point, response, l) * there;
    }
  }
#endif
  putLight(point, from_around, from_lights, lamps_tried);
#endif
}

#endif
