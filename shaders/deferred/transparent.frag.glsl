// A mesh that one sees through, lit by all that lights the G-buffer, occlusion from depth aside. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         what light comes from       see light.glsl; no clusters, whose tiles know the depths of the G-buffer only
// modify  radiance   scene-referred, premultiplied by the material's alpha: blend "premultiplied"
// params, defines    see light.glsl
#include "meshes/surface.glsl"
#include "light.glsl"

#ifdef HAS_RADIANCE
out vec4 radiance;
#endif

void main() {
  MeshSurface self = meshSurface();
  Surface surface = Surface(self.albedo, self.metallic, self.roughness);
  Point point = pointOf(world_position, self.normal, surface, self.shininess > 0.0 ? encodeExponent(self.shininess) : 0.0);
  int looked_at;
  vec3 sum = ambient(point, self.occlusion) + direct(point, ivec2(gl_FragCoord.xy), ivec2(viewport), looked_at) + self.emissive;
#ifdef HAS_RADIANCE
  radiance = vec4(sum * self.alpha, self.alpha);
#endif
}
