// A mesh lit by the environment, the sun and lamps, as spheres are. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         what light comes from       see shading/light.glsl; air?: fog/fog.glsl
// modify  radiance   scene-referred; alpha 1, with BLEND premultiplied by the material's: blend "premultiplied"
//         velocity   screen UV per frame
//         depth      reversed-Z
// params, defines    see shading/light.glsl
#include "common/view.glsl"
#include "fog/fog.glsl"
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

vec3 emitted = vec3(0.0);
float occlusion = 1.0, share = 1.0;

void findPoint(out Point point) {
  MeshSurface self = meshSurface();
#ifdef HAS_RADIANCE
  point.at = world_position;
  point.n = self.normal;
  point.v = normalize(eye - world_position);
  point.nv = clamp(dot(point.n, point.v), 0.0, 1.0);
  point.mirror = reflect(-point.v, point.n);
  point.roughness = self.roughness;
  point.surface = Surface(self.albedo, self.metallic, self.roughness);
  emitted = self.emissive;
  occlusion = self.occlusion;
  share = BLEND == 1 ? self.alpha : 1.0;
#endif
#ifdef HAS_VELOCITY
  velocity = meshVelocity(viewport);
#endif
}

void putLight(Point point, vec3 from_around, vec3 from_lights, int lamps_tried) {
#ifdef HAS_RADIANCE
  vec3 light = from_around * occlusion + from_lights + emitted;
#ifdef HAS_AIR
  light = mix(fog_light.rgb, light, throughFog(world_position - eye));
#endif
  radiance = vec4(light * share, share);
#endif
}
