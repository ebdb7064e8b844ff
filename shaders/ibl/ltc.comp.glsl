// The table by which rectangles are reflected: linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt, SIGGRAPH 2016) that stand for
// GGX with Smith's height-correlated masking, times the cosine. x is the square root of N.V, y is perceptual roughness: below of a white
// metal, above of a dielectric, with Schlick's Fresnel term. All at texel centers.
// write  table  rgba16f, any size. In the frame of the surface with V in the half plane of x > 0, light from l becomes that of a cosine at
//               (width * (l.x + shift * l.z), l.y, tilt * l.x + height * l.z):
//          r    square root of `width`
//          g    `shift`, as a share of the tangent of V
//          b, a `height` and `tilt` over 2 alpha, see alphaUnderLamps()
//
// The integral of the squared difference over the true lobe (plus a little) is least, by the method of Levenberg and Marquardt: a plain
// square would let the lobe light what lies on the eye's side. Directions are those of the normals visible from V, 12 Gauss-Legendre nodes
// times 16 midpoints as in brdf.comp.glsl, and as many all over the hemisphere (Veach and Guibas, SIGGRAPH 1995: the balance heuristic).
#include "gauss_legendre.glsl"
#include "roughness_level.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) uniform writeonly image2D table;

const float kPi = 3.14159265;
const int kHeights = 12, kAzimuths = 16, kRounds = 12;

void main() {
  ivec2 size = imageSize(table), texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, size))) return;
  vec2 at = (vec2(texel) + 0.5) / vec2(size);
  float f0 = at.y < 0.5 ? 1.0 : 0.04, nv = at.x * at.x, alpha = alphaUnderLamps(fract(2.0 * at.y));
  float a2 = alpha * alpha, sv = sqrt(1.0 - nv * nv), seen = sqrt(nv * nv * (1.0 - a2) + a2);
  vec2 v = normalize(vec2(alpha * sv, nv));  // where the surface is a hemisphere
  // Logarithm of `width`, `shift`, logarithm of `height`, `tilt`; what the best ones' error and its derivatives are.
  vec4 best, now = vec4(2.0 * log(seen), (1.0 - a2) * sv / (nv + alpha), log(1.4 * alpha * (nv + alpha)), -0.7 * alpha * sv * (1.0 - a2)), slope;
  mat4 bend;
  float whole = 0.0, least = 1e30, damping = 0.5;
  for (int round = 0; round <= kRounds; ++round) {  // the first one measures the whole lobe
    float width = exp(now.x), shift = now.y, height = exp(now.z), tilt = now.w, area = height - shift * tilt;
    float error = area > 0.0 ? 0.0 : 1e30;
    vec4 down = vec4(0.0);
    mat4 square = mat4(0.0);
    for (int i = 0; i < 2 * kHeights; ++i) {
      bool anywhere = i >= kHeights;
      float node = kNode[i % kHeights], z = anywhere ? node * node : (1.0 + v.y) * node * node - v.y, ring = sqrt(max(1.0 - z * z, 0.0));
      for (int j = 0; j < kAzimuths; ++j) {
        float phi = (float(j) + 0.5) * (kPi / float(kAzimuths));  // even in phi
        vec3 l = vec3(ring * cos(phi), ring * sin(phi), z), h = normalize(vec3(alpha * (v.x + l.x), alpha * l.y, v.y + z));
        if (anywhere)
          h = normalize(l + vec3(sv, 0.0, nv));
        else
          l = 2.0 * (h.x * sv + h.z * nv) * h - vec3(sv, 0.0, nv);
        if (l.z <= 0.0 || (anywhere && round == 0)) continue;
        float vh = h.x * sv + h.z * nv, share = 2.0 * kWeight[i % kHeights] * node / float(kAzimuths);
        float is = l.z * (seen + nv) / (l.z * seen + nv * sqrt(l.z * l.z * (1.0 - a2) + a2)) * mix(pow(1.0 - min(vh, 1.0), 5.0), 1.0, f0);
        if (round == 0) {
          whole += share * is;
          continue;
        }
        float d = h.z * h.z * a2 + dot(h.xy, h.xy), density = a2 / (2.0 * kPi * d * d * (nv + seen));  // of directions
        vec3 q = vec3(width * (l.x + shift * l.z), l.y, tilt * l.x + height * l.z);
        float q2 = dot(q, q), cosine = max(q.z, 0.0) * width * area / (kPi * q2 * q2), off = density * is / whole - cosine;
        share /= (density + 0.5 / kPi) * (density + 0.02);
        error += share * off * off;
        if (q.z <= 0.0) continue;
        vec4 slopes = vec4(1.0, -tilt / area, height * (l.z / q.z + 1.0 / area), l.x / q.z - shift / area) -
                      4.0 / q2 * vec4(q.x * q.x, q.x * width * l.z, q.z * height * l.z, q.z * l.x);
        slopes *= cosine;
        down += share * off * slopes;
        square += share * outerProduct(slopes, slopes);
      }
    }
    if (round == 0) continue;
    if (error < least) {
      least = error;
      best = now;
      slope = down;
      bend = square;
      damping = max(0.3 * damping, 1e-4);
    } else {
      damping *= 6.0;
    }
    vec4 unit = inversesqrt(max(vec4(bend[0][0], bend[1][1], bend[2][2], bend[3][3]), 1e-20));
    now = best + unit * (inverse(matrixCompMult(bend, outerProduct(unit, unit)) + mat4(damping)) * (unit * slope));
  }
  imageStore(table, texel, vec4(exp(0.5 * best.x), best.y * nv / sv, vec2(exp(best.z), best.w) / (2.0 * alpha)));
}
