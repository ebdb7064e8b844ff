// Directional albedo of the GGX microfacet BRDF for the split sum (Karis, SIGGRAPH 2013): with Schlick's Fresnel,
// albedo(F0) = F0 * r + g. x is N.V, y is perceptual roughness, both at texel centers (i + 1/2) / size.
// threads: a work group of 8 x 16 makes 8 columns of 13 rows per 128 of the table's, [width, 16 * ceil(height / (13 * ceil(height / 128)))]
// write  table  rgba16f, any size
//          r, g  of the albedo
//          b     how far the lobe leans from the mirror direction to the normal: its axis is mix(mirror, normal, b), not normalized
//          a     what to add to the level of the prefiltered map, as a share of all levels (roughness_level.glsl)
//
// Smith's height-correlated masking (Heitz, JCGT 2014). Normals visible from V are integrated on the spherical cap of
// Dupuy and Benyoub (HPG 2023), bounded below as Eto and Tokuyoshi (SIGGRAPH Asia 2023) do: 12 Gauss-Legendre nodes in
// height, squared towards the lower end where the distribution's tail is, times 16 midpoints over half the azimuth (the
// integrand is even in it). Against 300 x 300 nodes both channels are within 0.001, their sum within 0.13 %.
//
// The lobe of a slanted surface is longer in the plane of incidence than across it, and rough ones lean to the normal. The prefiltered
// map has the round lobes of V = N: see roundLobe().
//
// Of four rows (where there are 512) one is integrated; the others are interpolated by the cubic through the four nearest (Catmull and Rom,
// 1974). The table is even in the roughness and continues beyond 1, so that the first and the last rows have neighbors.
#include "gauss_legendre.glsl"
#include "roughness_level.glsl"

layout(local_size_x = 8, local_size_y = 16) in;
layout(rgba16f) uniform writeonly image2D table;

const int kHeights = 12, kAzimuths = 16;
// Cosine and sine of the first midpoint, and of the angle from one to the next: in software an array costs more than a rotation.
const vec2 kFirst = vec2(cos(0.03125 * 3.14159265), sin(0.03125 * 3.14159265));
const vec2 kStep = vec2(cos(0.0625 * 3.14159265), sin(0.0625 * 3.14159265));

shared vec4 integrated[16][8];

// The round lobe that stands for a slanted one: how far it leans from the mirror direction to the normal, and its width as a share of alpha.
// Fitted to brute force under twelve maps; tests/theory/reflection holds five of them.
vec2 roundLobe(float nv, float alpha) {
  float a2 = alpha * alpha, x = a2 * (3.6 * alpha + 4.1 * (1.0 - alpha) * (1.0 - nv) / (nv + 0.65 * alpha));
  return vec2(x / (x + 1.0 - a2 * a2), (0.5 + 0.41 * nv * nv) * (0.95 + 1.7 * alpha));
}

vec4 integrate(float nv, float roughness, int quarters) {
  float alpha = alphaOfRoughness(roughness);
  float a2 = alpha * alpha;
  float sv = sqrt(1.0 - nv * nv);

  vec2 w = normalize(vec2(alpha * sv, nv));  // V where the surface is a hemisphere
  float reach = (1.0 + sv) * (1.0 + sv);
  float lowest = -w.y * (1.0 - a2) * reach / (reach + a2 * nv * nv);
  float cap = 1.0 - lowest;
  float masking = sqrt(1.0 + a2 * (sv * sv) / (nv * nv));  // 1 + 2 Lambda(V)

  vec2 sum = vec2(0.0);
  for (int i = 0; i < kHeights; ++i) {
    float t = kNode[i];
    float z = lowest + cap * t * t;
    float ring = sqrt(max(1.0 - z * z, 0.0));
    float hz = w.y + z;
    vec2 part = vec2(0.0);
    vec2 around = kFirst;
    // Four midpoints at once, mirrored at the azimuths pi / 4 and pi / 2.
    for (int j = 0; j < quarters; ++j) {
      vec4 hx = alpha * (w.x + ring * vec4(around, -around)), hy = (alpha * ring) * around.yxyx;
      vec4 scale = inversesqrt(hx * hx + hy * hy + hz * hz);
      vec4 vh = clamp((hx * sv + hz * nv) * scale, 0.0, 1.0), twice = 2.0 * vh * scale;
      vec4 lz = max(twice * hz - nv, 0.0);
      // G2 / G1(V) = (1 + 2 Lambda(V) + 1) / (1 + 2 Lambda(V) + 1 + 2 Lambda(L)), both parts times N.L
      vec4 shadowing = (masking + 1.0) * lz / (masking * lz + sqrt(mix(vec4(a2), vec4(1.0), lz * lz)));
      vec4 m = 1.0 - vh, m2 = m * m, fresnel = m2 * m2 * m;
      part += vec2(dot(shadowing, 1.0 - fresnel), dot(shadowing, fresnel));
      around = vec2(around.x * kStep.x - around.y * kStep.y, around.x * kStep.y + around.y * kStep.x);
    }
    sum += part * (kWeight[i] * 2.0 * t);
  }
  vec2 like = roundLobe(nv, alpha);  // places are logarithms, 1 for an alpha of 1: a share is a difference of places
  return vec4(sum * (cap / ((1.0 + w.y) * float(kAzimuths))), like.x, placeOfAlpha(like.y) - 1.0);
}

void main() {
  ivec2 size = imageSize(table), own = ivec2(gl_LocalInvocationID.xy);
  int step = (size.y + 127) / 128, first = int(gl_WorkGroupID.y) * 13 * step, column = int(gl_GlobalInvocationID.x);
  if (first >= size.y) return;
  int quarters = size.x > 0 ? kAzimuths / 4 : 1;  // not a constant: unrolled, the loop takes longer to translate
  float nv = (float(min(column, size.x - 1)) + 0.5) / float(size.x);
  integrated[own.y][own.x] = integrate(nv, abs(float(first + (own.y - 1) * step) + 0.5) / float(size.y), quarters);
  barrier();
  if (column >= size.x) return;
  for (int row = own.y; row < 13 * step && first + row < size.y; row += 16) {
    int node = row / step;
    float t = float(row - node * step) / float(step);
    vec4 a = integrated[node][own.x], b = integrated[node + 1][own.x], c = integrated[node + 2][own.x], d = integrated[node + 3][own.x];
    vec4 value = b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
    imageStore(table, ivec2(column, first + row), value);
  }
}
