// A triangle mesh of the unit sphere, moved and scaled to each instance. Opaque: no order is needed. It culls back faces itself, so
// the graph draws it without "cull".
#include "common/view.glsl"
#include "scene/instances.glsl"
#include "shading/parameters.glsl"
#include "shading/lobe.glsl"
#include "spheres/glint_of.glsl"
#define VERTEX_STAGE
#include "spheres/lobe_varyings.glsl"

in vec3 position;
in vec3 normal;

out vec3 from_eye;          // world, eye to surface
out vec3 outwards;          // world, not normalized
flat out vec4 albedo_roughness;
flat out vec4 motion_metallic;
#ifdef HAS_NEIGHBORS
flat out float sphere_radius;
#endif
out float gl_CullDistance[1];   // a triangle goes when all of its corners are below 0

void main() {
  Instance self = instance[gl_InstanceID];
#ifdef HAS_NEIGHBORS
  sphere_radius = self.radius;
#endif
  from_eye = self.center - eye + self.radius * position;
  outwards = normal;
  albedo_roughness = vec4(self.albedo, self.roughness);
  motion_metallic = vec4(self.center - self.previous_center, self.metallic);
  float depth = -(view * vec4(self.center, 1.0)).z;
  float bend = max(depth, 0.0) / self.radius;
  Lobe lobe = lobeOf(self.roughness, lookupAngle() * bend);
  Glint glint = glintOf(lobe, self.center, self.radius, pixelAngle() * bend);
  writeLobe(lobe, glint, uint(gl_InstanceID));
  // The inside of a sphere is visible when the eye is in it or the near plane cuts it. Of all others, back faces are culled.
  float near_corner = near_plane * length(vec3(1.0 / projection[0].x, 1.0 / projection[1].y, 1.0));
  bool open = length(self.center - eye) < self.radius + near_corner;
  gl_CullDistance[0] = open ? 1.0 : -dot(normal, from_eye);
  gl_Position = view_projection * vec4(self.center + self.radius * position, 1.0);
}
