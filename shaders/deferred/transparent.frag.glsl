// A mesh that one sees through, lit by all that lights the G-buffer, occlusion from depth aside. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         air?                        see fog/fog.glsl
//         what light comes from       see shading/light.glsl
// modify  radiance   scene-referred, premultiplied by the material's alpha: blend "premultiplied"
// params, defines    see shading/light.glsl and light.glsl
#include "fog/fog.glsl"
#include "meshes/surface.glsl"
#include "light.glsl"

#ifdef HAS_RADIANCE
out vec4 radiance;
#endif

vec3 emitted = vec3(0.0);
float alpha = 1.0;

void findPoint(out Point point) {
  MeshSurface self = meshSurface();
  point.at = world_position;
  point.n = self.normal;
  point.surface = Surface(self.albedo, self.metallic, self.roughness);
  finishPoint(point, self.shininess);
  seen = self.occlusion;
  emitted = self.emissive;
  alpha = self.alpha;
}

void putLight(Point point, vec3 from_around, vec3 from_lights, int lamps_tried) {
#ifdef HAS_RADIANCE
  vec3 light = from_around + from_lights + emitted;
#ifdef HAS_AIR
  light = mix(fog_light.rgb, light, throughFog(world_position - eye));
#endif
  radiance = vec4(light * alpha, alpha);
#endif
}
