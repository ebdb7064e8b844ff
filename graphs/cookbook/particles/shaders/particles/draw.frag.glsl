// A disc with a soft rim, brighter at the upper left. Blended premultiplied.
// modify  result   encoded picture
in vec4 color;
out vec4 result;

void main() {
  vec2 p = 2.0 * gl_PointCoord - 1.0;
  float inside = smoothstep(1.0, 0.6, length(p));
  result = color * inside;
  result.rgb *= 0.75 + 0.35 * dot(p, vec2(-0.6, -0.6));
}
