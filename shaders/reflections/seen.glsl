// What a surface reflects of the scene, see reflectedPicture() in reflections/lobe.glsl.
// read    mirrored     found for each pixel before; or, instead, the slots of reflections/lobe.glsl
#ifdef HAS_MIRRORED
uniform sampler2D mirrored;
vec4 seenOfScene(Point point, Response response) { return texelFetch(mirrored, ivec2(gl_FragCoord.xy), 0); }
#else
#include "reflections/lobe.glsl"
vec4 seenOfScene(Point point, Response response) {
  float reach;
  return reflectedPicture(point, response, 0, 1, 8, reach);
}
#endif
