// The ground: its surface, lit by sky, sun, the brightest spots and lamps; beyond that the environment, darkened by the share of light that is
// blocked. What spheres block is drawn before.
// read    ground       see scene/ground.glsl
//         irradiance?, brightest?, sun?   see shading/environment.glsl, ibl/brightest.glsl, scene/sun.glsl
//         sky?         rgb: share of the sky's light that arrives; the target's size, not `as linear`
//         sun_seen?, spots_seen?   r: share of the sun's; rgba: of each spot's; as sky
//         light_maps?, light_depths?, scene_bounds?   shadows of meshes, see shading/mesh_shadow.glsl
//         mesh_sky?    the share of the sky's light that meshes leave, see ground/mesh_sky.frag.glsl; `as linear`, with scene_bounds
//         lamps?, brdf?, ltc?, lamp_maps?, clusters?, slices?   see shading/lamps.glsl; brdf with lamps
//         air?         see fog/fog.glsl
// modify  radiance     scene-referred; blend "premultiplied"
//         velocity     screen UV per frame
//         depth        near / distance along the view axis (reversed-Z)
// params  sky_turn, lamp_count?   see shading/parameters.glsl
// define  SURFACE_ALONE   nothing is drawn where there is no surface
//         SHOW_LAMPS      instead of light, how many lamps each pixel goes through, see shading/show_lamps.glsl
#include "fog/fog.glsl"
#include "ibl/brightest.glsl"
#include "shading/point.glsl"
#include "shading/parameters.glsl"
#include "shading/show_lamps.glsl"
#ifndef HAS_SKY_TURN
const float sky_turn = 0.0;
#endif
#if defined HAS_RADIANCE && defined HAS_LIGHT_MAPS && defined HAS_LIGHT_DEPTHS && defined HAS_SCENE_BOUNDS
#define SEES_MESHES 1
#include "shading/mesh_shadow.glsl"
#else
#define SEES_MESHES 0
#endif
#if defined HAS_RADIANCE && defined HAS_LAMPS
#include "shading/material.glsl"
// Of a white diffuse surface.
vec3 ambientRadiance(Point point, Response response, Ambient ambient) { return ambient.mean; }
vec3 directRadiance(Point point, Response response, vec3 l) { return vec3(max(dot(point.normal, l), 0.0) / kPi); }
#include "shading/lamps.glsl"
#endif
#if defined HAS_MESH_SKY && defined HAS_SCENE_BOUNDS
#include "ground/plain.glsl"
#include "shadow/scene_bounds.glsl"
uniform sampler2D mesh_sky;
#endif

#ifdef HAS_SKY
uniform sampler2D sky;
#endif
#ifdef HAS_SUN_SEEN
uniform sampler2D sun_seen;
#endif
#ifdef HAS_SPOTS_SEEN
uniform sampler2D spots_seen;
#endif

noperspective in vec2 uv;
flat in vec4 lens;
flat in mat3 turn;
flat in vec3 from;
flat in vec2 near_height;
flat in vec4 albedo_radius;
#ifdef HAS_RADIANCE
flat in vec3 from_sky;
#ifdef HAS_SUN
flat in vec3 from_sun;
#else
const vec3 from_sun = vec3(0.0);
#endif
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
flat in mat4x3 before;
out vec2 velocity;
#endif

void main() {
  vec2 slope = (uv * 2.0 - 1.0 + lens.xy) / lens.zw;
  vec3 x = turn[0], y = turn[1], z = turn[2];  // as viewRay has it
  vec3 ray = vec3(slope.x * x.x + slope.y * x.y - x.z, slope.x * y.x + slope.y * y.y - y.z, slope.x * z.x + slope.y * z.y - z.z);
  float near = near_height.x, height = near_height.y, t = (height - from.y) / ray.y;
  if (from.y <= height || ray.y >= 0.0 || t < near) discard;
  vec3 at = from + ray * t;
  float radius = albedo_radius.w, surface = radius > 0.0 ? 1.0 - smoothstep(0.5 * radius, radius, length(at.xz)) : 0.0;
#ifdef SURFACE_ALONE
  if (surface == 0.0) discard;
#endif
#ifdef HAS_RADIANCE
  vec3 sky_seen = vec3(1.0);
  LightsSeen seen = kOpen;
#ifdef HAS_SKY
  sky_seen = textureLod(sky, uv, 0.0).rgb;
#endif
#ifdef HAS_SUN_SEEN
  seen.sun = textureLod(sun_seen, uv, 0.0).r;
#endif
#ifdef HAS_SPOTS_SEEN
  vec4 spots = textureLod(spots_seen, uv, 0.0);
  seen = LightsSeen(seen.sun, spots.x, spots.yzw);
#endif
#if SEES_MESHES
  LightsSeen past_meshes = lightsPastMeshes(at, vec3(0.0, 1.0, 0.0), sky_turn);
  seen = LightsSeen(min(seen.sun, past_meshes.sun), min(seen.spot, past_meshes.spot), min(seen.others, past_meshes.others));
#endif
#if defined HAS_MESH_SKY && defined HAS_SCENE_BOUNDS
  vec4 bounds = boundingSphere();
  sky_seen *= textureLod(mesh_sky, plainUv((at.xz - bounds.xz) / bounds.w), 0.0).r;
#endif
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
#ifdef HAS_IRRADIANCE
  mat4x3 from_spots = spotsFromAbove();
#else
  mat4x3 from_spots = mat4x3(0.0);
#endif
  vec3 arrives = from_sky * sky_seen + from_sun * seen.sun + from_spots * vec4(seen.spot, seen.others);
  float all = dot(from_sky + from_sun + from_spots * vec4(1.0), luminance), left = all > 0.0 ? dot(arrives, luminance) / all : 1.0;
  int tried = 0;
#ifdef HAS_LAMPS
  const Response white = Response(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(1.0), 1.0, 1.0, 0.0, 0.0);
  if (surface > 0.0)
    arrives += lampsRadiance(Point(at, vec3(0.0, 1.0, 0.0), normalize(from - at), vec3(0.0), 1.0, 1.0), white, tried);
#endif
  float kept = min(left, 1.0);  // of the environment behind
  vec3 reflected = albedo_radius.rgb * arrives;
#ifdef HAS_AIR
  float through = throughFog(at - from);
  kept = mix(1.0, kept, through);
  reflected = mix(fog_light.rgb, reflected, through);
#endif
#if SHOW_LAMPS
  reflected = colorOfLamps(tried);
#endif
  radiance = vec4(reflected * surface, 1.0 - (1.0 - surface) * kept);
#endif
#ifdef HAS_VELOCITY
  vec3 clip = before * vec4(at, 1.0);
  velocity = uv - (clip.xy / max(clip.z, 1e-3) * 0.5 + 0.5);
#endif
#ifdef HAS_DEPTH
  gl_FragDepth = near / t;
#endif
}
