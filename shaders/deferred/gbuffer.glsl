// The layout of the G-buffer. Passes that draw surfaces encode with this file, and passes that read them decode.
//   normal              rg16             world normal, octahedral (common/octahedral.glsl); 0, 0 is no surface
//   base                srgb8_a8         albedo, linear in the shader; F0 of a metal
//   metallic_roughness  rgba8            r: metallic; g: perceptual roughness; b: occlusion of the material; a: 0 for Cook-Torrance,
//                                        else Blinn-Phong with the exponent exp2(10 a)
//   emissive            r11f_g11f_b10f   radiance, scene-referred
//   velocity            rg16f            screen UV per frame
//   depth               depth32f         reversed-Z; 0 is sky. Positions are computed from it
#ifndef DEFERRED_GBUFFER_GLSL
#define DEFERRED_GBUFFER_GLSL

#include "common/octahedral.glsl"
#include "common/view.glsl"

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
