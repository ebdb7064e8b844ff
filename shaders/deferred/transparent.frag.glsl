// A transparent mesh, lit by the lights of the G-buffer; without screen-space occlusion. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         air?                        see fog/fog.glsl
//         the lights: shading/light.glsl
// modify  radiance   scene-referred, premultiplied by the material's alpha: blend "premultiplied"
// params, defines    see shading/light.glsl and shading_model.glsl
#include "fog/fog.glsl"
#include "meshes/surface.glsl"
#include "shading_model.glsl"
#include "shading/light.glsl"
#include "shading/lobe.glsl"

#ifdef HAS_RADIANCE
out vec4 radiance;
#endif

void main() {
  MeshSurface self = meshSurface();
#ifdef HAS_RADIANCE
  Point point = pointAt(world_position, self.normal, self.occlusion);
  Response response = modelResponse(Surface(self.albedo, self.metallic, self.roughness), self.shininess, point.nv);

  LightsSeen seen = lightsSeen(point);
  Ambient ambient = ambientOf(point, response, lobeOf(response.roughness, 0.0), seen);
  vec3 light = lightOf(point, response, ambient, seen).radiance * self.lit + self.emissive;
#ifdef HAS_AIR
  light = mix(fog_light.rgb, light, throughFog(world_position - eye));
#endif
  radiance = vec4(light * self.alpha, self.alpha);
#endif
}
