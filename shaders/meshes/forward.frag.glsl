// A mesh lit by the environment, as spheres are. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         brdf, irradiance?, specular?, environment?, probes?, sh?   see spheres/shading.glsl; without one its light is missing
// modify  radiance   scene-referred; alpha 1, with BLEND premultiplied by the material's: blend "premultiplied"
//         velocity   screen UV per frame
//         depth      reversed-Z
// params  sky_turn?, compensation   see spheres/shading.glsl
#include "common/view.glsl"
#include "meshes/surface.glsl"
#include "spheres/shading.glsl"

#ifndef BLEND
#define BLEND 0
#endif

#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

void main() {
  MeshSurface self = meshSurface();
#ifdef HAS_RADIANCE
  vec3 v = normalize(eye - world_position);
  float nv = clamp(dot(self.normal, v), 0.0, 1.0);
  Surface surface = Surface(self.albedo, self.metallic, self.roughness);
  vec3 lit = shade(surface, world_position, self.normal, reflect(-v, self.normal), nv, lobeOf(self.roughness, 0.0));
  float share = BLEND == 1 ? self.alpha : 1.0;
  radiance = vec4((lit * self.occlusion + self.emissive) * share, share);
#endif
#ifdef HAS_VELOCITY
  velocity = meshVelocity(viewport);
#endif
}
