// The search radius of a pixel, and how its blur is divided between two passes: the samples over a disc (bokeh), and the mean of nine
// places around each pixel that closes the gaps (fill; Jimenez, "Next generation post processing in Call of Duty", SIGGRAPH
// 2014). The variance of a disc is radius^2 / 4 per axis; fill and linear sampling add their part of it.
// defines EACH_TEXEL  radius up to which each texel is a sample: rings would have no gaps to fill
//         FINE_GAP    up to this gap, filtering and the fill close it; larger ones take coarser texels and four sets of samples, see
//                     rings.glsl
//         FIRST_RING  samples in the first ring around the center
#ifndef DOF_DISC_GLSL
#define DOF_DISC_GLSL

#include "coc.glsl"

// Radius in texels of the fields to search around `pixel`; up to kLeastRadius there is nothing to do.
#if NEAR
#ifdef HAS_TILES
uniform sampler2D tiles;
float searchRadius(ivec2 pixel) {
  vec4 corners = texelFetch(tiles, pixel / tile, 0);
  vec2 within = (vec2(pixel % tile) + 0.5) / float(tile), side = mix(corners.xz, corners.yw, within.x);
  return mix(side.x, side.y, within.y);
}
#else
float searchRadius(ivec2 pixel) {
  return float(tile);
}
#endif
// Radius of the pixel's own disc; 0: it is not in the near field.
float ownDisc(ivec2 pixel) {
  return texelFetch(discs, pixel, 0).r / max(texelFetch(source, pixel, 0).a, 0.25);
}
#else
// In the far field, the radius of the pixel's own disc, or of the nearer surface that hides the layer. `own_discs`: what split wrote there.
float searchRadius(float own_share, vec2 own_discs) {
  return own_share > 0.0 ? own_discs.g / own_share : own_discs.r;
}
#endif

// The rings from the middle to `ring` hold this many samples if each stands for one; small discs take fewer rings.
float samplesTo(int ring) {
  return 1.0 + 0.5 * float(FIRST_RING * ring * (ring + 1));
}
int ringsFor(float radius, int rings) {
  return clamp(int(ceil(0.7 * radius - 0.2)), 0, rings);
}

// About the distance between samples in a disc: the root of the area of each, over the root of pi.
float gapOf(float radius, int rings) {
  return radius * inversesqrt(samplesTo(ringsFor(radius, rings)));
}

// From this gap on the texels read are four texels of the fields wide instead of two.
const float kCoarseGap = 4.0;

// Variance per axis that the fill adds, in texels squared: none while the samples are so close that filtering joins them; with four sets at
// least what weighs all sets equally, and enough to hide their gaps.
float fillVariance(float radius, float gap) {
  float closing = 0.16 * gap * gap - (gap > kCoarseGap ? 2.0 : 0.0);
  return gap > FINE_GAP ? clamp(closing, 0.5, 1.8)
                        : clamp(min(1.6 * gap - 0.98, 0.5 * (radius - EACH_TEXEL)), 0.0, 0.6 * gap);
}

// The fill averages lookups this many texels apart, and weighs the neighbors along an axis by this against 1 for the center: so texels of
// even and of odd distance have equal weight from a variance of a half on, where a lookup between two texels counts for both.
float fillStride(float variance) {
  return max((4.0 * variance + 2.0) / (2.0 * variance + 3.0), 1.0);
}
float fillWeight(float variance) {
  return variance < 0.5 ? variance / (2.0 - 2.0 * variance) : 0.5 / (3.0 - 2.0 * fillStride(variance));
}

#endif
