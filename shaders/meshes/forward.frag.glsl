// A mesh, lit as it is drawn. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         material_layers?            see meshes/layers.glsl
//         behind?                     see meshes/behind.glsl
//         air?, the lights            see meshes/radiance.glsl
// modify  radiance   scene-referred; alpha 1, with BLEND premultiplied by the material's: blend "premultiplied"
//         velocity   screen UV per frame
//         thing      which row of the list it is, from 1 on (r32ui)
//         depth      reversed-Z
// params, defines    see shading/light.glsl
#include "common/view.glsl"
#include "meshes/surface.glsl"
#include "shading/cook_torrance.glsl"
#include "meshes/radiance.glsl"

#ifndef BLEND
#define BLEND 0
#endif

#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif
#ifdef HAS_THING
flat in uint mesh_thing;
out uint thing;
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
  float share = BLEND == 1 ? self.alpha : 1.0;
  radiance = vec4(light * share, share);
#endif
#ifdef HAS_VELOCITY
  velocity = meshVelocity(viewport);
#endif
#ifdef HAS_THING
  thing = mesh_thing;
#endif
  if (hidden) discard;
}
