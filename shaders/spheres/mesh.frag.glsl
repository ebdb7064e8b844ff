// One triangle of a sphere, lit as the ray-traced ones of spheres/billboard are.
// read    air?: fog/fog.glsl; the lights: spheres/light.glsl
// write or modify  radiance   scene-referred; alpha 1
//                  velocity   screen UV per frame
//                  thing      which sphere it is: the complement of its row (r32ui)
//                  depth      near / distance along the view axis (reversed-Z)
// params, defines    see shading/light.glsl
#include "common/view.glsl"
#include "fog/fog.glsl"
#include "spheres/light.glsl"
#include "spheres/lobe_varyings.glsl"

in vec3 from_eye;
in vec3 outwards;
flat in vec4 albedo_roughness;
flat in vec4 motion_metallic;
#ifdef HAS_NEIGHBORS
flat in float sphere_radius;
#else
const float sphere_radius = 0.0;
#endif

#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif
#ifdef HAS_THING
out uint thing;
#endif

void main() {
#ifdef HAS_THING
  thing = ~readRow();
#endif
#ifdef HAS_RADIANCE
  vec3 n = normalize(gl_FrontFacing ? outwards : -outwards), v = normalize(from_eye);
  float nv = clamp(-dot(n, v), 0.0, 1.0);
  Point point = Point(eye + from_eye, n, -v, v + 2.0 * nv * n, nv, 1.0);
  Surface surface = Surface(albedo_roughness.rgb, motion_metallic.w, albedo_roughness.w);
  float glint = glintStrength(readGlint(), gl_FragCoord.xy, 1.0);
  vec3 light = sphereLight(point, surface, readLobe(), glint, readRow(), sphere_radius).radiance;
#ifdef HAS_AIR
  light = mix(fog_light.rgb, light, throughFog(from_eye));
#endif
  radiance = vec4(light, 1.0);
#endif
#ifdef HAS_VELOCITY
  vec4 before = previous_view_projection * vec4(eye + from_eye - motion_metallic.xyz, 1.0);
  velocity = gl_FragCoord.xy / viewport - (before.xy / max(before.w, 1e-3) * 0.5 + 0.5);
#endif
}
