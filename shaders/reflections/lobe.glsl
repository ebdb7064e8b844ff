// What a surface reflects of the scene, by rays in its lobe.
// read    mirror_light?   light of surfaces times their share of each texel, which is alpha; its levels are means; `as linear`
//         mirror_depth, mirror_nearest, mirror_backs?   see reflections/trace.glsl
//         probe_light?, probe_depth, probe_backs, probe_place   see reflections/probe.glsl: where the picture does not show what a ray meets
//         specular      see shading/environment.glsl
//         air?          fog between the surface and what it reflects, see fog/fog.glsl
// Behind shading/environment.glsl and shading/material.glsl.
#ifndef REFLECTIONS_LOBE_GLSL
#define REFLECTIONS_LOBE_GLSL

#include "common/view.glsl"
#include "fog/sky.glsl"
#include "reflections/spread.glsl"
#include "shading/point.glsl"
#ifdef HAS_MIRROR_LIGHT
#include "reflections/trace.glsl"
uniform sampler2D mirror_light;
#endif
#if SEES_PROBE
#include "reflections/probe.glsl"
#endif

const float kRoughest = 0.7;  // where they have ended

// A GGX half vector among those visible from `v`, in the surface's frame: Heitz, "Sampling the GGX distribution of visible normals",
// JCGT 7(4), 2018.
vec3 visibleHalf(vec3 v, float alpha, vec2 u) {
  vec3 w = normalize(vec3(alpha * v.xy, v.z));
  vec3 x = w.z < 0.9999 ? normalize(vec3(-w.y, w.x, 0.0)) : vec3(1.0, 0.0, 0.0), y = cross(w, x);
  float r = sqrt(u.x), phi = 2.0 * kPi * u.y, s = 0.5 * (1.0 + w.z);
  float a = r * cos(phi), b = mix(sqrt(1.0 - a * a), r * sin(phi), s);
  vec3 h = a * x + b * y + sqrt(max(1.0 - a * a - b * b, 0.0)) * w;
  return normalize(vec3(alpha * h.xy, max(h.z, 1e-4)));
}

float pixelWidth(vec3 position) { return (view_projection * vec4(position, 1.0)).w * pixelAngle(); }

vec3 prefiltered(vec3 direction, float level, int levels) {
  vec2 lookup = equirectLookup(clamp(level, 0.0, float(levels - 1)), 0.5 / float(textureSize(specular, 0).y));
  return sampleEquirect(specular, equirectUv(direction) - vec2(sky_turn, 0.0), lookup).rgb;
}

// Light from `away` along a ray, behind the fog on its way.
vec3 fogged(vec3 light, vec3 from, vec3 direction, float away) {
#ifdef HAS_AIR
  light = mix(fog_light.rgb, light, throughFog(from.y, direction.y * away, away));
#endif
  return light;
}

// What one ray meets, times its share, which is alpha. `part`: alpha of the ray's cone. `away`: how far it is.
vec4 sceneAlong(vec3 from, vec3 direction, float part, out float away) {
  vec4 seen = vec4(0.0);
  away = 0.0;
#ifdef HAS_MIRROR_LIGHT
  vec3 hit = trace(from, direction);
  if (hit.z > 0.0) {
    // The cone of directions is about four times as wide as alpha.
    vec3 met = positionOfDepth(hit.xy / viewport, hit.z);
    away = distance(met, from);
    vec4 light = textureLod(mirror_light, hit.xy / viewport, log2(max(2.0 * part * away / pixelWidth(met), 1.0)));
    vec2 edge = clamp((0.5 - abs(hit.xy / viewport - 0.5)) * 50.0, 0.0, 1.0);
    seen = edge.x * edge.y * min(light.a * 64.0, 1.0) * vec4(fogged(light.rgb / max(light.a, 1e-4), from, direction, away), 1.0);
  }
#endif
#if SEES_PROBE
  if (seen.a < 1.0) {
    float other_away;
    vec4 other = probeAlong(from, direction, part, other_away);
    away = mix(other_away, away, seen.a);
    seen += (1.0 - seen.a) * other.a * vec4(fogged(other.rgb, from, direction, other_away), 1.0);
  }
#endif
  return seen;
}

// a: share of the lobe that meets something; rgb: radiance that replaces that share of the environment's. `rays` of the
// `rays` * `sets` directions of the lobe, those of `set`. `reach`: how far away it is, times a.
vec4 reflectedPicture(Point point, Response response, int set, int sets, int rays, out float reach) {
  reach = 0.0;
  float fade = 1.0 - smoothstep(0.8 * kRoughest, kRoughest, response.roughness), alpha = alphaOfRoughness(response.roughness);
  if (fade <= 0.0) return vec4(0.0);
  vec3 n = point.normal, v = point.to_eye, axis = normalize(mix(point.mirror, n, response.lean));
  vec3 x = normalize(abs(n.y) < 0.9 ? cross(n, vec3(0.0, 1.0, 0.0)) : cross(n, vec3(1.0, 0.0, 0.0))), y = cross(n, x);
  mat3 basis = mat3(x, y, n);
  float spread = raySpread(response.roughness), nv = max(point.nv, 1e-3), a2 = alpha * alpha;
  vec3 seen_from = vec3(dot(v, x), dot(v, y), nv);
  vec3 from = point.position + n * pixelWidth(point.position);
  if (spread == 0.0) rays = 1;
  // With jitter, frames are averaged: each has other directions.
  float turn = jitter == vec2(0.0) ? 0.0 : 0.618034 * float(frame & 15u);
  // A ray stands for its part of the lobe. These overlap, since few meet a glint, which is bright.
  float part = alpha * mix(1.0, min(3.5 * inversesqrt(float(rays * sets)), 1.0), spread);
  int levels = textureQueryLevels(specular);
  vec3 mean = vec3(0.0);
  bool found = false;
  vec4 sum = vec4(0.0);
  float whole = 0.0;
  for (int i = 0; i < rays; ++i) {
    int j = sets * i + set;
    vec3 l = axis;
    float weight = 1.0, cone = part;
    if (spread > 0.0) {
      // A spiral of golden angles.
      vec2 u = vec2((float(j) + 0.5) / float(rays * sets), fract(0.618034 * float(j) + turn));
      // Rays are far apart in the lobe's tail.
      cone = min(part / (1.0 - sharedOf(spread) * u.x), 4.0 * alpha);
      vec3 h = visibleHalf(seen_from, alpha, u), reflected = reflect(-seen_from, h);
      // Its share of single scattering: masking from both sides over masking from the eye's.
      float nl = max(reflected.z, 0.0), lv = sqrt(nv * nv * (1.0 - a2) + a2), ll = sqrt(nl * nl * (1.0 - a2) + a2);
      weight = nl > 0.0 ? nl * (nv + lv) / (nl * lv + nv * ll) : 0.0;
      l = normalize(mix(axis, basis * reflected, spread));
    }
    whole += weight;
    if (weight <= 0.0 || dot(l, n) <= 0.0) continue;
    float away;
    vec4 seen = sceneAlong(from, l, cone, away);
    if (seen.a <= 0.0) continue;
    // The map is that of the whole lobe, of which this ray hides a part that may be brighter or darker.
    if (spread > 0.0) {
      if (!found) mean = prefiltered(axis, levelOfAlpha(alpha, levels), levels);
      vec3 apart = mean - prefiltered(l, levelOfAlpha(part, levels), levels);
#ifdef HAS_AIR
      apart *= throughFogOfSky(axis, from.y, alpha);
#endif
      seen.rgb += seen.a * spread * apart;
    }
    found = true;
    sum += weight * seen;
    reach += weight * seen.a * away;
  }
  reach *= whole > 0.0 ? fade / whole : 0.0;
  return whole > 0.0 ? sum * (fade / whole) : vec4(0.0);
}

#endif
