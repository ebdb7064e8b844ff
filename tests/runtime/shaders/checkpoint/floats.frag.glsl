// read    bytes, encoded, words, halves, eleven, tens, pairs, floats   what these held
// write   new_bytes … new_floats   other numbers made of it; NaNs with the frame in them in a column of the last
#include "common/view.glsl"
uniform sampler2D bytes, encoded, words, halves, eleven, tens, pairs, floats;
out vec4 new_bytes, new_encoded, new_words, new_halves, new_eleven, new_tens, new_pairs, new_floats;

vec4 following(sampler2D source) {
  vec4 was = texelFetch(source, ivec2(gl_FragCoord.xy), 0);
  return fract(was * 1.7 + vec4(0.13, 0.29, 0.41, 0.57) + 0.03 * gl_FragCoord.x + 0.07 * gl_FragCoord.y);
}

void main() {
  new_bytes = following(bytes);
  new_encoded = following(encoded);
  new_words = following(words);
  new_halves = following(halves);
  new_eleven = following(eleven);
  new_tens = following(tens);
  new_pairs = following(pairs);
  new_floats = gl_FragCoord.x < 1.0 ? uintBitsToFloat(uvec4(0x7fc01230u, 0xffc04560u, 0x80000000u, 0x7f800000u) + uint(frame) * uvec4(1, 1, 0, 0))
                                    : following(floats);
}
