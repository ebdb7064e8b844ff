// read    clamped, wrapped, mirrored, bordered, smoothed, naturals, wholes   ramps of four texels
// write   nearest (as the first four), others (the last three)
//         at the middles of the texels -4 to 7, the smoothed one at their left ends
uniform sampler2D clamped, wrapped, mirrored, bordered, smoothed;
uniform usampler2D naturals;
uniform isampler2D wholes;
out vec4 nearest;
out vec4 others;

void main() {
  vec2 at = vec2((gl_FragCoord.x - 4.0) / 4.0, 0.5);
  nearest = vec4(texture(clamped, at).r, texture(wrapped, at).r, texture(mirrored, at).r, texture(bordered, at).r);
  others = vec4(texture(smoothed, at - vec2(0.125, 0.0)).r, float(texture(naturals, at).r), float(texture(wholes, at).r), 0.0);
}
