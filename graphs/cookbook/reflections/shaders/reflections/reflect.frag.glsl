// What surfaces reflect of the picture, in place of what they reflected of the environment. Added.
// read    nearest           see reflections/coarser.frag.glsl
//         light             the picture, blurred more at each level
//         bare, depth       depth without and with spheres: those keep their own reflections
//         normal, base, metallic_roughness   see deferred/gbuffer.glsl
//         ao?               ambient visibility
//         brdf, specular, environment, brightest   see shading/ambient.glsl
// modify  radiance          scene-referred
// define  STEPS             of a ray, at most
#include "deferred/gbuffer.glsl"
#include "deferred/shading_model.glsl"

#define HAS_SKY_TURN 1
layout(std140) uniform Parameters { float thickness; float roughest; float sky_turn; };
#include "shading/ambient.glsl"
#include "shading/lobe.glsl"

uniform sampler2D nearest, light, bare, depth, normal, base, metallic_roughness;
#ifdef HAS_AO
uniform sampler2D ao;
#endif
in vec2 uv;
out vec4 radiance;

// A point of the world in pixels and depth, in which straight lines stay straight.
vec3 inPicture(vec4 clip) { return vec3((clip.xy / clip.w * 0.5 + 0.5) * viewport, clip.z / clip.w); }

// Where the ray meets something, in pixels; z: 1, or 0 where it meets nothing.
vec3 trace(vec3 from, vec3 direction) {
  vec4 clip = view_projection * vec4(from, 1.0), slope = view_projection * vec4(direction, 0.0);
  // As far as there is, or to the near plane.
  vec3 a = inPicture(clip), b = inPicture(slope.w > 1e-4 ? slope : clip + slope * (clip.w - 1.01 * near_plane) / max(-slope.w, 1e-4));
  vec3 way = b - a;
  way.xy = mix(way.xy, vec2(1e-6), lessThan(abs(way.xy), vec2(1e-6)));
  vec2 edges = (mix(vec2(0.0), viewport, greaterThan(way.xy, vec2(0.0))) - a.xy) / way.xy;
  float end = min(min(edges.x, edges.y), 1.0), nudge = 0.01 / max(abs(way.x), abs(way.y));

  int level = 0, last = textureQueryLevels(nearest) - 1;
  float t = 0.0;
  for (int i = 0; i < STEPS && t < end; ++i) {
    vec2 cell = floor((a.xy + t * way.xy) / exp2(float(level)));
    vec2 sides = ((cell + vec2(greaterThan(way.xy, vec2(0.0)))) * exp2(float(level)) - a.xy) / way.xy;
    float leave = max(min(sides.x, sides.y), t) + nudge;
    float d0 = a.z + t * way.z, d1 = max(a.z + leave * way.z, 0.0);
    float there = texelFetch(nearest, ivec2(cell), level).r;
    bool own = i == 0;  // the cell that the ray starts in
    if (own || there <= min(d0, d1)) {
      t = leave;
      level = min(level + 1, last);
    } else if (level > 0) {
      --level;
    } else {
      // Between its front and its back, which nobody knows.
      float front = distanceOfDepth(there);
      if (distanceOfDepth(max(d0, d1)) < front + thickness) return vec3(a.xy + mix(t, min(leave, end), 0.5) * way.xy, 1.0);
      t = leave;
    }
  }
  return vec3(0.0);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float z = texelFetch(bare, at, 0).r;
  vec4 stored = texelFetch(metallic_roughness, at, 0);
  if (z <= 0.0 || z != texelFetch(depth, at, 0).r || stored.g >= roughest) discard;
  float visible = stored.b;
#ifdef HAS_AO
  visible = min(visible, texelFetch(ao, at, 0).r);
#endif
  Point point = pointAt(positionOfDepth(uv, z), decodeNormal(texelFetch(normal, at, 0).rg), visible);
  Response response = modelResponse(Surface(texelFetch(base, at, 0).rgb, stored.r, stored.g), 0.0, point.nv);
  vec3 axis = normalize(lobeAxis(point, response));
  if (dot(axis, point.normal) <= 0.0) discard;

  vec3 hit = trace(point.position + 0.002 * distance(eye, point.position) * point.normal, axis);
  if (hit.z == 0.0) discard;
  // A lobe is as wide as alpha of its length, about.
  float wide = 2.0 * alphaOfRoughness(stored.g) * distance(hit.xy, gl_FragCoord.xy);
  vec3 seen = textureLod(light, hit.xy / viewport, max(log2(max(wide, 1.0)) - 1.0, 0.0)).rgb;
  // Less towards the edges of the picture, where it ends, and the more, the rougher.
  vec2 edge = smoothstep(vec2(0.0), vec2(0.08), 0.5 - abs(hit.xy / viewport - 0.5));
  float share = edge.x * edge.y * smoothstep(roughest, 0.6 * roughest, stored.g);

  vec3 sky = ambientOf(point, response, lobeOf(response.roughness, 0.0), LightsSeen(1.0, 1.0)).reflected;
  response.multiple = response.diffuse = vec3(0.0);
  vec3 before = ambientRadiance(point, response, Ambient(sky, vec3(0.0)));
  radiance = vec4(share * (seen * response.single - before), 0.0);
}
