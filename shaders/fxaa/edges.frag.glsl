// Where a display-referred picture has edges.
// read    source   encoded picture; any sampler (texels are fetched)
// write   edges    depth: 0 where the contrast to a neighbour is high, else 1
// params  edge_threshold       contrast, relative to the brightest neighbour, from which on a pixel is an edge
//         edge_threshold_min   the same, absolute: there are no edges in the dark
#include "luma.glsl"

uniform sampler2D source;
layout(std140) uniform Parameters {
  float edge_threshold;
  float edge_threshold_min;
};

void main() {
  ivec2 last = textureSize(source, 0) - 1, at = min(ivec2(gl_FragCoord.xy), last);  // helpers beside the picture read its border
  // Of its four neighbours a pixel shares its 2x2 quad with two: a fine derivative is the difference to those, exactly.
  float m = luma(texelFetch(source, at, 0).rgb);
  ivec2 side = (ivec2(gl_FragCoord.xy) & 1) * 2 - 1;
  float e = luma(texelFetch(source, ivec2(clamp(at.x + side.x, 0, last.x), at.y), 0).rgb);
  float n = luma(texelFetch(source, ivec2(at.x, clamp(at.y + side.y, 0, last.y)), 0).rgb);
  float w = m - float(side.x) * dFdxFine(m), s = m - float(side.y) * dFdyFine(m);
  float high = max(max(max(n, s), max(e, w)), m), low = min(min(min(n, s), min(e, w)), m);
  gl_FragDepth = high - low < max(edge_threshold_min, high * edge_threshold) ? 1.0 : 0.0;
}
