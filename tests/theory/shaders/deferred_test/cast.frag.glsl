// An analytic G-buffer: the spheres of the scene and a horizontal plane, met by the ray through each pixel's center.
// read    instances   @spheres
// write   normal, base, metallic_roughness, emissive, position, depth   as deferred/gbuffer.glsl has them; position is world, alpha 1
//         back        depth where the ray leaves what it has met; 0 for the plane
// params  count       spheres
//         floor_y     height of the plane
//         floor_mro   its metallic, roughness, occlusion, and which model
//         ball_model  metallic_roughness.a of the spheres
//         floor_albedo, glow (emissive of the spheres)
// FLOOR   0: no plane
#include "deferred/gbuffer.glsl"
#include "scene/instances.glsl"

layout(std140) uniform Parameters {
  int count;
  float floor_y;
  vec4 floor_mro;
  vec3 floor_albedo;
  float ball_model;
  vec3 glow;
};
in vec2 uv;
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
out vec4 emissive;
#endif
#ifdef HAS_POSITION
out vec4 position;
#endif
#ifdef HAS_BACK
out float back;
#endif

void main() {
  vec3 ray = viewRay(uv), hit_normal = vec3(0.0, 1.0, 0.0), albedo = floor_albedo, light = vec3(0.0);
  vec4 kind = floor_mro;
  float nearest = 1e30, leaves = 1e30;
#if FLOOR
  float to_floor = (floor_y - eye.y) / ray.y;
  if (to_floor > near_plane) nearest = to_floor;
#endif
  for (int i = 0; i < count; ++i) {
    Instance self = instance[i];
    vec3 to = self.center - eye, across = cross(to, ray);
    float vv = dot(ray, ray), root2 = self.radius * self.radius * vv - dot(across, across);
    if (root2 <= 0.0) continue;
    float t = (dot(to, ray) - sqrt(root2)) / vv;
    if (t < near_plane || t >= nearest) continue;
    nearest = t;
    leaves = (dot(to, ray) + sqrt(root2)) / vv;
    hit_normal = (ray * t - to) / self.radius;
    albedo = self.albedo;
    kind = vec4(self.metallic, self.roughness, 1.0, ball_model);
    light = glow;
  }
  bool hit = nearest < 1e30;
#ifdef HAS_NORMAL
  normal = encodeNormal(normalize(hit_normal));
#endif
#ifdef HAS_BASE
  base = vec4(albedo, 1.0);
#endif
#ifdef HAS_METALLIC_ROUGHNESS
  metallic_roughness = kind;
#endif
#ifdef HAS_EMISSIVE
  emissive = vec4(light, 1.0);
#endif
#ifdef HAS_POSITION
  position = hit ? vec4(eye + ray * nearest, 1.0) : vec4(0.0);
#endif
#ifdef HAS_BACK
  back = leaves < 1e30 ? near_plane / leaves : 0.0;
#endif
  gl_FragDepth = hit ? near_plane / nearest : 0.0;
}
