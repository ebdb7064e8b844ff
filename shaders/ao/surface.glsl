// The G-buffer as ambient occlusion reads it. It works at half size in view space: texel p of its textures is pixel 2p.
// Slots: depth, normal; occluders?: depth of all occluders, where `depth` lacks some. All nearest.
#ifndef AO_SURFACE_GLSL
#define AO_SURFACE_GLSL

#include "deferred/gbuffer.glsl"

const float kPi = 3.14159265358979;

uniform sampler2D depth;
uniform sampler2D normal;
#ifdef HAS_OCCLUDERS
uniform sampler2D occluders;
#endif

float depthOfOccluder(ivec2 pixel) {
#ifdef HAS_OCCLUDERS
  return texelFetch(occluders, pixel, 0).r;
#else
  return texelFetch(depth, pixel, 0).r;
#endif
}

// View-space ray through a point of the target in pixels; times the distance along the axis it is the position.
vec3 axisRay(vec2 pixel) {
  vec2 wide = vec2(projection[0].x, projection[1].y);  // both quotients are the same for all pixels
  return vec3(pixel * (2.0 / (wide * vec2(textureSize(depth, 0)))) + (projection[2].xy - 1.0) / wide, -1.0);
}
vec3 placeAt(ivec2 pixel, float z) { return axisRay(vec2(pixel) + 0.5) * distanceOfDepth(z); }

// Pixels per unit of slope, along x and y.
vec2 focalPixels() { return 0.5 * vec2(projection[0].x, projection[1].y) * vec2(textureSize(depth, 0)); }

ivec2 pixelOf(ivec2 half_texel) { return min(half_texel * 2, textureSize(depth, 0) - 1); }

vec3 worldNormal(ivec2 pixel) { return decodeNormal(texelFetch(normal, pixel, 0).rg); }
vec3 facing(ivec2 pixel) { return mat3(view) * worldNormal(pixel); }

#endif
