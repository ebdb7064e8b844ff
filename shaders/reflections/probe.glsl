// Rays through what a probe sees: a cube map with depth (Szirmay-Kalos et al., "Approximate ray-tracing on the GPU with distance
// impostors", Computer Graphics Forum 24(3), 2005), in which things end at their back faces.
// Slots: probe_light   radiance, premultiplied; alpha 0 where nothing is; `as linear`, its levels are means
//        probe_depth   reversed-Z; `as linear`, so that planes are exact
//        probe_backs   where the thing that is seen ends: its farthest back face; nearest; 1: it has none
//        probe_place   `as uniform`, see reflections/place.comp.glsl
#ifndef REFLECTIONS_PROBE_GLSL
#define REFLECTIONS_PROBE_GLSL

uniform samplerCube probe_light, probe_depth, probe_backs;
layout(std140) uniform probe_place { vec4 probe_at; };  // w: its near plane

// 0: before what the probe sees at place / w, 1: in it, 2: behind it. w may be 0.
int behindProbed(vec3 place, float w) {
  vec3 a = abs(place);
  float far = max(a.x, max(a.y, a.z)), near = probe_at.w * w;
  if (textureLod(probe_depth, place, 0.0).r * far <= near) return 0;
  float back = textureLod(probe_backs, place, 0.0).r * far;
  return back > 0.0 && back < near ? 1 : 2;
}

// Whether the same thing is on all sides of a place: depth is linear there, as that of a plane is on a face, or hardly changes.
bool isWhole(vec3 place) {
  vec3 a = abs(place);
  float far = max(a.x, max(a.y, a.z)), step = 2.0 / float(textureSize(probe_depth, 0).x);
  place /= far;
  bvec3 onward = lessThan(a, vec3(far));
  float here = textureLod(probe_depth, place, 0.0).r, apart = 0.0;
  for (int i = 0; i < 3; ++i) {
    vec3 beside = vec3(0.0);
    beside[i] = onward[i] ? step : 0.0;
    float low = textureLod(probe_depth, place - beside, 0.0).r - here, high = textureLod(probe_depth, place + beside, 0.0).r - here;
    apart = max(apart, min(abs(low + high) / (0.75 * step), 33.0 * max(abs(low), abs(high))));
  }
  return apart < here;
}

// What the ray meets; a is 0 if nothing. `part`: alpha of the ray's cone. `away`: how far it is.
vec4 probeAlong(vec3 from, vec3 direction, float part, out float away) {
  const int kSteps = 96;
  vec3 start = from - probe_at.xyz;
  float r = max(length(start), 1e-4), before = 0.0, met = 0.0;
  // As the probe sees it, the ray goes from `start` to `direction`: steps of equal angles. At an angle a it is at
  // (start * sin(whole - a) + direction * r * sin(a)) / sin(whole - a).
  float whole = min(acos(clamp(dot(start, direction) / r, -1.0, 1.0)), 3.13);
  int was = behindProbed(start, 1.0), steps = 4 + int(whole * float(kSteps) / kPi);
  bool found = false;
  for (int i = 1; i <= steps && !found; ++i) {
    float angle = whole * float(i) / float(steps), w = sin(whole - angle);
    if (i == steps) w = 0.0;
    int is = behindProbed(start * w + direction * (r * sin(angle)), w);
    if (is != was && (is == 1 || was == 0)) {
      met = angle;
      for (int j = 0; j < 6; ++j) {
        float middle = 0.5 * (before + met);
        w = sin(whole - middle);
        bool still = behindProbed(start * w + direction * (r * sin(middle)), w) == was;
        before = still ? middle : before;
        met = still ? met : middle;
      }
      // What is thin is met where it is whole, not where the ray goes behind its outline.
      found = is == 1 || isWhole(start * sin(whole - met) + direction * (r * sin(met)));
    }
    was = is;
    before = angle;
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
