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
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(source, 0) - 1;
  float m = luma(texelFetch(source, at, 0).rgb);
  float n = luma(texelFetch(source, ivec2(at.x, min(at.y + 1, last.y)), 0).rgb);
  float s = luma(texelFetch(source, ivec2(at.x, max(at.y - 1, 0)), 0).rgb);
  float e = luma(texelFetch(source, ivec2(min(at.x + 1, last.x), at.y), 0).rgb);
  float w = luma(texelFetch(source, ivec2(max(at.x - 1, 0), at.y), 0).rgb);
  float high = max(max(max(n, s), max(e, w)), m), low = min(min(min(n, s), min(e, w)), m);
  gl_FragDepth = high - low < max(edge_threshold_min, high * edge_threshold) ? 1.0 : 0.0;
}
