// The light that reaches the ground, and the view as varyings: in software an input costs less than a member of a block.
#include "common/equirect.glsl"
#include "common/fullscreen.glsl"
#include "common/view.glsl"
#include "ibl/brightest.glsl"
#include "scene/ground.glsl"
#include "shading/parameters.glsl"
#ifdef HAS_SUN
#include "scene/sun.glsl"
#endif

#ifdef HAS_IRRADIANCE
uniform sampler2D irradiance;
#endif

noperspective out vec2 uv;
flat out vec4 lens;         // a ray's slope is (ndc + xy) / zw
flat out mat3 turn;         // from world to view space
flat out vec3 from;         // the eye
flat out vec2 near_height;  // the near plane, the ground's height
flat out vec4 albedo_radius;  // of its surface
#ifdef HAS_RADIANCE
flat out vec3 from_sky;     // irradiance over pi, of the sky without its spots
#ifdef HAS_SUN
flat out vec3 from_sun;
#endif
#endif
#ifdef HAS_VELOCITY
flat out mat4x3 before;     // x, y and w in last frame's clip space
#endif

void main() {
  Ground self = ground_row[0];
  lens = vec4(projection[2].xy, projection[0].x, projection[1].y);
  turn = mat3(view);
  from = eye;
  near_height = vec2(near_plane, self.height);
  albedo_radius = vec4(self.albedo, self.radius);
#ifdef HAS_RADIANCE
  from_sky = vec3(0.0);
#ifdef HAS_IRRADIANCE
  vec2 lookup = vec2(0.0, 0.5 / float(textureSize(irradiance, 0).y));
  from_sky = sampleEquirect(irradiance, vec2(0.0), lookup).rgb;
  from_sky = max(from_sky - spotsFromAbove() * vec4(1.0), vec3(0.0));
#endif
#ifdef HAS_SUN
  from_sun = sun_light[0].irradiance * (max(sun_light[0].direction.y, 0.0) / kPi);
#endif
#endif
#ifdef HAS_VELOCITY
  before = mat4x3(previous_view_projection[0].xyw, previous_view_projection[1].xyw, previous_view_projection[2].xyw,
                  previous_view_projection[3].xyw);
#endif
  gl_Position = fullscreenPosition(uv);
}
