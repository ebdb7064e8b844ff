// Directional albedo of the GGX microfacet BRDF for the split sum (Karis, SIGGRAPH 2013): with Schlick's Fresnel,
// albedo(F0) = F0 * r + g. x is N.V, y is perceptual roughness, both at texel centres (i + 1/2) / size.
// write  table  rgba16f, any size
//          r, g  of the albedo
//          b     how far the lobe leans from the mirror direction to the normal: its axis is mix(mirror, normal, b), not normalised
//          a     what to add to its place among the levels of the prefiltered map, as a share of all of them (roughness_level.glsl)
//
// Smith's height-correlated masking (Heitz, JCGT 2014). Normals visible from V are integrated on the spherical cap of
// Dupuy and Benyoub (HPG 2023), bounded below as Eto and Tokuyoshi (SIGGRAPH Asia 2023) do: 12 Gauss-Legendre nodes in
// height, squared towards the lower end where the distribution's tail is, times 16 midpoints over half the azimuth (the
// integrand is even in it). Against 300 x 300 nodes both channels are within 0.001, their sum within 0.13 %.
//
// The lobe of a slanted surface is longer in the plane of incidence than across it, and rough ones lean to the normal. The prefiltered
// map has the lobes of V = N; the one that is read instead has the mean direction of the true lobe, and for variance the geometric
// mean of its variances in the plane and across it.
#include "roughness_level.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) uniform writeonly image2D table;

const int kHeights = 12, kAzimuths = 16;
const float kNode[12] = float[12](
  0.0092196829, 0.0479413718, 0.1150486629, 0.2063410229, 0.3160842505, 0.4373832957, 0.5626167043,
  0.6839157495, 0.7936589771, 0.8849513371, 0.9520586282, 0.9907803171);
const float kWeight[12] = float[12](
  0.0235876682, 0.0534696630, 0.0800391643, 0.1015837134, 0.1167462683, 0.1245735229, 0.1245735229,
  0.1167462683, 0.1015837134, 0.0800391643, 0.0534696630, 0.0235876682);
// Cosines and sines of the first half of the midpoints; the others mirror them.
const vec2 kAround[8] = vec2[8](
  vec2(0.99518473, 0.09801714), vec2(0.95694034, 0.29028468), vec2(0.88192126, 0.47139674), vec2(0.77301045, 0.63439328),
  vec2(0.63439328, 0.77301045), vec2(0.47139674, 0.88192126), vec2(0.29028468, 0.95694034), vec2(0.09801714, 0.99518473));

// Variance along one axis of the lobe of V = N, weighted by N.L: (1 - m^2) / 2 with its mean cosine m, in closed form.
// c = cos^2 of the half vector's angle has the density a2 / (1 + (a2 - 1) c)^2, and N.L = 2 c - 1.
float varianceOf(float alpha) {
  float a2 = alpha * alpha, s = 1.0 + a2, reach = s * (1.0 / a2 - 2.0 / s), bent = log(0.5 * s / a2);
  float once = reach - 2.0 * bent, twice = s * reach - 4.0 * s * bent + 2.0 * s - 4.0 * a2;
  float mean = twice / (once * (1.0 - a2));
  return 0.5 * (1.0 - mean * mean);
}

// Width of the lobe of V = N that has this variance, from 0.005 on: narrower ones are not in the map.
float alphaOfVariance(float variance) {
  vec2 range = vec2(log2(0.005), log2(0.995));
  for (int i = 0; i < 12; ++i) {
    float middle = 0.5 * (range.x + range.y);
    range = varianceOf(exp2(middle)) < variance ? vec2(middle, range.y) : vec2(range.x, middle);
  }
  return exp2(range.x);
}

void main() {
  ivec2 size = imageSize(table), at = ivec2(gl_GlobalInvocationID.xy);
  if (at.x >= size.x || at.y >= size.y) return;
  float nv = (float(at.x) + 0.5) / float(size.x);
  float alpha = alphaOfRoughness((float(at.y) + 0.5) / float(size.y));
  float a2 = alpha * alpha;
  float sv = sqrt(1.0 - nv * nv);

  vec2 w = normalize(vec2(alpha * sv, nv));  // V where the surface is a hemisphere
  float reach = (1.0 + sv) * (1.0 + sv);
  float lowest = -w.y * (1.0 - a2) * reach / (reach + a2 * nv * nv);
  float cap = 1.0 - lowest;
  float masking = sqrt(1.0 + a2 * (sv * sv) / (nv * nv));  // 1 + 2 Lambda(V)

  vec2 sum = vec2(0.0);
  vec3 light = vec3(0.0);  // mean direction towards the light in the plane of incidence; mean square across it
  for (int i = 0; i < kHeights; ++i) {
    float t = kNode[i];
    float z = lowest + cap * t * t;
    float ring = sqrt(max(1.0 - z * z, 0.0));
    float hz = w.y + z;
    vec2 part = vec2(0.0);
    vec3 part_light = vec3(0.0);
    for (int j = 0; j < kAzimuths; ++j) {
      vec2 around = kAround[j < 8 ? j : 15 - j];
      float hx = alpha * (w.x + (j < 8 ? ring : -ring) * around.x), hy = alpha * ring * around.y;
      float scale = inversesqrt(hx * hx + hy * hy + hz * hz);
      float vh = clamp((hx * sv + hz * nv) * scale, 0.0, 1.0);
      float lz = 2.0 * vh * hz * scale - nv;
      float lz2 = max(lz * lz, 1e-12);
      // G2 / G1(V) = (1 + 2 Lambda(V) + 1) / (1 + 2 Lambda(V) + 1 + 2 Lambda(L))
      float shadowing = (masking + 1.0) / (masking + sqrt(1.0 + a2 * max(1.0 - lz2, 0.0) / lz2));
      float m = 1.0 - vh, m2 = m * m;
      float fresnel = m2 * m2 * m;
      if (lz <= 0.0) continue;
      part += shadowing * vec2(1.0 - fresnel, fresnel);
      float lx = 2.0 * vh * hx * scale - sv, ly = 2.0 * vh * hy * scale;
      part_light += shadowing * vec3(lx, lz, ly * ly);
    }
    sum += part * (kWeight[i] * 2.0 * t);
    light += part_light * (kWeight[i] * 2.0 * t);
  }
  light /= sum.x + sum.y;

  // V leans to +X, so the mirror direction is (-sv, nv).
  float rise = light.y * sv + light.x * nv, lean = clamp(rise / max(rise - light.x, 1e-6), 0.0, 1.0);
  float across = light.z, along = max(1.0 - dot(light.xy, light.xy) - across, 0.0);
  float like = alphaOfVariance(sqrt(along * across));
  // Mirrors, whose variance is beyond the precision of floats: the lobe is nv times as wide across the plane.
  if (alpha < 0.005) like = alpha * sqrt(nv);
  imageStore(table, at, vec4(sum * (cap / ((1.0 + w.y) * float(kAzimuths))), lean, placeOfAlpha(like) - placeOfAlpha(alpha)));
}
