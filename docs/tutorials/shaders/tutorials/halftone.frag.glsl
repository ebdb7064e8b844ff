uniform sampler2D source;
layout(std140) uniform Parameters { float dot_size; };
out vec4 result;

void main() {
  mat2 turn = mat2(0.8, 0.6, -0.6, 0.8);
  vec2 grid = turn * gl_FragCoord.xy / dot_size, center = (floor(grid) + 0.5) * dot_size * turn;
  vec3 ink = 1.0 - texelFetch(source, clamp(ivec2(center), ivec2(0), textureSize(source, 0) - 1), 0).rgb;
  result = vec4(smoothstep(-0.1, 0.1, length(fract(grid) - 0.5) - 0.6 * sqrt(ink)), 1.0);
}
