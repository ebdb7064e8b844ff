// Light of a rectangle that shines to one side, as bright from everywhere: Lambert's formula for the part above the horizon, and the lobe by a
// linearly transformed cosine.
// read    ltc    the table of ibl/ltc.comp.glsl, `as linear`
// The includer has an ambientRadiance(): see shading/cook_torrance.glsl.
#ifndef SHADING_RECTANGLE_GLSL
#define SHADING_RECTANGLE_GLSL

#include "scene/lamps.glsl"
#include "shading/material.glsl"
#include "shading/point.glsl"

uniform sampler2D ltc;

// What the edge from a to b adds to the integral of the cosine to +Z (Lambert 1760), times 2 pi.
float edgeOf(vec3 a, vec3 b) {
  vec3 c = cross(a, b);
  float sine = length(c);
  return c.z * (atan(sine, dot(a, b)) / max(sine, 1e-30));
}

// What the rectangle sends towards the eye; 0 beyond its range, which counts from the middle.
vec3 rectangleRadiance(Lamp self, Point point, Response response) {
  vec3 n = point.normal, v = point.to_eye, to = self.position - point.position;
  float far2 = dot(to, to) / (self.range * self.range);
  vec3 x = v - n * dot(n, v);
  x = dot(x, x) > 1e-8 ? normalize(x) : normalize(abs(n.y) < 0.9 ? cross(n, vec3(0.0, 1.0, 0.0)) : cross(n, vec3(1.0, 0.0, 0.0)));
  mat3 frame = transpose(mat3(x, cross(n, x), n));
  to = frame * to;
  vec3 across = frame * self.across, up = frame * self.up;
  vec3 corner[4] = vec3[](to + across + up, to - across + up, to - across - up, to + across - up);
  // The lobe, as a cosine in a space of the same horizon.
  float nv = max(point.nv, 1e-4);
  vec3 like = textureLod(ltc, vec2(sqrt(nv), response.roughness), 0.0).xyz;
  float width = like.x * like.x, shift = like.y * sqrt(1.0 - nv * nv) / nv;
  mat3 lobe = mat3(width, 0.0, 0.0, 0.0, 1.0, 0.0, width * shift, 0.0, like.z * 2.0 * alphaUnderLamps(response.roughness));
  vec2 share = vec2(0.0);  // of all light that arrives, and of the lobe
  vec3 leaves = vec3(0.0), enters = vec3(0.0);
  for (int i = 0; i < 5; ++i) {
    vec3 a = corner[i & 3], b = corner[(i + 1) & 3];
    if (i == 4) {  // along the horizon
      a = leaves;
      b = enters;
    } else if (a.z <= 0.0 && b.z <= 0.0) {
      continue;
    } else if (a.z <= 0.0) {
      a = enters = vec3(mix(a.xy, b.xy, a.z / (a.z - b.z)), 0.0);
    } else if (b.z <= 0.0) {
      b = leaves = vec3(mix(a.xy, b.xy, a.z / (a.z - b.z)), 0.0);
    }
    share += vec2(edgeOf(a, b), edgeOf(lobe * a, lobe * b));
  }
  share = max(share, vec2(0.0)) * (0.5 / kPi);
  vec3 shines = self.intensity * (clamp(1.0 - far2 * far2, 0.0, 1.0) / (4.0 * length(cross(across, up))));
  Ambient light = noAmbient();
  light.reflected = shines * share.y * response.single;
  light.mean = shines * share.x;
  point.sky_visible = 1.0;
  return ambientRadiance(point, response, light);
}

#endif
