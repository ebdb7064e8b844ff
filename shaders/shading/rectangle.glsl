// Light of a rectangle that shines to one side, as bright from everywhere: Lambert's formula for the part above the horizon, and the lobe by a
// linearly transformed cosine. One of less than 1/500 of its distance counts as that large.
// read    ltc    the table of ibl/ltc.comp.glsl, `as linear`
// The includer has an ambientRadiance(): see shading/cook_torrance.glsl.
#ifndef SHADING_RECTANGLE_GLSL
#define SHADING_RECTANGLE_GLSL

#include "scene/lamps.glsl"
#include "shading/material.glsl"
#include "shading/point.glsl"

uniform sampler2D ltc;

// What an edge from `a` adds to the integral of the cosine to +Z (Lambert 1760), times 2 pi. The ends of a short one differ by less than
// they are rounded to.
float edgeOf(vec3 a, vec3 edge) {
  vec3 c = cross(a, edge);
  float sine = max(length(c), 1e-30);
  return c.z * (atan(sine, dot(a, a + edge)) / sine);
}

// Leaves of an edge what is above z = 0; false: nothing. `leaves`: where the polygon goes below; `closing`: from there to where it comes back.
bool clipEdge(inout vec3 a, inout vec3 edge, inout vec3 leaves, inout vec3 closing) {
  float end = a.z + edge.z, share = a.z / (a.z - end);
  if (max(a.z, end) <= 0.0) return false;
  if (a.z <= 0.0) {
    a += edge * share;
    edge *= 1.0 - share;
  } else if (end <= 0.0) {
    edge *= share;
    leaves = a + edge;
  }
  closing -= edge;
  return true;
}

float greatestOf(vec3 v) { return max(v.x, max(v.y, v.z)); }

// In the frame of the surface with V over +X, as a cosine.
mat3 lobeOf(Response response, float nv) {
  float rows = float(textureSize(ltc, 0).y), f0 = greatestOf(response.f0), alpha2 = 2.0 * alphaUnderLamps(response.roughness);
  vec2 at = vec2(sqrt(nv), 0.5 * clamp(response.roughness, 1.0 / rows, 1.0 - 1.0 / rows));
  // Of a dielectric, by how much its Fresnel term rises.
  float rise = response.exponent > 0.0 ? 0.0 : clamp((greatestOf(response.f90) - f0) / (24.0 * max(f0, 1e-3)), 0.0, 1.0);
  vec4 like = mix(textureLod(ltc, at, 0.0), textureLod(ltc, at + vec2(0.0, 0.5), 0.0), rise);
  float width = like.x * like.x, shift = like.y * sqrt(1.0 - nv * nv) / nv;
  return mat3(width, 0.0, alpha2 * like.w, 0.0, 1.0, 0.0, width * shift, 0.0, alpha2 * like.z);
}

// What the rectangle sends towards the eye; 0 beyond its range, which counts from the middle.
vec3 rectangleRadiance(Lamp self, Point point, Response response) {
  vec3 n = point.normal, v = point.to_eye, to = self.position - point.position;
  float away = max(length(to), 1e-4), far2 = away * away / (self.range * self.range), nv = max(point.nv, 1e-4);
  vec3 x = v - n * dot(n, v);
  x = dot(x, x) > 1e-8 ? normalize(x) : normalize(abs(n.y) < 0.9 ? cross(n, vec3(0.0, 1.0, 0.0)) : cross(n, vec3(1.0, 0.0, 0.0)));
  mat3 frame = transpose(mat3(x, cross(n, x), n)) * (1.0 / away), lobe = lobeOf(response, nv);
  vec3 across = frame * self.across, up = frame * self.up;
  across *= max(1.0, 1e-3 / length(across));
  up *= max(1.0, 1e-3 / length(up));
  vec3 corner = frame * to + across + up, leaves = vec3(0.0, 0.0, 1.0), closing = vec3(0.0), lobe_leaves = leaves, lobe_closing = closing;
  vec2 share = vec2(0.0);  // of all light that arrives, and of the lobe
  for (int i = 0; i < 5; ++i) {
    vec3 a = corner, edge = ((i & 1) == 0 ? across : up) * (i < 2 ? -2.0 : 2.0);
    corner += edge;
    if (i == 4) {  // along the horizon
      a = leaves;
      edge = closing;
    } else if (!clipEdge(a, edge, leaves, closing)) {
      continue;
    }
    share.x += edgeOf(a, edge);
    a = lobe * a;
    edge = lobe * edge;
    if (clipEdge(a, edge, lobe_leaves, lobe_closing)) share.y += edgeOf(a, edge);
  }
  share.y += edgeOf(lobe_leaves, lobe_closing);
  share = max(share, vec2(0.0)) * (0.5 / kPi);
  vec3 shines = self.intensity * (clamp(1.0 - far2 * far2, 0.0, 1.0) / (4.0 * away * away * length(cross(across, up))));
  Ambient light = noAmbient();
  light.reflected = shines * share.y * response.single;
  light.mean = shines * share.x;
  point.sky_visible = 1.0;
  return ambientRadiance(point, response, light);
}

#endif
