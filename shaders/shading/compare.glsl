// What a lookup of a shadow map says. Samplers `as compare` compare as the pass's depth test does: less or less-or-equal, which is the
// default, gives 1 in the shadow; a pass that draws with "depth_test": "greater" defines LIT_IS_GREATER, because there 1 is lit.
#ifndef SHADING_COMPARE_GLSL
#define SHADING_COMPARE_GLSL

#ifndef LIT_IS_GREATER
#define LIT_IS_GREATER 0
#endif

float hiddenBy(float compared) { return LIT_IS_GREATER == 1 ? 1.0 - compared : compared; }

#endif
