// The mean of what 4 x 4 pixels of a surface reflect, in a window 5 wide with halved borders. Mirrors keep their own.
// read    source                              of reflections/rays.frag.glsl
//         normal, metallic_roughness, depth   see deferred/gbuffer.glsl
// write   mirrored                            as source
#include "deferred/gbuffer.glsl"
#include "reflections/spread.glsl"

uniform sampler2D source, normal, metallic_roughness, depth;
in vec2 uv;
out vec4 mirrored;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(depth, 0) - 1;
  mirrored = texelFetch(source, pixel, 0);
  vec2 turned = texelFetch(normal, pixel, 0).rg;
  float roughness = texelFetch(metallic_roughness, pixel, 0).g, spread = raySpread(roughness);
  if (turned == vec2(0.0) || spread == 0.0) return;
  vec3 n = decodeNormal(turned), place = positionOfDepth(uv, texelFetch(depth, pixel, 0).r);
  float wide = 4.0 * (view_projection * vec4(place, 1.0)).w * pixelAngle();  // of a pixel, times four
  float alpha = roughness * roughness;
  vec4 sum = vec4(0.0);
  float whole = 0.0;
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      ivec2 there = clamp(pixel + ivec2(x, y), ivec2(0), last);
      vec2 other = texelFetch(normal, there, 0).rg;
      float z = texelFetch(depth, there, 0).r;
      if (other == vec2(0.0) || z <= 0.0) continue;
      vec3 turn = decodeNormal(other) - n;
      float off = dot(positionOfDepth((vec2(there) + 0.5) / viewport, z) - place, n) / wide;
      float rougher = (texelFetch(metallic_roughness, there, 0).g - roughness) / roughness;
      float weight = (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0);
      weight *= exp2(-off * off - dot(turn, turn) / (alpha * alpha) - 16.0 * rougher * rougher);
      sum += weight * texelFetch(source, there, 0);
      whole += weight;
    }
  mirrored = mix(mirrored, sum / whole, spread);
}
