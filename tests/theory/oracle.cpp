#include "tests/theory/oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace weft::theory {

namespace {

constexpr double kPi = std::numbers::pi;

// Smith's Lambda of GGX (Heitz 2014, equation 72).
double lambda(double cosine, double alpha) {
  const double tan2 = (1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

// Calls visit(direction, cosine to the normal, angle phi) for local polar coordinates around `normal`.
struct Frame {
  explicit Frame(Vec3 n) : normal(n) {
    side = normalized(cross(std::abs(n.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n));
    up = cross(n, side);
  }
  Vec3 at(double cosine, double phi) const {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return normal * cosine + (side * (sine * std::cos(phi)) + up * (sine * std::sin(phi)));
  }
  Vec3 normal, side, up;
};

}  // namespace

// The albedo is the integral over half vectors of D (N.H) dH times F G2 (V.H) / ((N.V) (N.H)). With tan(theta) =
// alpha tan(psi), D (N.H) dH becomes sin(2 psi) dpsi dphi / (2 pi): smooth for every roughness.
Albedo directionalAlbedo(double nv, double roughness, int steps) {
  const double alpha = roughness * roughness, sv = std::sqrt(1 - nv * nv), lambdaV = lambda(nv, alpha);
  std::vector<double> cosines;  // of phi: what is integrated is even in it
  for (int j = 0; j < steps; ++j) cosines.push_back(std::cos(kPi * (j + 0.5) / steps));
  Albedo sum;
  for (int i = 0; i < steps; ++i) {
    const double psi = (i + 0.5) / steps * kPi / 2, tangent = alpha * std::tan(psi);
    const double nh = 1 / std::sqrt(1 + tangent * tangent), sh = tangent * nh;
    const double weight = std::sin(2 * psi) * (kPi / 2 / steps) / steps;
    for (const double cosine : cosines) {
      const double vh = sv * sh * cosine + nv * nh;
      const double nl = 2 * vh * nh - nv;
      if (vh <= 0 || nl <= 0) continue;
      const double masking = 1 / (1 + lambdaV + lambda(nl, alpha)), left = 1 - vh;
      const double value = weight * masking * vh / (nv * nh), fresnel = left * left * left * left * left;
      sum.scale += value * (1 - fresnel);
      sum.bias += value * fresnel;
    }
  }
  return sum;
}

double projectedSphereArea(double f, double r, double d, double z) {
  return kPi * f * f * r * r * std::sqrt(d * d - r * r) / std::pow(z * z - r * r, 1.5);
}

Vec3 equirectDirection(int x, int y, int width, int height) {
  const double phi = ((x + 0.5) / width - 0.5) * 2 * kPi, latitude = (0.5 - (y + 0.5) / height) * kPi;
  return {std::cos(latitude) * std::cos(phi), std::sin(latitude), std::cos(latitude) * std::sin(phi)};
}

double lobeIrradiance(Vec3 normal, Vec3 lobe, double power, int steps) {
  const Frame frame(normal);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double cosine = std::sqrt((i + 0.5) / steps);  // equal steps of cosine squared carry equal weight
    for (int j = 0; j < steps; ++j)
      sum += std::pow(std::max(0.0, dot(frame.at(cosine, 2 * kPi * (j + 0.5) / steps), lobe)), power);
  }
  return sum / (static_cast<double>(steps) * steps);
}

double lobeReflection(Vec3 normal, Vec3 lobe, double power, double roughness, int steps) {
  const Frame frame(normal);
  const double alpha = roughness * roughness;
  double sum = 0, weights = 0;
  for (int i = 0; i < steps; ++i) {
    const double psi = (i + 0.5) / steps * kPi / 2, tangent = alpha * std::tan(psi);
    const double nl = 2 / (1 + tangent * tangent) - 1;  // L is N reflected about H
    if (nl <= 0) continue;
    const double weight = std::sin(2 * psi) * nl;
    for (int j = 0; j < steps; ++j)
      sum += weight * std::pow(std::max(0.0, dot(frame.at(nl, 2 * kPi * (j + 0.5) / steps), lobe)), power);
    weights += weight * steps;
  }
  return sum / weights;
}

}  // namespace weft::theory
