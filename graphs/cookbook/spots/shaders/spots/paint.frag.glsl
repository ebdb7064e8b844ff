// Paints the pattern on the G-buffer, from three sides by the normal. Blended by alpha.
// read    pattern              g: how much paint
//         depth, normal        of the G-buffer
// modify  base                 albedo
//         metallic_roughness   see deferred/gbuffer.glsl
#include "deferred/gbuffer.glsl"

uniform sampler2D pattern, depth, normal;
layout(std140) uniform Parameters { float scale; vec3 paint; };
in vec2 uv;
out vec4 base;
out vec4 metallic_roughness;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float z = texelFetch(depth, at, 0).r;
  if (z <= 0.0) discard;
  vec3 p = positionOfDepth(uv, z) * scale, n = decodeNormal(texelFetch(normal, at, 0).rg);
  vec3 weight = pow(abs(n), vec3(4.0));
  weight /= weight.x + weight.y + weight.z;

  vec3 amount = vec3(textureLod(pattern, p.zy, 0.0).g, textureLod(pattern, p.xz, 0.0).g, textureLod(pattern, p.xy, 0.0).g);
  float covered = smoothstep(0.15, 0.25, dot(weight, amount));
  base = vec4(paint, covered);
  metallic_roughness = vec4(0.0, 0.25, 1.0, covered);
}
