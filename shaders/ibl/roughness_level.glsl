// The one mapping between a material's perceptual roughness and the levels of the prefiltered specular map, used by the
// prefilter and by every lookup: level = roughness * (levels - 1), linear. The microfacet width is alpha = roughness^2.
#ifndef IBL_ROUGHNESS_LEVEL_GLSL
#define IBL_ROUGHNESS_LEVEL_GLSL

float levelOfRoughness(float roughness, int levels) { return roughness * float(levels - 1); }
float roughnessOfLevel(float level, int levels) { return level / float(levels - 1); }
float alphaOfRoughness(float roughness) { return roughness * roughness; }

#endif
