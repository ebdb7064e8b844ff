// The ground: where it has a surface, that, lit by sky, sun and the brightest spot; else what is behind, darkened by as much as light is
// missing. Spheres drawn before have left what light arrives.
// read    ground       see scene/ground.glsl
//         irradiance?, brightest?, sun?   light, see shading/ibl.glsl, ibl/brightest.glsl, scene/sun.glsl
//         sky?         rgb: share of the sky's light that arrives
//         lights?      x, y: shares of the sun's and of the brightest spot's
//         air?         see fog/fog.glsl
// modify  radiance     scene-referred; blend "premultiplied"
//         velocity     screen UV per frame
//         depth        near / distance along the view axis (reversed-Z)
// params  sky_turn     by how much of a full turn the environment is rotated
#include "common/equirect.glsl"
#include "common/view.glsl"
#include "fog/fog.glsl"
#include "ibl/brightest.glsl"
#include "scene/ground.glsl"
#ifdef HAS_SUN
#include "scene/sun.glsl"
#endif

#ifdef HAS_IRRADIANCE
uniform sampler2D irradiance;
#endif
#ifdef HAS_SKY
uniform sampler2D sky;
#endif
#ifdef HAS_LIGHTS
uniform sampler2D lights;
#endif
layout(std140) uniform Parameters { float sky_turn; };

in vec2 uv;
#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

void main() {
  Ground self = ground_row[0];
  vec3 ray = viewRay(uv);
  float t = (self.height - eye.y) / ray.y;
  if (eye.y <= self.height || ray.y >= 0.0 || t < near_plane) discard;
  vec3 at = eye + ray * t;
#ifdef HAS_RADIANCE
  // Irradiance over pi, of each light.
  vec3 from_sky = vec3(0.0), from_sun = vec3(0.0), from_spot = vec3(0.0);
  vec3 sky_seen = vec3(1.0);
  vec2 lights_seen = vec2(1.0);
#ifdef HAS_IRRADIANCE
  vec2 lookup = vec2(0.0, 0.5 / float(textureSize(irradiance, 0).y));
  from_sky = sampleEquirect(irradiance, vec2(0.0), lookup).rgb;
#ifdef HAS_BRIGHTEST
  from_spot = min(brightest_light.rgb * (max(towardsBrightest(sky_turn).y, 0.0) / kPi), from_sky);
  from_sky -= from_spot;
#endif
#endif
#ifdef HAS_SUN
  from_sun = sun_light[0].irradiance * (max(sun_light[0].direction.y, 0.0) / kPi);
#endif
#ifdef HAS_SKY
  sky_seen = texelFetch(sky, ivec2(gl_FragCoord.xy), 0).rgb;
#endif
#ifdef HAS_LIGHTS
  lights_seen = texelFetch(lights, ivec2(gl_FragCoord.xy), 0).xy;
#endif
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  vec3 arrives = from_sky * sky_seen + from_sun * lights_seen.x + from_spot * lights_seen.y;
  float all = dot(from_sky + from_sun + from_spot, luminance), left = all > 0.0 ? dot(arrives, luminance) / all : 1.0;
  float surface = self.radius > 0.0 ? 1.0 - smoothstep(0.5 * self.radius, self.radius, length(at.xz)) : 0.0;
  float kept = min(left, 1.0);  // of the light of the environment behind
  vec3 thrown = self.albedo * arrives;
#ifdef HAS_AIR
  float through = throughFog(at - eye);
  kept = mix(1.0, kept, through);
  thrown = mix(fog_light.rgb, thrown, through);
#endif
  radiance = vec4(thrown * surface, 1.0 - (1.0 - surface) * kept);
#endif
#ifdef HAS_VELOCITY
  vec4 before = previous_view_projection * vec4(at, 1.0);
  velocity = uv - (before.xy / max(before.w, 1e-3) * 0.5 + 0.5);
#endif
#ifdef HAS_DEPTH
  gl_FragDepth = near_plane / t;
#endif
}
