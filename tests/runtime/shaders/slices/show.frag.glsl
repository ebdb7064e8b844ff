// All that the group makes, side by side, as a pass of every frame sees it.
layout(std140) uniform Parameters { float fade; };
uniform sampler2D field;
uniform sampler2D before;
uniform sampler2D mapped;
uniform sampler2D after;
layout(std430) readonly buffer total { vec4 sum; };
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  result = vec4(texelFetch(field, at, 0).x, texelFetch(mapped, at, 0).x, sum.x, texelFetch(after, ivec2(0), 0).x);
  if (at == ivec2(0)) result = vec4(fade, texelFetch(before, at, 0).x, texelFetch(mapped, at, 0).yz);
}
