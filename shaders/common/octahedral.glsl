// Unit vectors in two channels from 0 to 1, octahedral (Cigolle et al., "A survey of efficient representations for independent unit vectors",
// JCGT 3(2), 2014), scaled so that the six axes are exact in 16 bits.
#ifndef COMMON_OCTAHEDRAL_GLSL
#define COMMON_OCTAHEDRAL_GLSL

vec2 encodeNormal(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  if (n.z < 0.0) p = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
  p = round(p * 32767.0);
  if (p == vec2(-32767.0)) p = -p;  // the corners are one normal
  return (p + 32767.0) / 65535.0;
}

vec3 decodeNormal(vec2 stored) {
  vec2 p = stored * (65535.0 / 32767.0) - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float below = max(-n.z, 0.0);
  n.xy += mix(vec2(below), vec2(-below), greaterThanEqual(n.xy, vec2(0.0)));
  return normalize(n);
}

#endif
