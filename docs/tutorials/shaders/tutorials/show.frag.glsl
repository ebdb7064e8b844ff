// read   sharp, soft  the picture, and its levels of half the size and less
// read   counts       pixels by the number of their layers: bars at the bottom
uniform sampler2D sharp, soft;
layout(std430) readonly buffer counts { uint count[16]; };
in vec2 uv;
out vec4 result;

void main() {
  vec3 color = texelFetch(sharp, ivec2(gl_FragCoord.xy), 0).rgb + 0.3 * textureLod(soft, uv, 3.0).rgb;
  ivec2 size = textureSize(sharp, 0);
  float share = float(count[int(uv.x * 16.0)]) / float(size.x * size.y);
  result = vec4(uv.y < share ? vec3(1.0) : color, 1.0);
}
