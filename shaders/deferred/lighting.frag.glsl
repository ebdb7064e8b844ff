// The light that leaves each surface of the G-buffer towards the eye.
// read    normal, base, mro, depth   see gbuffer.glsl
//         emissive?     radiance that is added
//         position?     world, instead of the one that depth gives
//         ao?           ambient visibility; the material's occlusion counts where it is darker
//         and what light comes from: shading/light.glsl
// modify  radiance      scene-referred, alpha 1; nothing where depth is 0
// params, defines       see shading/light.glsl and light.glsl
//         SHOW_LAMPS    instead of light, how many lamps each pixel goes through: blue 1, green 8, red 64 and more
#include "gbuffer.glsl"
#include "light.glsl"

#ifndef SHOW_LAMPS
#define SHOW_LAMPS 0
#endif
#if SHOW_LAMPS
#include "shading/show_lamps.glsl"
#endif

uniform sampler2D normal, base, mro, depth;
#ifdef HAS_EMISSIVE
uniform sampler2D emissive;
#endif
#ifdef HAS_POSITION
uniform sampler2D position;
#endif
#ifdef HAS_AO
uniform sampler2D ao;
#endif
in vec2 uv;
#ifdef HAS_RADIANCE
out vec4 radiance;
#endif

vec3 emitted = vec3(0.0);

void findPoint(out Point point) {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float z = texelFetch(depth, pixel, 0).r;
  if (z <= 0.0) discard;
#ifdef HAS_POSITION
  point.at = texelFetch(position, pixel, 0).xyz;
#else
  point.at = positionOfDepth(uv, z);
#endif
  vec4 stored = texelFetch(mro, pixel, 0);
  point.n = decodeNormal(texelFetch(normal, pixel, 0).rg);
  point.surface = Surface(texelFetch(base, pixel, 0).rgb, stored.r, stored.g);
  finishPoint(point, stored.a > 0.0 ? decodeExponent(stored.a) : 0.0);
  seen = stored.b;
#ifdef HAS_AO
  seen = min(seen, texelFetch(ao, pixel, 0).r);
#endif
  emitted = vec3(0.0);
#ifdef HAS_EMISSIVE
  emitted = texelFetch(emissive, pixel, 0).rgb;
#endif
}

void putLight(Point point, vec3 from_around, vec3 from_lights, int lamps_tried) {
  vec3 light = from_around + emitted + from_lights;
#if SHOW_LAMPS
  light = colorOfLamps(lamps_tried);
#endif
#ifdef HAS_RADIANCE
  radiance = vec4(light, 1.0);
#endif
}
