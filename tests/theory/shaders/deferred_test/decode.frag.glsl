// What deferred/gbuffer.glsl makes of a G-buffer.
// read    normal, base, metallic_roughness, depth
// write   place    world position; alpha: the exponent
//         facing   world normal
//         color    base
#include "deferred/gbuffer.glsl"

uniform sampler2D normal, base, metallic_roughness, depth;
in vec2 uv;
out vec4 place;
out vec4 facing;
out vec4 color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float z = texelFetch(depth, at, 0).r;
  facing = z > 0.0 ? vec4(decodeNormal(texelFetch(normal, at, 0).rg), 1.0) : vec4(0.0);
  place = z > 0.0 ? vec4(positionOfDepth(uv, z), decodeExponent(texelFetch(metallic_roughness, at, 0).a)) : vec4(0.0);
  color = texelFetch(base, at, 0);
}
