// A mesh, lit as it is drawn. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         air?                        see fog/fog.glsl
//         the lights: shading/light.glsl
// modify  radiance   scene-referred; alpha 1, with BLEND premultiplied by the material's: blend "premultiplied"
//         velocity   screen UV per frame
//         depth      reversed-Z
// params, defines    see shading/light.glsl
#include "common/view.glsl"
#include "fog/fog.glsl"
#include "meshes/surface.glsl"
#include "shading/cook_torrance.glsl"
#include "shading/light.glsl"
#include "shading/lobe.glsl"

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
  vec3 v = normalize(eye - world_position), n = self.normal;
  Point point = Point(world_position, n, v, reflect(-v, n), clamp(dot(n, v), 0.0, 1.0), self.occlusion);
  Response response = responseOf(Surface(self.albedo, self.metallic, self.roughness), point.nv);

  LightsSeen seen = lightsSeen(point);
  Ambient ambient = ambientOf(point, response, lobeOf(self.roughness, 0.0), seen);
  vec3 light = lightOf(point, response, ambient, seen).radiance * self.lit + self.emissive;
#ifdef HAS_AIR
  light = mix(fog_light.rgb, light, throughFog(world_position - eye));
#endif
  float share = BLEND == 1 ? self.alpha : 1.0;
  radiance = vec4(light * share, share);
#endif
#ifdef HAS_VELOCITY
  velocity = meshVelocity(viewport);
#endif
}
