// One path a pixel through spheres above a floor, under a sky with a broad sun.
// read    instances   the import @spheres
// write   light       what arrives at the first surface, without its color
//         albedo      of the first surface; white for the sky
//         surface     xyz: normal, w: distance; -1 for the sky
//         motion      screen UV per frame
#include "common/view.glsl"
#include "scene/instances.glsl"

layout(std140) uniform Parameters { int bounces; int count; };
in vec2 uv;
#ifdef HAS_LIGHT
layout(location = 0) out vec4 light;
#endif
#ifdef HAS_ALBEDO
layout(location = 1) out vec4 albedo;
#endif
#ifdef HAS_SURFACE
layout(location = 2) out vec4 surface;
#endif
#ifdef HAS_MOTION
layout(location = 3) out vec2 motion;
#endif

struct Hit { float way; vec3 normal, color; float roughness, metallic; };

uint seed;
// PCG, after O'Neill 2014 and Jarzynski and Olano 2020.
float random() {
  seed = seed * 747796405u + 2891336453u;
  uint word = ((seed >> ((seed >> 28) + 4u)) ^ seed) * 277803737u;
  return float((word >> 22) ^ word) * (1.0 / 4294967296.0);
}

vec3 skyAt(vec3 d) {
  const vec3 sun = normalize(vec3(-0.5, 0.7, 0.6));
  vec3 sky = mix(vec3(0.5, 0.55, 0.6), vec3(0.15, 0.3, 0.7), max(d.y, 0.0));
  return dot(d, sun) > 0.96 ? vec3(12.0, 11.0, 9.0) : sky;
}

Hit trace(vec3 from, vec3 d) {
  Hit hit = Hit(1e30, vec3(0.0), vec3(0.0), 1.0, 0.0);
  const float kFloor = -11.0;
  if (d.y < 0.0 && from.y > kFloor) hit = Hit((kFloor - from.y) / d.y, vec3(0.0, 1.0, 0.0), vec3(0.4), 1.0, 0.0);
  for (int i = 0; i < count; ++i) {
    vec3 to = from - instance[i].center;
    float b = dot(to, d), radius = instance[i].radius;
    // Distance of the line from the center, without the difference of large squares (Haines and others 2019).
    vec3 beside = to - b * d;
    float inside = radius * radius - dot(beside, beside);
    if (inside < 0.0) continue;
    float way = -b - sqrt(inside);
    if (way > 1e-3 && way < hit.way)
      hit = Hit(way, (to + way * d) / radius, instance[i].albedo, instance[i].roughness, instance[i].metallic);
  }
  return hit;
}

// Around `axis` by the cosine: a point of the unit sphere added to it.
vec3 scattered(vec3 axis) {
  float z = 2.0 * random() - 1.0, angle = 6.2831853 * random();
  return normalize(axis * 1.0001 + vec3(sqrt(1.0 - z * z) * vec2(cos(angle), sin(angle)), z));
}

void main() {
  uvec2 at = uvec2(gl_FragCoord.xy);
  seed = at.x * 1973u + at.y * 9277u + frame * 26699u + 1u;
  random();
  vec3 from = eye, d = normalize(viewRay(uv));
  vec3 sum = vec3(0.0), share = vec3(1.0), first_color = vec3(1.0);
  vec4 first = vec4(0.0, 0.0, 0.0, -1.0);
  vec2 moved = vec2(0.0);
  for (int bounce = 0; bounce <= bounces; ++bounce) {
    Hit hit = trace(from, d);
    if (hit.way >= 1e30) {
      sum += share * skyAt(d);
      break;
    }
    from += d * hit.way;
    if (bounce == 0) {
      first = vec4(hit.normal, hit.way);
      first_color = max(hit.color, 0.02);
      vec4 before = previous_view_projection * vec4(from, 1.0);
      moved = uv - (0.5 * before.xy / before.w + 0.5);
    } else {
      share *= hit.color;
    }
    vec3 mirror = reflect(d, hit.normal);
    d = hit.metallic > 0.5 ? normalize(mirror + hit.roughness * hit.roughness * (scattered(hit.normal) - mirror)) : scattered(hit.normal);
    if (dot(d, hit.normal) <= 0.0) break;
    from += 1e-3 * hit.normal;
  }
#ifdef HAS_LIGHT
  light = vec4(min(sum, 60.0), 1.0);
#endif
#ifdef HAS_ALBEDO
  albedo = vec4(first_color, 1.0);
#endif
#ifdef HAS_SURFACE
  surface = first;
#endif
#ifdef HAS_MOTION
  motion = moved;
#endif
}
