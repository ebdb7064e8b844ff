// A map of the whole ground: fine near the bounding sphere of the scene, coarse far away.
#ifndef GROUND_PLAIN_GLSL
#define GROUND_PLAIN_GLSL

// From the center of the sphere, in its radii, to texture coordinates and back.
vec2 plainUv(vec2 at) { return 0.5 + 0.5 * at / (1.0 + abs(at)); }
vec2 plainAt(vec2 uv) {
  vec2 side = uv * 2.0 - 1.0;
  return side / max(1.0 - abs(side), 1e-3);
}

#endif
