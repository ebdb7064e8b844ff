// The bins of the luminance histogram. Bin 0 has the texels that are black or below 2^kDarkest, which do not count; bins 1 to BINS - 1
// are the levels from 2^kDarkest to 2^16 in equal steps of log2. A texel counts kUnit, so that 2^26 texels fit.
#ifndef EXPOSURE_HISTOGRAM_GLSL
#define EXPOSURE_HISTOGRAM_GLSL

const uint kBins = uint(BINS), kUnit = 64u;
const float kBinsPerStop = 8.0, kDarkest = 16.0 - float(BINS - 2) / kBinsPerStop;

// The bin of a luminance from 2^kDarkest to 65504: 1 to BINS - 1. Its fraction is the place between two bins.
float binOf(float luminance) { return clamp((log2(luminance) - kDarkest) * kBinsPerStop + 1.0, 1.0, float(BINS - 1)); }
float logLuminanceOf(float bin) { return (bin - 1.0) / kBinsPerStop + kDarkest; }

#endif
