// Puddles on what faces up: smooth. Blended by alpha.
// read    depth, normal        of the G-buffer
// modify  metallic_roughness   its roughness
#include "deferred/gbuffer.glsl"

uniform sampler2D depth, normal;
layout(std140) uniform Parameters { float wet; };
in vec2 uv;
out vec4 metallic_roughness;

float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
float noise(vec2 p) {
  vec2 i = floor(p), f = fract(p), s = f * f * (3.0 - 2.0 * f);
  return mix(mix(hash(i), hash(i + vec2(1, 0)), s.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), s.x), s.y);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float z = texelFetch(depth, at, 0).r;
  if (z <= 0.0) discard;
  vec2 p = positionOfDepth(uv, z).xz;
  float height = 0.7 * noise(4.0 * p + 3.0) + 0.3 * noise(11.0 * p);
  float up = smoothstep(0.97, 0.99, decodeNormal(texelFetch(normal, at, 0).rg).y);
  metallic_roughness = vec4(0.0, 0.04, 0.0, up * smoothstep(0.1, -0.1, height - 1.2 * wet + 0.1));
}
