// The bins of the luminance histogram. Bin 0 holds what is black or below 2^kDarkest and does not count; bins 1 to 255 are the
// levels from 2^kDarkest to 2^16 in equal steps of log2. A texel counts kUnit: 2^26 of them fit.
#ifndef EXPOSURE_HISTOGRAM_GLSL
#define EXPOSURE_HISTOGRAM_GLSL

const uint kBins = 256u, kUnit = 64u;
const float kDarkest = -15.75, kBinsPerStop = 8.0;

// Of a luminance from 2^kDarkest to 65504: 1..255, with the place between two bins as its fraction.
float binOf(float luminance) { return clamp((log2(luminance) - kDarkest) * kBinsPerStop + 1.0, 1.0, 255.0); }
float logLuminanceOf(float bin) { return (bin - 1.0) / kBinsPerStop + kDarkest; }

#endif
