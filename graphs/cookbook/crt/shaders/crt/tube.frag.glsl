// A cathode ray tube: curved glass, a beam whose spot grows with its current, stripes of phosphor.
// read    small      the lines, linear
// write   result     encoded picture
#include "common/srgb.glsl"

uniform sampler2D small;
layout(std140) uniform Parameters { float curvature; float mask; };
in vec2 uv;
out vec4 result;

// Light of the beam at `distance` lines from its center; all of it together is that of the line.
vec3 beam(vec3 color, float distance) {
  vec3 width = mix(vec3(0.22), vec3(0.4), sqrt(color));  // standard deviation, in lines
  return color * exp(-0.5 * distance * distance / (width * width)) / (width * 2.5066);
}

// The line filtered along itself, as the amplifier does: a Gaussian of half a pixel.
vec3 lineAt(float x, int y) {
  ivec2 size = textureSize(small, 0);
  vec4 sum = vec4(0.0);
  for (int i = int(floor(x)) - 2; i <= int(floor(x)) + 2; ++i) {
    float d = float(i) + 0.5 - x;
    sum += exp(-2.0 * d * d) * vec4(texelFetch(small, ivec2(clamp(i, 0, size.x - 1), y), 0).rgb, 1.0);
  }
  return sum.rgb / sum.w;
}

void main() {
  vec2 p = 2.0 * uv - 1.0;
  p *= 1.0 + curvature * p.yx * p.yx;
  vec2 size = vec2(textureSize(small, 0)), at = (0.5 * p + 0.5) * size;
  vec3 light = vec3(0.0);
  for (int y = int(floor(at.y)) - 1; y <= int(floor(at.y)) + 1; ++y)
    if (y >= 0 && y < int(size.y)) light += beam(lineAt(at.x, y), float(y) + 0.5 - at.y);
  // Stripes of three pixels; their mean is 1.
  vec3 stripe = 3.0 * vec3(equal(ivec3(int(gl_FragCoord.x) % 3), ivec3(0, 1, 2)));
  light *= mix(vec3(1.0), stripe, mask);
  // The edge of the glass, one pixel wide.
  vec2 inside = clamp((1.0 - abs(p)) / fwidth(p), 0.0, 1.0);
  result = vec4(encodeSrgb(clamp(light * inside.x * inside.y, 0.0, 1.0)), 1.0);
}
