// The layout of the G-buffer. Passes that draw surfaces encode with this file, and passes that read them decode.
//   normal              rg16             world normal, octahedral (Cigolle et al., "A survey of efficient representations for independent
//                                        unit vectors", JCGT 3(2), 2014), scaled so that the six axes are exact; 0, 0 is no surface
//   base                srgb8_a8         albedo, linear in the shader; F0 of a metal
//   metallic_roughness  rgba8            r: metallic; g: perceptual roughness; b: occlusion of the material; a: 0 for Cook-Torrance,
//                                        else Blinn-Phong with the exponent exp2(10 a)
//   emissive            r11f_g11f_b10f   radiance, scene-referred
//   velocity            rg16f            screen UV per frame
//   depth               depth32f         reversed-Z; 0 is sky. Positions are computed from it
#ifndef DEFERRED_GBUFFER_GLSL
#define DEFERRED_GBUFFER_GLSL

#include "common/view.glsl"

vec2 encodeNormal(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  if (n.z < 0.0) p = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
  p = round(p * 32767.0);
  if (p == vec2(-32767.0)) p = -p;  // the corners are one normal
  return (p + 32767.0) / 65535.0;
}

vec3 decodeNormal(vec2 stored) {
  vec2 p = stored * (65535.0 / 32767.0) - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float below = max(-n.z, 0.0);
  n.xy += mix(vec2(below), vec2(-below), greaterThanEqual(n.xy, vec2(0.0)));
  return normalize(n);
}

// Exponents from 1.03 to 1024.
float encodeExponent(float exponent) { return clamp(log2(max(exponent, 1.0)) / 10.0, 1.0 / 255.0, 1.0); }
float decodeExponent(float stored) { return exp2(10.0 * stored); }

// Distance along the view axis of a perspective view.
float distanceOfDepth(float depth) { return near_plane / max(depth, 1e-30); }

// World position of the surface at a point of the target (0..1 from its lower left corner). `depth` is not 0.
vec3 positionOfDepth(vec2 target_uv, float depth) {
  if (projection[3].w == 0.0) return eye + viewRay(target_uv) * distanceOfDepth(depth);
  vec4 world = inverse_view_projection * vec4(target_uv * 2.0 - 1.0, depth, 1.0);  // orthographic
  return world.xyz / world.w;
}

#endif
