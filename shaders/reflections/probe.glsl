// Rays through what a probe sees: a cube map with depth (Szirmay-Kalos et al., "Approximate ray-tracing on the GPU with distance
// impostors", Computer Graphics Forum 24(3), 2005), in which things end at their back faces.
// Slots: probe_light   radiance, premultiplied; alpha 0 where nothing is; `as linear`, its levels are means
//        probe_depth   reversed-Z; `as linear`, so that planes are exact
//        probe_backs   where the thing that is seen ends: its farthest back face; nearest; 1: it has none
//        probe_place   `as uniform`, see reflections/place.comp.glsl
#ifndef REFLECTIONS_PROBE_GLSL
#define REFLECTIONS_PROBE_GLSL

#include "common/cube.glsl"

uniform samplerCube probe_light, probe_depth, probe_backs;
layout(std140) uniform probe_place { vec4 probe_at; };  // w: its near plane

// 0: before what the probe sees at place.xyz / place.w, 1: in it, 2: behind it. w may be 0.
int behindProbed(vec4 place) {
  float far = axisOf(place.xyz), near = probe_at.w * place.w;
  if (textureLod(probe_depth, place.xyz, 0.0).r * far <= near) return 0;
  float back = textureLod(probe_backs, place.xyz, 0.0).r * far;
  return back > 0.0 && back < near ? 1 : 2;
}

// Whether it is behind the middle of its texel, too: between things, linear depth is that of a wall which is not there.
bool behindTexel(vec4 place) {
  float far = axisOf(place.xyz), step = 2.0 / float(textureSize(probe_depth, 0).x);
  vec3 at = place.xyz / far, middle = mix((floor(at / step) + 0.5) * step, at, equal(abs(place.xyz), vec3(far)));
  return textureLod(probe_depth, middle, 0.0).r * far > probe_at.w * place.w;
}

// Whether the same thing is on all sides of a place: depth is linear there, as that of a plane is on a face, or hardly changes.
bool isWhole(vec3 place) {
  float far = axisOf(place), step = 2.0 / float(textureSize(probe_depth, 0).x);
  bvec3 onward = lessThan(abs(place), vec3(far));
  place /= far;
  float here = textureLod(probe_depth, place, 0.0).r, apart = 0.0;
  for (int i = 0; i < 3; ++i) {
    vec3 beside = vec3(0.0);
    beside[i] = onward[i] ? step : 0.0;
    float low = textureLod(probe_depth, place - beside, 0.0).r - here, high = textureLod(probe_depth, place + beside, 0.0).r - here;
    float half_way = textureLod(probe_depth, place + 0.5 * beside, 0.0).r - here;  // an outline may be as far from both
    float bent = max(abs(low + high), abs(low + 2.0 * half_way));
    apart = max(apart, min(bent / (0.75 * step), 33.0 * max(abs(low), abs(high))));
  }
  return apart < here;
}

// A place on a ray, times w: at `angle` from its start as the probe sees it; it vanishes at `whole`. `way`: the direction, as long as `start`.
vec4 placeOnRay(vec3 start, vec3 way, float whole, float angle) {
  float w = max(sin(whole - angle), 0.0);
  return vec4(start * w + way * sin(angle), w);
}

// What the ray meets; a is 0 if nothing. `part`: alpha of the ray's cone. `away`: how far it is.
vec4 probeAlong(vec3 from, vec3 direction, float part, out float away) {
  const int kSteps = 96;
  vec3 start = from - probe_at.xyz;
  float r = max(length(start), 1e-4), met = 0.0;
  vec3 way = direction * r;
  float whole = min(acos(clamp(dot(start, direction) / r, -1.0, 1.0)), 3.13);
  int was = behindProbed(vec4(start, 1.0)), steps = 4 + int(whole * float(kSteps) / kPi), i = 0;
  bool found = false;
  while (i < steps && !found) {
    // In steps of equal angles to where it goes before or behind something. A software renderer pays for all of a loop's body in each step,
    // so what follows is outside.
    float before = met;
    int is = was;
    while (i < steps && is == was) {
      before = met;
      met = whole * float(++i) / float(steps);
      is = behindProbed(placeOnRay(start, way, whole, met));
    }
    float angle = met;
    if (is != was && was != 1) {
      for (int j = 0; j < 6; ++j) {
        float middle = 0.5 * (before + met);
        bool still = behindProbed(placeOnRay(start, way, whole, middle)) == was;
        before = still ? middle : before;
        met = still ? met : middle;
      }
      // A surface is met where it is whole, not where the ray goes behind its outline; from behind, if it is that of something with a back.
      vec3 place = placeOnRay(start, way, whole, met).xyz;
      found = isWhole(place) && (was == 0 || textureLod(probe_backs, place, 0.0).r < 1.0);
      if (!found && is == 1) {
        // What is not thin is met from the side, too: at the first place in it that is behind its texel.
        found = behindTexel(placeOnRay(start, way, whole, angle));
        met = angle;
        for (int j = 0; j < 6; ++j) {
          float middle = 0.5 * (before + met);
          bool in_it = behindTexel(placeOnRay(start, way, whole, middle));
          before = in_it ? before : middle;
          met = in_it ? middle : met;
        }
        is = was;  // until that place it was before it
      }
    }
    was = is;
    met = found ? met : angle;
  }
  away = found ? r * sin(met) / max(sin(whole - met), 1e-4) : r;
  vec3 place = found ? start + away * direction : direction;
  float texel = 1.6 * length(place) / float(textureSize(probe_light, 0).x);
  vec4 light = textureLod(probe_light, place, found ? log2(max(2.0 * part * away / texel, 1.0)) : 4.0);
  // Where it ends behind something: below the horizon, about the light of what is there.
  float share = found ? min(light.a * 8.0, 1.0) : light.a * clamp(-4.0 * direction.y, 0.0, 1.0);
  return vec4(light.rgb / max(light.a, 1e-4), share);
}

#endif
