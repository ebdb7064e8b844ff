// One triangle of a sphere, lit as the ray-traced ones of spheres/billboard are.
// read    what light comes from   see shading/light.glsl; air?: fog/fog.glsl
// write or modify  radiance   scene-referred; alpha 1
//                  velocity   screen UV per frame
//                  depth      near / distance along the view axis (reversed-Z)
// params, defines    see shading/light.glsl
#include "common/view.glsl"
#include "fog/fog.glsl"
#define LOBE_IS_FLAT 1
#include "shading.glsl"

in vec3 from_eye;
in vec3 outwards;
flat in vec4 albedo_roughness;
flat in vec4 motion_metallic;
#if SEES_NEIGHBOURS
flat in vec2 row_radius;
vec2 sphereOf() { return row_radius; }
#endif

#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

void findPoint(out Point point) {
#ifdef HAS_RADIANCE
  point.at = eye + from_eye;
  point.n = normalize(gl_FrontFacing ? outwards : -outwards);
  vec3 v = normalize(from_eye);
  point.v = -v;
  point.nv = clamp(-dot(point.n, v), 0.0, 1.0);
  point.mirror = v + 2.0 * point.nv * point.n;
  point.roughness = albedo_roughness.w;
  point.surface = Surface(albedo_roughness.rgb, motion_metallic.w, albedo_roughness.w);
#endif
#ifdef HAS_VELOCITY
  vec4 before = previous_view_projection * vec4(eye + from_eye - motion_metallic.xyz, 1.0);
  velocity = gl_FragCoord.xy / viewport - (before.xy / max(before.w, 1e-3) * 0.5 + 0.5);
#endif
}

void putLight(Point point, vec3 from_around, vec3 from_lights, int lamps_tried) {
#ifdef HAS_RADIANCE
  vec3 light = from_around + from_lights;
#ifdef HAS_AIR
  light = mix(fog_light.rgb, light, throughFog(from_eye));
#endif
  radiance = vec4(light, 1.0);
#endif
}
