// One triangle of a sphere, lit by the environment as the ray-traced ones of spheres/billboard are.
// read    brdf, irradiance?, specular?, probes?, sh?   see shading/ibl.glsl; without one its light is missing
// write or modify  radiance   scene-referred; alpha 1
//                  velocity   screen UV per frame
//                  depth      near / distance along the view axis (reversed-Z)
// params  sky_turn?, compensation   see shading/ibl.glsl
#include "common/view.glsl"
#include "shading.glsl"

in vec3 from_eye;
in vec3 outwards;
flat in vec4 albedo_roughness;
flat in vec4 motion_metallic;
flat in vec3 lobe;

#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

void main() {
#ifdef HAS_RADIANCE
  vec3 n = normalize(outwards), v = normalize(from_eye);
  float nv = clamp(-dot(n, v), 0.0, 1.0);
  Surface surface = Surface(albedo_roughness.rgb, motion_metallic.w, albedo_roughness.w);
  radiance = vec4(shade(surface, eye + from_eye, n, v + 2.0 * nv * n, nv, lobe), 1.0);
#endif
#ifdef HAS_VELOCITY
  vec4 before = previous_view_projection * vec4(eye + from_eye - motion_metallic.xyz, 1.0);
  velocity = gl_FragCoord.xy / viewport - (before.xy / max(before.w, 1e-3) * 0.5 + 0.5);
#endif
}
