// Perceived brightness of encoded values (Rec. 601 weights, as FXAA uses them).
#ifndef FXAA_LUMA_GLSL
#define FXAA_LUMA_GLSL

float luma(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }

#endif
