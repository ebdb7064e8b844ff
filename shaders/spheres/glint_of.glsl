// Finds the glint of a sphere, in the vertex shader, of the first of the brightest spots: see spheres/glint.glsl.
#ifndef SPHERES_GLINT_OF_GLSL
#define SPHERES_GLINT_OF_GLSL

#include "common/view.glsl"
#include "shading/lobe.glsl"
#include "spheres/glint.glsl"

const float kLeastBlur = 0.1;  // of the border between two pixels, pixels

// `bend` as in lobeOf; the lobe loses the light that the glint takes over. The spot's size and the surface's roughness blur the reflection,
// measured here in pixels. Up to one the pixels' squares count, from two on the lobe is smooth enough by itself. The square's share of a
// spot with the blur s at the distance x along an axis is (tanh(a (x + 1/2)) - tanh(a (x - 1/2))) / 2 = sinh(a) / (cosh(a) + cosh(2 a x)),
// with a = 0.907 / s. With g = exp(-2 a |x|) that is 2 sinh(a) g / (1 + 2 cosh(a) g + g^2).
Glint glintOf(inout Lobe lobe, vec3 center, float radius, float bend) {
  Glint glint = Glint(vec2(0.0), 0.0, 1.0, 0.0);
#if defined HAS_BRIGHTEST && SPECULAR_AA
  vec3 away = eye - center;
  float far2 = dot(away, away);
  // Where the normal is halfway between the eye and the spot.
  vec3 n = normalize(normalize(away) + lobe.spot);
  for (int i = 0; i < 3; ++i) n = normalize(normalize(away - radius * n) + lobe.spot);
  vec4 clip = view_projection * vec4(center + radius * n, 1.0);
  // From outside, in perspective. Not earlier: behind a condition software reads the view's members for each lane by itself.
  if (far2 < 4.0 * radius * radius || projection[3].w != 0.0 || clip.w <= 0.0) return glint;
  // Normals of a pixel span more there, in the plane of incidence.
  float facing = max(dot(normalize(away - radius * n), n), 0.05);
  float alpha = sqrt(lobe.spot_shape.alpha2), spread = 0.25 * spots[0].light.w;
  float blur = max(facing, 2.0 / 3.0) * sqrt(7.0 / 12.0 * alpha * alpha + spread) / max(bend, 1e-6), share = clamp(2.0 - blur, 0.0, 1.0);
  if (share <= 0.0) return glint;
  SpotShape sharp = spotShape(alpha, min(spread + bend * bend / (12.0 * facing * facing), 0.25));
  lobe.spot_shape.tail = mix(lobe.spot_shape.tail, sharp.tail, share);
  lobe.spot_shape.bump = mix(lobe.spot_shape.bump, sharp.bump, share);
  lobe.spot_shape.per_core = mix(lobe.spot_shape.per_core, sharp.per_core, share);
  float steep = 0.907 / max(blur, kLeastBlur), e = exp(steep), sh = 0.5 * (e - 1.0 / e);
  float slant = sqrt(far2) / max(dot(away, transpose(mat3(view))[2]), 1e-6);  // pixels off the axis see less of a solid angle
  float strength = share * (1.0 - lobe.spot_shape.alpha2 / lobe.spot_shape.tail) * 0.5 * kPi * slant / (bend * bend);
  glint = Glint((clip.xy / clip.w * 0.5 + 0.5) * viewport, 2.0 * steep / log(2.0), e + 1.0 / e, 4.0 * strength * sh * sh);
  lobe.spot_shape.bump *= 1.0 - share;
#endif
  return glint;
}

#endif
