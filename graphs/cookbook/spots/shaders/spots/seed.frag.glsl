// The first substance everywhere, and drops of the second.
// write   substances   r: the first, g: the second
out vec2 substances;

float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }

void main() {
  vec2 cell = floor(gl_FragCoord.xy / 24.0);
  vec2 center = 24.0 * (cell + 0.25 + 0.5 * vec2(hash(cell), hash(cell + 7.0)));
  float inside = hash(cell + 3.0) < 0.6 && distance(gl_FragCoord.xy, center) < 4.0 ? 1.0 : 0.0;
  substances = mix(vec2(1.0, 0.0), vec2(0.5, 0.25), inside);
}
