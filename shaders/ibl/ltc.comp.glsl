// The table by which rectangles are reflected: linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt, SIGGRAPH 2016) that stand for
// GGX with Smith's height-correlated masking, times the cosine. x is the square root of N.V, y is perceptual roughness, both at texel centers.
// write  table  rgba16f, any size. In the frame of the surface with V in the half plane of x > 0, light from l becomes that of a cosine at
//               (width * (l.x + shift * l.z), l.y, height * l.z):
//          r    square root of `width`
//          g    `shift`, as a share of the tangent of V
//          b    `height` over 2 alpha, see alphaUnderLamps()
//
// So the horizon stays where it is. In the plane of slopes such a distribution is Student's t with two degrees of freedom, and the one
// of the greatest likelihood is the fixed point of weighted means (Kent and Tyler, "Redescending M-estimates of multivariate location and
// scatter", 1991). Directions are those of the normals visible from V, 12 Gauss-Legendre nodes times 16 midpoints as in brdf.comp.glsl.
#include "roughness_level.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) uniform writeonly image2D table;

const int kHeights = 12, kAzimuths = 16, kRounds = 10;
const float kNode[12] = float[12](
  0.0092196829, 0.0479413718, 0.1150486629, 0.2063410229, 0.3160842505, 0.4373832957, 0.5626167043,
  0.6839157495, 0.7936589771, 0.8849513371, 0.9520586282, 0.9907803171);
const float kWeight[12] = float[12](
  0.0235876682, 0.0534696630, 0.0800391643, 0.1015837134, 0.1167462683, 0.1245735229, 0.1245735229,
  0.1167462683, 0.1015837134, 0.0800391643, 0.0534696630, 0.0235876682);

void main() {
  ivec2 size = imageSize(table), texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, size))) return;
  vec2 at = (vec2(texel) + 0.5) / vec2(size);
  float nv = at.x * at.x, alpha = alphaUnderLamps(at.y), a2 = alpha * alpha, sv = sqrt(1.0 - nv * nv);
  vec2 v = normalize(vec2(alpha * sv, nv));  // where the surface is a hemisphere
  float cap = 1.0 + v.y, seen = sqrt(nv * nv * (1.0 - a2) + a2);
  float width = mix(nv * nv, 1.0, alpha), shift = (1.0 - alpha) * sv / max(nv, alpha), height = 2.0 * alpha;
  for (int round = 0; round < kRounds; ++round) {
    vec4 sum = vec4(0.0);  // of x, x^2, y^2, 1
    for (int i = 0; i < kHeights; ++i) {
      float z = cap * kNode[i] * kNode[i] - v.y, ring = sqrt(max(1.0 - z * z, 0.0));
      for (int j = 0; j < kAzimuths; ++j) {
        float phi = (float(j) + 0.5) * (3.14159265 / float(kAzimuths));  // even in phi
        vec3 h = normalize(vec3(alpha * (v.x + ring * cos(phi)), alpha * ring * sin(phi), v.y + z));
        vec3 l = 2.0 * (h.x * sv + h.z * nv) * h - vec3(sv, 0.0, nv);
        if (l.z <= 0.0) continue;
        float share = kWeight[i] * kNode[i] * l.z / (l.z * seen + nv * sqrt(l.z * l.z * (1.0 - a2) + a2));
        float x = l.x + shift * l.z, inside = width * width * x * x + l.y * l.y + height * height * l.z * l.z;
        sum += share / max(inside, 1e-20) * vec4(x * l.z, x * x, l.y * l.y, l.z * l.z);
      }
    }
    float off = sum.x / sum.w;
    width = sqrt(sum.z / max(sum.y - off * sum.x, 1e-20));
    height = sqrt(2.0 * sum.z / sum.w);
    shift -= off;
  }
  imageStore(table, texel, vec4(sqrt(width), shift * nv / sv, height / (2.0 * alpha), 1.0));
}
