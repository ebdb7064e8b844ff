// A mesh, lit as it is drawn. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         material_layers?            see meshes/layers.glsl
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
#ifdef HAS_MATERIAL_LAYERS
#include "meshes/layers.glsl"
#endif
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
#ifdef HAS_MATERIAL_LAYERS
  layers = meshLayers();
#endif
  MeshSurface self = meshSurface();
#ifdef HAS_RADIANCE
  vec3 v = normalize(eye - world_position), n = self.normal;
  Point point = Point(world_position, n, v, reflect(-v, n), clamp(dot(n, v), 0.0, 1.0), self.occlusion);
  Surface surface = Surface(self.albedo, self.metallic, self.roughness);
  Response response = responseOf(surface, point.nv);

  LightsSeen seen = lightsSeen(point);
  vec3 light = self.emissive;
#ifdef HAS_MATERIAL_LAYERS
  if (layers.on) response = enterLayers(point, surface);
  for (int layer = 0; layer < 2; ++layer) {
#endif
    Ambient ambient = ambientOf(point, response, lobeOf(response.roughness, 0.0), seen);
    light += lightOf(point, response, ambient, seen).radiance * self.lit;
#ifdef HAS_MATERIAL_LAYERS
    if (!layers.on || layers.coat <= 0.0) break;
    light *= coverWithCoat(point, response);
  }
#endif
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
