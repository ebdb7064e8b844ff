// What a surface reflects of the scene, see reflectedPicture() in reflections/lobe.glsl.
// read    mirrored     found for each pixel before; or, instead, the slots of reflections/lobe.glsl

// Over the 2 x 2 pixels of a quad.
vec4 sumOfQuad(vec4 own) {
  vec2 side = 1.0 - 2.0 * vec2(ivec2(gl_FragCoord.xy) & 1);
  own += own + side.x * dFdxFine(own);
  return own + own + side.y * dFdyFine(own);
}

#ifdef HAS_MIRRORED
uniform sampler2D mirrored;
vec4 seenOfScene(Point point, Response response) { return texelFetch(mirrored, ivec2(gl_FragCoord.xy), 0); }
#else
#include "reflections/lobe.glsl"

// 2 x 2 pixels share the rays of a lobe: the 5 of one would show as ghosts.
vec4 seenOfScene(Point point, Response response) {
  ivec2 odd = ivec2(gl_FragCoord.xy) & 1;
  // Pixels beside the triangle help; they may not have been able to read its material.
  vec4 shape = sumOfQuad(gl_HelperInvocation ? vec4(0.0) : vec4(response.roughness, response.lean, 0.0, 1.0));
  if (gl_HelperInvocation) {
    response.roughness = shape.x / shape.w;
    response.lean = shape.y / shape.w;
  }
  bool alone = false;
#ifdef HAS_MATERIAL_LAYERS
  alone = !layers.on && layers.coat > 0.0;  // the coat: not all pixels may have one
#endif
  float reach;
  vec4 own = reflectedPicture(point, response, alone ? 0 : odd.x + 2 * odd.y, alone ? 1 : 4, alone ? 8 : 5, reach);
  if (alone) return own;
  return mix(own, 0.25 * sumOfQuad(own), sharedOf(raySpread(response.roughness)));
}
#endif
