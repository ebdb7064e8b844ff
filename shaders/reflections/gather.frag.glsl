// Brings together what the pixels of a surface reflect: first the rays of 4 x 4 of them, in a window 5 wide with halved borders, then, with
// wider steps, as far as the reflection is blurred there. Mirrors keep their own. A-trous: Dammertz et al., "Edge-avoiding a-trous wavelet
// transform for fast global illumination filtering", HPG 2010.
// read    source, reaches                     of reflections/rays.frag.glsl, or of the step before
//         normal, metallic_roughness, depth   see deferred/gbuffer.glsl
// write   mirrored, reach                     as these
// params  stride   pixels between two samples
#include "deferred/gbuffer.glsl"
#include "reflections/spread.glsl"

uniform sampler2D source, reaches, normal, metallic_roughness, depth;
layout(std140) uniform Parameters { int stride; };
in vec2 uv;
out vec4 mirrored;
out float reach;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(depth, 0) - 1;
  mirrored = texelFetch(source, pixel, 0);
  reach = texelFetch(reaches, pixel, 0).r;
  vec2 turned = texelFetch(normal, pixel, 0).rg;
  float roughness = texelFetch(metallic_roughness, pixel, 0).g, gathered = sharedOf(raySpread(roughness));
  if (turned == vec2(0.0) || gathered == 0.0) return;
  vec3 n = decodeNormal(turned), place = positionOfDepth(uv, texelFetch(depth, pixel, 0).r);
  float width = (view_projection * vec4(place, 1.0)).w * pixelAngle(), alpha = roughness * roughness;
  vec4 sum = vec4(0.0);
  float whole = 0.0, far = 0.0;
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      ivec2 there = clamp(pixel + stride * ivec2(x, y), ivec2(0), last);
      vec2 other = texelFetch(normal, there, 0).rg;
      float z = texelFetch(depth, there, 0).r;
      if (other == vec2(0.0) || z <= 0.0) continue;
      vec3 turn = decodeNormal(other) - n, way = positionOfDepth((vec2(there) + 0.5) / viewport, z) - place;
      float off = dot(way, n) / (4.0 * width);
      float rougher = (texelFetch(metallic_roughness, there, 0).g - roughness) / roughness;
      float weight = stride == 1 ? (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0) : 1.0;
      weight *= exp2(-off * off - (stride == 1 ? 1.0 : 8.0) * dot(turn, turn) / (alpha * alpha) - 16.0 * rougher * rougher);
      vec4 light = texelFetch(source, there, 0);
      float away = texelFetch(reaches, there, 0).r;
      if (stride > 1) {
        // As wide as a part of the lobe is there.
        float wide = 0.35 * alpha * away / max(light.a, 1e-3), beside = length(way) / max(wide, 1e-6);
        weight *= (x | y) == 0 ? 1.0 : exp2(-beside * beside);
      }
      sum += weight * light;
      far += weight * away;
      whole += weight;
    }
  mirrored = mix(mirrored, sum / whole, gathered);
  reach = mix(reach, far / whole, gathered);
}
