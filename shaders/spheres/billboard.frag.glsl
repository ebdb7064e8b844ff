// One sphere, found by intersecting the ray of the pixel; lit by the environment, the sun and lamps.
// read    air?: fog/fog.glsl; the lights: spheres/light.glsl
//         front_depth?   only what is behind this depth is drawn; any sampler (texels are fetched)
// modify  radiance   scene-referred, premultiplied by coverage: blend "premultiplied"
//         velocity   screen UV per frame; not blended, the nearest sphere's
//         depth      near / distance along the view axis (reversed-Z)
// params, defines    see shading/light.glsl
//         SHOW_LAMPS    instead of light, how many lamps each pixel goes through, see shading/show_lamps.glsl
//
// Coverage comes from the signed distance in pixels from the pixel's center to the silhouette, which is a conic: exact along its normal, no
// derivatives; where two cross in a pixel, the spheres blend as if their edges were independent. Depth goes with every pixel that is covered at all, at the point of tangency outside the silhouette: the test and the write
// of a fragment cannot be parted, and drawn back to front whatever lies behind is there already.
#include "common/view.glsl"
#include "fog/fog.glsl"
#include "shading/show_lamps.glsl"
#include "spheres/billboard_varyings.glsl"
#include "spheres/light.glsl"

mat3 to_world = mat3(right_eye.xyz, up_eye.xyz, cross(right_eye.xyz, up_eye.xyz));

#ifdef HAS_FRONT_DEPTH
uniform sampler2D front_depth;
#endif
#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

// Area of a unit square on the inner side of a straight edge: `inside` is the signed distance of its center, `normal`
// the edge's direction, both components positive. A ramp for edges along the axes, smoother for slanted ones.
float halfPlane(float inside, vec2 normal) {
  float a = max(normal.x, normal.y), b = min(normal.x, normal.y);
  float corner = max(0.5 * (a + b) - abs(inside), 0.0);
  bool ramp = abs(inside) <= 0.5 * (a - b);
  float beyond = (ramp ? 0.5 * a - abs(inside) : corner * corner) / (ramp ? a : max(2.0 * a * b, 1e-9));
  return inside > 0.0 ? 1.0 - beyond : beyond;
}

// Where the ray of the pixel meets the sphere.
struct Hit {
  float coverage;  // the sphere's share of the pixel; 0: the ray misses
  float distance;  // along the view axis
  float along;     // the ray, up to the hit
  vec3 normal;     // unit, in view space
  vec3 to_eye;     // unit, in view space
  float nv;        // cosine between the two
};

Hit hitSphere() {
  float near = abs(edge_metallic.w), silhouette_shift = edge_metallic.x, square_side = edge_metallic.y;
  bool from_center = edge_metallic.w > 0.0;  // pixel offsets count from the sphere's center, else from the view's axis
  vec3 c = sphere.xyz;
  float r = sphere.w, r2 = r * r, d2 = dot(c, c);
  vec2 per_pixel = anchor_slope.zw, pixels = gl_FragCoord.xy - anchor_slope.xy, offset = pixels * per_pixel;
  vec2 anchor = from_center ? c.xy / -c.z : vec2(0.0);
  vec3 v = vec3(anchor + offset, -1.0);               // the ray; its parameter is the distance along the view axis
  vec3 w = from_center ? vec3(offset, 0.0) : v;       // c x w = c x v, without cancellation for distant spheres
  vec3 cw = cross(c, w);
  float vv = dot(v, v), cv = dot(c, v), per_length = inversesqrt(vv), per_vv = per_length * per_length;
  float q = dot(cw, cw) - r2 * vv;                    // the silhouette's conic: negative inside

  // Signed distance in pixels along the conic's gradient.
  vec2 slope = (2.0 * (d2 * w.xy - dot(c, w) * c.xy - r2 * v.xy)) * per_pixel;
  float steep = length(slope);
  vec2 outwards = slope * (1.0 / max(steep, 1e-30));
  vec3 across = vec3(outwards * per_pixel, 0.0), c_across = cross(c, across);
  float curve = dot(c_across, c_across) - r2 * dot(across, across);
  float outside = 2.0 * q / max(steep + sqrt(max(steep * steep - 4.0 * curve * q, 0.0)), 1e-30);
  float inside = -outside - silhouette_shift;
  float coverage = d2 <= r2 ? 1.0 : halfPlane(inside, abs(outwards));
  if (square_side > 0.0) {  // small ones only
    vec2 lengths = clamp(0.5 * (square_side + 1.0) - abs(pixels), 0.0, min(square_side, 1.0));
    coverage = mix(lengths.x * lengths.y, coverage, clamp(square_side * inversesqrt(kPi) - 0.8, 0.0, 1.0));
  }

  // The nearer hit, or the farther one when the nearer is in front of the near plane: then the inside is seen.
  float root = sqrt(max(-q, 0.0));
  float side = (cv - root) * per_vv >= near ? -1.0 : 1.0;
  float t = (cv + side * root) * per_vv;
  if (t < near) coverage = 0.0;
#ifdef HAS_FRONT_DEPTH
  if (near / t >= 0.9999 * texelFetch(front_depth, ivec2(gl_FragCoord.xy), 0).r) coverage = 0.0;
#endif
#if SEES_SCENE  // pixels beside each other share what they see
  if (sumOfQuad(vec4(coverage <= 0.0 ? 1.0 : 0.0)).x == 4.0) discard;
#else
  if (coverage <= 0.0) discard;
#endif

  // From the center to the hit: the ray's nearest point to the center is (c x v) x v / v.v away from it.
  vec3 out_of = (cross(cw, v) + side * root * v) * per_vv;
  vec3 normal = out_of * (-side * inversesqrt(max(dot(out_of, out_of), 1e-30)));  // a far speck has none
  return Hit(coverage, t, t / per_length, normal, v * -per_length, clamp(root * per_length / r, 0.0, 1.0));
}

void main() {
  Hit hit = hitSphere();
  vec3 v = to_world * hit.to_eye, from_eye = v * -hit.along;
#ifdef HAS_RADIANCE
  vec3 n = to_world * hit.normal;
  vec3 position = from_eye + vec3(right_eye.w, up_eye.w, before_eye.w);
  Point point = Point(position, n, v, 2.0 * hit.nv * n - v, hit.nv, 1.0);
  Surface surface = Surface(albedo_roughness.rgb, edge_metallic.z, albedo_roughness.w);
  float glint = glintStrength(readGlint(), gl_FragCoord.xy, hit.coverage);
  Light light = sphereLight(point, surface, readLobe(), glint, readRow(), sphere.w);
#ifdef HAS_AIR
  light.radiance = mix(fog_light.rgb, light.radiance, throughFog(from_eye));
#endif
#if SHOW_LAMPS
  light.radiance = colorOfLamps(light.lamps_tried);
#endif
  radiance = vec4(light.radiance * hit.coverage, hit.coverage);
#endif
#ifdef HAS_VELOCITY
  // x, y and w in last frame's clip space.
  mat3 turn = mat3(previous_view_projection[0].xyw, previous_view_projection[1].xyw, previous_view_projection[2].xyw);
  vec3 before = turn * from_eye + before_eye.xyz;
  velocity = gl_FragCoord.xy / viewport - (before.xy / max(before.z, 1e-3) * 0.5 + 0.5);
#endif
#ifdef HAS_DEPTH
  gl_FragDepth = abs(edge_metallic.w) / hit.distance;
#endif
  if (hit.coverage <= 0.0) discard;
}
