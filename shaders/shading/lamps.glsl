// Light of lamps.
// read    lamps       see scene/lamps.glsl
//         ltc?        where some are rectangles, see shading/rectangle.glsl
//         lamp_maps?  their shadow maps, see shading/lamp_shadow.glsl
//         clusters?, slices?   which lamps reach where, see deferred/clusters.glsl (forward, `clusters` is its `columns`); without both,
//                              every pixel goes through all lamps
// params  lamp_count
// The includer has a directRadiance(): see shading/cook_torrance.glsl.
#ifndef SHADING_LAMPS_GLSL
#define SHADING_LAMPS_GLSL

#include "scene/lamps.glsl"
#ifdef HAS_LAMP_MAPS
#include "shading/lamp_shadow.glsl"
#endif
#ifdef HAS_LTC
#include "shading/rectangle.glsl"
#endif
#if defined HAS_CLUSTERS || defined HAS_SLICES
#include "deferred/clusters.glsl"
#endif
#ifdef HAS_CLUSTERS
layout(std430) readonly buffer clusters { uint cluster[]; };
#endif
#ifdef HAS_SLICES
layout(std430) readonly buffer slices { uint slice_word[]; };
#endif

vec3 lampRadiance(Lamp self, Point point, Response response) {
  float seen = 1.0;
  vec3 l, arrives = lampIrradiance(self, point.position, l);
#ifdef HAS_LTC
  bool is_rectangle = self.across != vec3(0.0);
  if (is_rectangle) l = point.normal;  // a part may be above the horizon
#endif
  if (dot(point.normal, l) <= 0.0 || arrives == vec3(0.0)) return vec3(0.0);
#ifdef HAS_LAMP_MAPS
  if (self.shadow >= 0 && self.shadow < textureSize(lamp_maps, 0).z) seen = seenOfLamp(self, point.position, point.normal);
#endif
#ifdef HAS_LTC
  if (is_rectangle) return rectangleRadiance(self, point, response) * seen;
#endif
  return directRadiance(point, response, l) * (arrives * seen);
}

// `tried`: how many lamps it went through.
vec3 lampsRadiance(Point point, Response response, out int tried) {
  vec3 radiance = vec3(0.0);
  int words = (lamp_count + 31) / 32;  // of 32 lamps
  tried = 0;
#ifdef HAS_CLUSTERS
  int of_tile = tileAt(ivec2(gl_FragCoord.xy), ivec2(viewport)) * words;
#endif
#ifdef HAS_SLICES
  int of_slice = sliceOf(viewDistance(point.position)) * words;
#endif
  for (int word = 0; word < words; ++word) {
    uint left = 0xffffffffu >> max(32 * word + 32 - lamp_count, 0);
#ifdef HAS_CLUSTERS
    left &= ~cluster[of_tile + word];
#endif
#ifdef HAS_SLICES
    left &= ~slice_word[of_slice + word];
#endif
    tried += bitCount(left);
    for (; left != 0u; left &= left - 1u) radiance += lampRadiance(lamp[word * 32 + findLSB(left)], point, response);
  }
  return radiance;
}

#endif
