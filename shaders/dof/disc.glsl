// How far a pixel's layer is searched, and how its blur is divided between two passes: the samples over a disc (bokeh), and the mean
// of nine places around each pixel that closes the gaps (fill; Jimenez, "Next generation post processing in Call of Duty", SIGGRAPH
// 2014). The variance of a disc is radius^2 / 4 per axis; fill and linear sampling add their part of it.
#ifndef DOF_DISC_GLSL
#define DOF_DISC_GLSL

#include "coc.glsl"

// Radius in pixels of the half size to search around `pixel`; below 0.25 there is nothing to do.
#if NEAR
#ifdef HAS_TILES
uniform sampler2D tiles;
float searchRadius(ivec2 pixel) {
  vec4 corners = texelFetch(tiles, pixel / tile, 0);
  vec2 within = (vec2(pixel % tile) + 0.5) / float(tile), side = mix(corners.xz, corners.yw, within.x);
  return mix(side.x, side.y, within.y);
}
#else
float searchRadius(ivec2 pixel) { return float(tile); }
#endif
#else
// In the far field it is the radius of the pixel's own disc, or, where something nearer hides the layer, of that thing's disc.
float searchRadius(float own_alpha, ivec2 pixel, sampler2D discs, int largest) {
  return own_alpha > 0.0 ? farRadius(own_alpha, largest) : texelFetch(discs, pixel, 0).r;
}
#endif

// The rings from the middle to `ring` hold this many samples if each stands for one; small discs take fewer rings.
float samplesTo(int ring) { return 1.0 + 2.5 * float(ring * (ring + 1)); }
int ringsFor(float radius, int rings) { return clamp(int(ceil(0.7 * radius - 0.2)), 0, rings); }
float samplesFor(float radius, int rings) { return samplesTo(ringsFor(radius, rings)); }

// Variance per axis that the fill adds, in texels squared: none while the samples lie so close that filtering joins them, up to a radius
// of FILL_START / FILL_SLOPE. The graph defines both, because it leaves the fill out where no disc is larger.
float fillVariance(float radius) { return clamp(FILL_SLOPE * radius - FILL_START, 0.0, 2.0 / 3.0); }

// How far apart, in texels, the nine lookups of the fill lie, for a gap between samples of the near field: wide enough that highlights of a
// few texels are no dots, and no wider, as it softens discs. (In the far field they lie a texel apart.)
float fillStride(float gap) { return max(0.6 * gap, 1.0); }

// Weight of the neighbours along an axis in the fill, 0..1.
float fillWeight(float radius) {
  float variance = fillVariance(radius);
  return variance / (2.0 - 2.0 * variance);
}

#endif
