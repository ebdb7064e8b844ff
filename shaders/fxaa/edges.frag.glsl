// Finds the edges of a display-referred picture, and copies it.
// read    source   encoded picture, the targets' size, not `as linear`
// write   jagged   the copy
//         edges    depth: 0 where the contrast to a neighbor is high, else 1
// params  edge_threshold       contrast, relative to the brightest neighbor, from which a pixel is an edge
//         edge_threshold_min   the same, absolute: there are no edges in the dark
#include "luma.glsl"

uniform sampler2D source;
layout(std140) uniform Parameters {
  float edge_threshold;
  float edge_threshold_min;
};
noperspective in vec2 uv;
out vec4 jagged;

void main() {
  // Of its four neighbors a pixel shares its 2x2 quad with two: a fine derivative is the difference to those, exactly.
  vec2 size = vec2(textureSize(source, 0));
  vec2 side = mix(vec2(-1.0), vec2(1.0), greaterThan(fract(0.5 * uv * size), vec2(0.5))), beside = uv + side / size;
  jagged = textureLod(source, uv, 0.0);
  float m = luma(jagged.rgb);
  float e = luma(textureLod(source, vec2(beside.x, uv.y), 0.0).rgb);
  float n = luma(textureLod(source, vec2(uv.x, beside.y), 0.0).rgb);
  float w = m - side.x * dFdxFine(m), s = m - side.y * dFdyFine(m);
  float high = max(max(max(n, s), max(e, w)), m), low = min(min(min(n, s), min(e, w)), m);
  gl_FragDepth = high - low < max(edge_threshold_min, high * edge_threshold) ? 1.0 : 0.0;
}
