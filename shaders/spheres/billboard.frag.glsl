// One sphere, found by intersecting the ray of the pixel; lit by the environment, the sun and lamps.
// read    what light comes from   see shading/light.glsl; air?: fog/fog.glsl
//         silhouettes?  spheres before this one whose silhouettes meet its own, see spheres/silhouettes.glsl
//         nearer?     a depth: only what is behind it is drawn; any sampler (texels are fetched)
// modify  radiance   scene-referred, premultiplied by coverage: blend "premultiplied"
//         velocity   screen UV per frame; not blended, the nearest sphere's
//         depth      near / distance along the view axis (reversed-Z)
// params, defines    see shading/light.glsl
//         SHOW_LAMPS    instead of light, how many lamps each pixel goes through, see shading/show_lamps.glsl
//
// Coverage comes from the signed distance in pixels from the pixel's centre to the silhouette, which is a conic: exact along
// its normal, no derivatives. Depth goes with every pixel that is covered at all, at the point of tangency outside the silhouette:
// the test and the write of a fragment cannot be parted, and drawn back to front whatever lies behind is there already.
#include "common/view.glsl"
#include "fog/fog.glsl"
#define LOBE_IS_FLAT 1
#include "shading.glsl"
#ifndef SHOW_LAMPS
#define SHOW_LAMPS 0
#endif
#if SHOW_LAMPS
#include "shading/show_lamps.glsl"
#endif

#include "spheres/handed.glsl"
mat3 to_world = mat3(right_eye.xyz, up_eye.xyz, cross(right_eye.xyz, up_eye.xyz));
#ifdef HAS_VELOCITY
// x, y and w in last frame's clip space of a direction in the world.
mat3 before_turn = mat3(previous_view_projection[0].xyw, previous_view_projection[1].xyw, previous_view_projection[2].xyw);
#endif

#ifdef HAS_NEARER
uniform sampler2D nearer;
#endif
#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

#include "silhouettes.glsl"

// Area of a unit square on the inner side of a straight edge: `inside` is the signed distance of its centre, `normal`
// the edge's direction, both components positive. A ramp for edges along the axes, smoother for slanted ones.
float halfPlane(float inside, vec2 normal) {
  float a = max(normal.x, normal.y), b = min(normal.x, normal.y);
  float corner = max(0.5 * (a + b) - abs(inside), 0.0);
  bool ramp = abs(inside) <= 0.5 * (a - b);
  float beyond = (ramp ? 0.5 * a - abs(inside) : corner * corner) / (ramp ? a : max(2.0 * a * b, 1e-9));
  return inside > 0.0 ? 1.0 - beyond : beyond;
}

vec3 from_eye = vec3(0.0);
#if SEES_NEIGHBOURS
vec2 sphereOf() { return vec2(anchor_row.w, sphere.w); }
#endif
void findPoint(out Point point) {
  vec3 c = sphere.xyz;
  vec2 edge = edge_metallic.xy, anchor = edge_metallic.z > 0.0 ? c.xy / -c.z : vec2(0.0);
  float near_distance = anchor_row.z;
  float r = sphere.w, r2 = r * r, d2 = dot(c, c);
  vec2 pixels = gl_FragCoord.xy - anchor_row.xy, offset = pixels * per_pixel.xy;
  vec3 v = vec3(anchor + offset, -1.0);          // the ray; its parameter is the distance along the view axis
  vec3 w = edge_metallic.z > 0.0 ? vec3(offset, 0.0) : v;  // c x w = c x v, without cancellation for distant spheres
  vec3 cw = cross(c, w);
  float vv = dot(v, v), cv = dot(c, v), per_length = inversesqrt(vv), per_vv = per_length * per_length;
  float q = dot(cw, cw) - r2 * vv;                  // the silhouette's conic: negative inside

  // Signed distance in pixels along the conic's gradient.
  vec2 slope = (2.0 * (d2 * w.xy - dot(c, w) * c.xy - r2 * v.xy)) * per_pixel.xy;
  float steep = length(slope);
  vec2 outwards = slope * (1.0 / max(steep, 1e-30));
  vec3 across = vec3(outwards * per_pixel.xy, 0.0);
  vec3 c_across = cross(c, across);
  float curve = dot(c_across, c_across) - r2 * dot(across, across);
  float outside = 2.0 * q / max(steep + sqrt(max(steep * steep - 4.0 * curve * q, 0.0)), 1e-30);
  bool inside_sphere = d2 <= r2;
  coverage = inside_sphere ? 1.0 : halfPlane(-outside - edge.x, abs(outwards));
#ifdef HAS_SILHOUETTES
  if (coverage > 0.0 && coverage < 1.0 && edge.y == 0.0) coverage = min(coverage * leftBehind(-outside - edge.x, outwards, v, vv), 1.0);
#endif

  if (edge.y > 0.0) {  // small ones only
    vec2 lengths = clamp(0.5 * (edge.y + 1.0) - abs(pixels), 0.0, min(edge.y, 1.0));
    coverage = mix(lengths.x * lengths.y, coverage, clamp(edge.y * inversesqrt(kPi) - 0.8, 0.0, 1.0));
  }

  // The nearer hit, or the farther one when the nearer is in front of the near plane: then the inside is seen.
  float root = sqrt(max(-q, 0.0));
  float side = (cv - root) * per_vv >= near_distance ? -1.0 : 1.0;
  float t = (cv + side * root) * per_vv;
  if (coverage <= 0.0 || t < near_distance) discard;
#ifdef HAS_NEARER
  if (near_distance / t >= 0.9999 * texelFetch(nearer, ivec2(gl_FragCoord.xy), 0).r) discard;
#endif

  // From the centre to the hit: the ray's foot is (c x v) x v / v.v away from it.
  vec3 out_of = (cross(cw, v) + side * root * v) * per_vv;
  vec3 normal_view = out_of * (-side * inversesqrt(max(dot(out_of, out_of), 1e-30)));  // a far speck has none
  float nv = clamp(root * per_length / r, 0.0, 1.0);
#ifdef HAS_RADIANCE
  point.n = to_world * normal_view;
  point.v = to_world * (v * -per_length);
  from_eye = point.v * (-t / per_length);
  point.mirror = 2.0 * nv * point.n - point.v;
  point.nv = nv;
  point.roughness = albedo_roughness.w;
  point.surface = Surface(albedo_roughness.rgb, edge_metallic.w, albedo_roughness.w);
#if defined HAS_PROBES || defined HAS_SUN || defined HAS_LAMPS || defined HAS_NEIGHBOURS || defined HAS_LIGHT_MAPS
  point.at = from_eye + vec3(right_eye.w, up_eye.w, before_eye.w);
#else
  point.at = vec3(0.0);
#endif
#endif
#ifdef HAS_VELOCITY
#ifndef HAS_RADIANCE
  from_eye = to_world * (v * t);
#endif
  vec3 before = before_turn * from_eye + before_eye.xyz;
  velocity = gl_FragCoord.xy * per_pixel.zw - (before.xy / max(before.z, 1e-3) * 0.5 + 0.5);
#endif
#ifdef HAS_DEPTH
  gl_FragDepth = near_distance / t;
#endif
}

void putLight(Point point, vec3 from_around, vec3 from_lights, int lamps_tried) {
#ifdef HAS_RADIANCE
  vec3 light = from_around + from_lights;
#ifdef HAS_AIR
  light = mix(fog_light.rgb, light, throughFog(from_eye));
#endif
#if SHOW_LAMPS
  light = colorOfLamps(lamps_tried);
#endif
  radiance = vec4(light * coverage, coverage);
#endif
}
