// What a mesh emits and reflects towards the eye, through the layers of its material and the air. Behind meshes/surface.glsl and a
// shading model. Slots: air?, see fog/fog.glsl; material_layers?, see meshes/layers.glsl; behind?, see meshes/behind.glsl; the lights, see shading/light.glsl
#ifndef MESHES_RADIANCE_GLSL
#define MESHES_RADIANCE_GLSL

#include "fog/fog.glsl"
#include "meshes/surface.glsl"
#ifdef HAS_MATERIAL_LAYERS
#include "meshes/layers.glsl"
#endif
#include "shading/light.glsl"
#include "shading/lobe.glsl"
#ifdef HAS_BEHIND
#include "meshes/behind.glsl"
#endif

#ifndef LAYERED
#define LAYERED 0
#endif

vec3 meshRadiance(MeshSurface self, Surface surface, Response response, Point point) {
  LightsSeen seen = lightsSeen(point);
  vec3 light = self.emissive, through = vec3(0.0);
#ifdef HAS_MATERIAL_LAYERS
  if (layers.on) response = enterLayers(point, surface);
  for (int layer = 0; layer < 2; ++layer) {
#endif
    Ambient ambient = ambientOf(point, response, lobeOf(response.roughness, 0.0), seen);
    light += lightOf(point, response, ambient, seen).radiance * self.lit;
#ifdef HAS_MATERIAL_LAYERS
#ifdef HAS_BEHIND
    if (layers.on && greatest(layers.passed) > 0.0) through = layers.passed * lightFromBehind(point, response);
#endif
    if (!layers.on || layers.coat <= 0.0) break;
    float below = coverWithCoat(point, response);
    light *= below;
    through *= below;
  }
#endif
#if defined HAS_AIR && !LAYERED  // what lies over the G-buffer is fogged with it
  light = mix(fog_light.rgb, light, throughFog(world_position - eye));
#endif
  return light + through;
}

#endif
