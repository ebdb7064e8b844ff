// The one mapping between a material's perceptual roughness and the levels of the prefiltered specular map, used by the
// prefilter and by every lookup. Level 0 is roughness 0.1, the last one roughness 1, and from one to the next roughness grows by the
// same factor, as texels do, so that a lobe is always a few texels wide. Smoother surfaces than level 0 read the environment itself.
// The microfacet width is alpha = roughness^2.
#ifndef IBL_ROUGHNESS_LEVEL_GLSL
#define IBL_ROUGHNESS_LEVEL_GLSL

const float kSharpest = 0.1;              // roughness of level 0
const float kOctaves = -log2(kSharpest);  // of roughness, from the first level to the last

float alphaOfRoughness(float roughness) { return roughness * roughness; }
// define LEAST_ALPHA: the least width of a lamp's lobe; by default mirrors reflect lamps as if they were of roughness 0.045. Suns and spots,
// which have a width of their own, may have lobes of a quarter and a half of it.
#ifndef LEAST_ALPHA
#define LEAST_ALPHA 0.002
#endif
float alphaUnderLamps(float roughness) { return max(alphaOfRoughness(roughness), LEAST_ALPHA); }

// The level of a lobe as a share of all levels: 0 the first, 1 the last; below 0 it is sharper than any.
float placeOfAlpha(float alpha) { return 1.0 + log2(max(alpha, 1e-6)) * (0.5 / kOctaves); }

float levelOfAlpha(float alpha, int levels) { return placeOfAlpha(alpha) * float(levels - 1); }
float roughnessOfLevel(float level, int levels) { return exp2(kOctaves * (level / float(max(levels - 1, 1)) - 1.0)); }

#endif
