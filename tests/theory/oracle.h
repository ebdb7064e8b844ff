// What theory says the pictures must be: closed forms and brute-force integrals in double precision, written from the
// definitions and sharing nothing with the shaders. Does not: know GL, or any scheme the shaders use to be fast.
#pragma once

#include <cmath>

namespace weft::theory {

// GGX with Smith's height-correlated masking and Schlick's Fresnel: albedo(F0) = F0 * scale + bias.
struct Albedo {
  double scale = 0, bias = 0;
  double sum() const { return scale + bias; }
};

// Integral of the BRDF times the cosine over the hemisphere, by a product rule of `steps` x `steps` half vectors; alpha is
// roughness squared. nv in (0, 1], roughness in (0, 1].
Albedo directionalAlbedo(double nv, double roughness, int steps = 500);

// Pixels covered by a sphere of radius r at distance d and view depth z (z > r); f is pixels per unit slope.
double projectedSphereArea(double f, double r, double d, double z);

struct Vec3 {
  double x = 0, y = 0, z = 0;
};
inline double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(Vec3 a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec3 normalized(Vec3 a) {
  return a * (1 / std::sqrt(dot(a, a)));
}

// Direction of the center of texel (x, y) of an equirectangular map, top row first.
Vec3 equirectDirection(int x, int y, int width, int height);

// Mean radiance around `normal`, weighted by the clamped cosine, of the radiance max(0, dot(l, lobe))^power, by a product rule.
double lobeIrradiance(Vec3 normal, Vec3 lobe, double power, int steps = 400);

// The same radiance seen through the GGX lobe of V = N = `normal`, weighted by N.L.
double lobeReflection(Vec3 normal, Vec3 lobe, double power, double roughness, int steps = 400);

}  // namespace weft::theory
