// What a mesh lets through of what is behind it: KHR_materials_transmission and KHR_materials_volume. One bent ray to where it leaves the
// volume, and the picture there; beside the picture, the environment. Nothing that transmits is seen through another.
// read    behind   of meshes/behind.frag.glsl, with levels that are means; `as linear`
#ifndef MESHES_BEHIND_GLSL
#define MESHES_BEHIND_GLSL

#include "common/view.glsl"
#include "fog/fog.glsl"
#include "shading/ambient.glsl"
#include "shading/layers.glsl"
#include "shading/lobe.glsl"

uniform sampler2D behind;

// Mean of texels `width` pixels wide.
vec3 blurredBehind(vec2 at, float width) {
  vec2 size = vec2(textureSize(behind, 0));
  width = clamp(width, 1.0, 0.25 * min(size.x, size.y));
  float level = log2(width);
  vec2 off = 0.5 * (width - 1.0) / size, turned = vec2(off.x, -off.y);
  return 0.25 * (textureLod(behind, at - off, level) + textureLod(behind, at + off, level) + textureLod(behind, at + turned, level) +
                 textureLod(behind, at - turned, level)).rgb;
}

// Without what the fog between eye and surface adds.
vec3 lightFromBehind(Point point, Response response) {
  float alpha = alphaOfRoughness(response.roughness);
  vec3 into = -point.to_eye;
  if (layers.thickness > 0.0) {
    into = refract(into, point.normal, 1.0 / layers.ior);
    // A reflected ray turns by twice the angle of its facet, one that goes through two rough sides by sqrt(2) (ior - 1) of it.
    alpha *= sqrt(0.5) * (layers.ior - 1.0);
  }
  vec3 leaves = point.position + into * layers.thickness;
  vec4 clip = view_projection * vec4(leaves, 1.0);
  vec2 at = clip.xy / clip.w * 0.5 + 0.5;
  // How far the picture is behind, seen as blurred as it would be if it was the sky; in parallel views, if it was 1 away.
  bool parallel = projection[3].w != 0.0;
  float spread = alpha / pixelAngle(), away = parallel ? dot(eye - leaves, point.to_eye) : distance(eye, leaves);
  float nearness = textureLod(behind, at, log2(max(4.0 * spread, 1.0))).a;
  spread *= clamp(1.0 - away * nearness, 0.0, 1.0) / (parallel ? max(nearness, 1e-3) : 1.0);
  // The slopes of GGX have a narrow middle and long tails: two Gaussians, of about 0.7 alpha and 2 alpha (fitted to its characteristic
  // function, x K1(x)). Rays turn by twice that, and four lookups of texels w pixels wide have a variance of about w^2 / 2.
  vec3 light = mix(blurredBehind(at, 1.8 * spread), blurredBehind(at, 5.7 * spread), 0.35);
#ifdef HAS_AIR
  float clear = throughFog(point.position - eye);
  light = max(light - fog_light.rgb * (1.0 - clear), 0.0);
#else
  const float clear = 1.0;
#endif
#ifdef HAS_SPECULAR
  vec2 edge = min(at, 1.0 - at);
  float inside = clamp(20.0 * min(edge.x, edge.y), 0.0, 1.0);
  point.mirror = into;
  response.level_shift = 0.0;  // it is that of a mirrored lobe
  if (inside < 1.0) light = mix(clear * reflectedEnvironment(point, response, lobeOf(sqrt(alpha), 0.0), into), light, inside);
#endif
  return light * exp(-layers.absorption * layers.thickness);
}

#endif
