// The screen of a Game Boy, as large as it fits: four greens, with the gaps between its pixels.
// read    lcd      shades, 0..1
// write   result   encoded picture
uniform sampler2D lcd;
in vec2 uv;
out vec4 result;

const vec3 kGreens[4] = vec3[](vec3(15.0, 56.0, 15.0), vec3(48.0, 98.0, 48.0), vec3(139.0, 172.0, 15.0), vec3(155.0, 188.0, 15.0));

void main() {
  vec2 size = vec2(textureSize(lcd, 0)), target = 1.0 / vec2(dFdx(uv.x), dFdy(uv.y));
  float scale = min(target.x / size.x, target.y / size.y);
  vec2 at = (gl_FragCoord.xy - 0.5 * target) / scale + 0.5 * size;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, size))) {
    result = vec4(0.6, 0.6, 0.58, 1.0);
    return;
  }
  float shade = 3.0 * texelFetch(lcd, ivec2(at), 0).r;
  int low = clamp(int(shade), 0, 2);
  vec3 green = mix(kGreens[low], kGreens[low + 1], shade - float(low)) / 255.0;
  vec2 from = abs(fract(at) - 0.5) * scale;
  float gap = scale < 3.0 ? 0.0 : clamp(max(from.x, from.y) - 0.5 * scale + 1.0, 0.0, 1.0);
  result = vec4(mix(green, kGreens[3] / 255.0, 0.5 * gap), 1.0);
}
