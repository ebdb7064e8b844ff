// A mesh, lit as it is drawn. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         material_layers?            see meshes/layers.glsl
//         behind?                     see meshes/behind.glsl
//         air?, the lights            see meshes/radiance.glsl
// modify  radiance   scene-referred, premultiplied by the material's alpha: blend "premultiplied" where it blends
//         velocity   screen UV per frame
//         depth      reversed-Z
// params, defines    see shading/light.glsl
#include "common/view.glsl"
#include "meshes/surface.glsl"
#include "shading/cook_torrance.glsl"
#include "meshes/radiance.glsl"

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
  vec3 v = towardsEye(world_position), n = self.normal;
  Point point = Point(world_position, n, v, reflect(-v, n), clamp(dot(n, v), 0.0, 1.0), self.occlusion);
  Surface surface = Surface(self.albedo, self.metallic, self.roughness);
  Response response = responseOf(surface, point.nv);
  vec3 light = meshRadiance(self, surface, response, point);
  radiance = vec4(light * self.alpha, self.alpha);
#endif
#ifdef HAS_VELOCITY
  velocity = meshVelocity(viewport);
#endif
}
