// The surface of a mesh as the G-buffer holds it, see deferred/gbuffer.glsl. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
// modify  normal, base, metallic_roughness, emissive?, velocity?, position? (rgba16f, world: to compare with what depth says), depth
// define  SPECULAR_AA                 see meshes/surface.glsl
#include "deferred/gbuffer.glsl"
#include "meshes/surface.glsl"

#ifdef HAS_NORMAL
out vec2 normal;
#endif
#ifdef HAS_BASE
out vec4 base;
#endif
#ifdef HAS_METALLIC_ROUGHNESS
out vec4 metallic_roughness;
#endif
#ifdef HAS_EMISSIVE
out vec3 emissive;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif
#ifdef HAS_POSITION
out vec4 position;
#endif

void main() {
  MeshSurface self = meshSurface();
#ifdef HAS_NORMAL
  normal = encodeNormal(self.normal);
#endif
#ifdef HAS_BASE
  base = vec4(self.albedo, 1.0);
#endif
#ifdef HAS_METALLIC_ROUGHNESS
  metallic_roughness = vec4(self.metallic, self.roughness, self.occlusion, self.shininess > 0.0 ? encodeExponent(self.shininess) : 0.0);
#endif
#ifdef HAS_EMISSIVE
  emissive = self.emissive;
#endif
#ifdef HAS_VELOCITY
  velocity = meshVelocity(viewport);
#endif
#ifdef HAS_POSITION
  position = vec4(world_position, 1.0);
#endif
}
