#include "tests/theory/reflection/oracle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace weft::theory {

namespace {

constexpr int kCells = 128;    // of the coarse map, along the equator
constexpr int kSubtexels = 2;  // a bright texel is so many points a side

Vec3 directionAt(double u, double v) {
  const double phi = (u - 0.5) * 2 * std::numbers::pi, theta = v * std::numbers::pi;
  return {std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta)};
}

// Solid angle of a cell of row `y` of `rows`, `columns` to the turn.
double solidAngle(int y, int rows, int columns) {
  return 2 * std::numbers::pi / columns *
         (std::cos(std::numbers::pi * y / rows) - std::cos(std::numbers::pi * (y + 1) / rows));
}

// Smith's Lambda of GGX (Heitz 2014, equation 72).
double smithLambda(double cosine, double alpha) {
  const double tan2 = std::max(0.0, 1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

double distribution(double nh, double alpha) {
  const double d = nh * nh * (alpha * alpha - 1) + 1;
  return alpha * alpha / (std::numbers::pi * d * d);
}

double vanDerCorput(std::uint32_t i) {
  double value = 0, step = 0.5;
  for (; i; i >>= 1, step /= 2) value += (i & 1) * step;
  return value;
}

struct Turn {
  double cosine, sine;
};

// By vanDerCorput(i) of a circle.
const std::vector<Turn>& evenTurns() {
  static const std::vector<Turn> turns = [] {
    std::vector<Turn> made;
    for (std::uint32_t i = 0; i < 8192; ++i) {
      const double phi = 2 * std::numbers::pi * vanDerCorput(i);
      made.push_back({std::cos(phi), std::sin(phi)});
    }
    return made;
  }();
  return turns;
}

double hashed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return (x ^ (x >> 16)) * 0x1p-32;
}

}  // namespace

ReflectionOracle::ReflectionOracle(const assets::ImageF& map) : width_(map.width), height_(map.height) {
  const auto channels = static_cast<std::size_t>(map.channels);
  for (std::size_t i = 0; i < map.texels.size(); i += channels)
    whole_.push_back({map.texels[i], map.texels[i + 1], map.texels[i + 2]});
  dim_ = whole_;
  const int rows = kCells / 2, cell = std::max(1, width_ / kCells);
  coarse_.resize(std::size_t{kCells} * rows);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      Texel& texel = dim_[static_cast<std::size_t>(y * width_ + x)];
      Vec3 dim{texel.r, texel.g, texel.b};
      const double most = std::max({dim.x, dim.y, dim.z}), share = solidAngle(y, height_, width_);
      if (most > kBright) {
        const Vec3 left = dim * (kBright / most), over = dim - left;
        for (int i = 0; i < kSubtexels * kSubtexels; ++i)
          bright_.push_back({directionAt((x + (i % kSubtexels + 0.5) / kSubtexels) / width_,
                                         (y + (i / kSubtexels + 0.5) / kSubtexels) / height_),
                             over * (share / (kSubtexels * kSubtexels))});
        dim = left;
        texel = {static_cast<float>(dim.x), static_cast<float>(dim.y), static_cast<float>(dim.z)};
      }
      const int column = std::min(x / cell, kCells - 1), row = std::min(y / cell, rows - 1);
      Patch& patch = coarse_[static_cast<std::size_t>(row * kCells + column)];
      patch.direction = directionAt((column + 0.5) / kCells, (row + 0.5) / rows);
      patch.light = patch.light + dim * share;
    }
}

inline ReflectionOracle::Place ReflectionOracle::placeOf(Vec3 d) const {
  const double x = (std::atan2(d.z, d.x) / (2 * std::numbers::pi) + 0.5) * width_ - 0.5;
  const double y = (0.5 - std::asin(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi) * height_ - 0.5;
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const auto column = [&](int at) { return at < 0 ? at + width_ : at < width_ ? at : at - width_; };
  const auto row = [&](int at) {
    return &dim_[static_cast<std::size_t>(std::clamp(at, 0, height_ - 1) * width_)];
  };
  const Texel *upper = row(top), *lower = row(top + 1);
  const int l = column(left), r = column(left + 1);
  return {upper + l, upper + r, lower + l, lower + r, x - left, y - top};
}

inline Vec3 ReflectionOracle::between(const Place& at) {
  const auto light = [](const Texel* texel) { return Vec3{texel->r, texel->g, texel->b}; };
  return (light(at.upper_left) * (1 - at.x) + light(at.upper_right) * at.x) * (1 - at.y) +
         (light(at.lower_left) * (1 - at.x) + light(at.lower_right) * at.x) * at.y;
}

Vec3 ReflectionOracle::dimAt(Vec3 direction) const {
  return between(placeOf(direction));
}

Vec3 ReflectionOracle::lookUp(Vec3 d) const {
  const int x = static_cast<int>((std::atan2(d.z, d.x) / (2 * std::numbers::pi) + 0.5) * width_) % width_;
  const int y =
      std::clamp(static_cast<int>((0.5 - std::asin(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi) * height_),
                 0, height_ - 1);
  const auto at = static_cast<std::size_t>(y * width_ + x);
  const Texel &all = whole_[at], &dim = dim_[at];
  return dimAt(d) + (Vec3{all.r, all.g, all.b} - Vec3{dim.r, dim.g, dim.b});
}

ReflectionOracle::Metal ReflectionOracle::metalOf(double roughness) {
  Metal metal{.roughness = roughness, .alpha = roughness * roughness, .albedo = {}};
  constexpr int kCosines = 64;
  for (int i = 0; i <= kCosines; ++i)
    metal.albedo.push_back(
        roughness > 0 ? directionalAlbedo(std::max(i / double{kCosines}, 1e-3), roughness, 96).sum() : 1);
  double sum = 0;
  for (int i = 0; i < 1000; ++i) sum += metal.albedoAt((i + 0.5) / 1000) * 2 * (i + 0.5) / 1000 / 1000;
  metal.averageAlbedo = roughness > 0 ? sum : 1;
  return metal;
}

double ReflectionOracle::Metal::albedoAt(double cosine) const {
  const double at = std::clamp(cosine, 0.0, 1.0) * static_cast<double>(albedo.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), albedo.size() - 2);
  const double f = at - static_cast<double>(i);
  return albedo[i] * (1 - f) + albedo[i + 1] * f;
}

// Half vectors spread as D (N.H) (N.H): the weight that is left is G2 (V.H) / ((N.V) (N.H)).
Vec3 ReflectionOracle::radiance(Vec3 n, Vec3 v, const Metal& metal, int samples, unsigned set, int part,
                                int parts) const {
  if (metal.roughness == 0) return lookUp(n * (2 * dot(n, v)) - v);
  const double a = metal.alpha, nv = dot(n, v), lambdaV = smithLambda(nv, a);
  const Vec3 side = normalized(cross(std::abs(n.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n)),
             up = cross(n, side);
  // The parts of a set are shifted evenly against each other.
  const double shiftU = std::fmod(hashed(set * 2 + 1) + static_cast<double>(part) / parts, 1.0);
  const double shiftPhi = 2 * std::numbers::pi * (hashed(set * 2 + 2) + part * std::numbers::phi);
  // The axes turned by the shift.
  const Vec3 first = side * std::cos(shiftPhi) + up * std::sin(shiftPhi),
             second = up * std::cos(shiftPhi) - side * std::sin(shiftPhi);
  const std::vector<Turn>& turns = evenTurns();
  assert(static_cast<std::size_t>(samples) <= turns.size());
  Vec3 sum;
  // Samples lie far apart in the map, which no cache holds: the texels of several are fetched while others are worked on.
  constexpr int kAtOnce = 32;
  Place places[kAtOnce];
  double weights[kAtOnce];
  for (int begin = 0; begin < samples; begin += kAtOnce) {
    int count = 0;
    for (int i = begin; i < std::min(begin + kAtOnce, samples); ++i) {
      const double u = (i + shiftU) / samples;
      const Turn& turn = turns[static_cast<std::size_t>(i)];
      const double nh = std::sqrt((1 - u) / (1 + (a * a - 1) * u)),
                   sh = std::sqrt(std::max(0.0, 1 - nh * nh));
      const Vec3 h = n * nh + first * (sh * turn.cosine) + second * (sh * turn.sine);
      const double vh = dot(v, h);
      const Vec3 l = h * (2 * vh) - v;
      const double nl = dot(n, l);
      if (vh <= 0 || nl <= 0) continue;
      const Place& place = places[count] = placeOf(l);
      __builtin_prefetch(place.upper_left);
      __builtin_prefetch(place.lower_left);
      weights[count++] = vh / ((1 + lambdaV + smithLambda(nl, a)) * nv * nh);
    }
    for (int i = 0; i < count; ++i) sum = sum + between(places[i]) * weights[i];
  }
  sum = sum * (1.0 / samples);
  for (const Patch& patch : bright_) {
    const double nl = dot(n, patch.direction);
    if (nl <= 0) continue;
    const double nh = dot(n, normalized(v + patch.direction));
    sum = sum + patch.light * (distribution(nh, a) / (4 * nv * (1 + lambdaV + smithLambda(nl, a))));
  }
  return sum;
}

Vec3 ReflectionOracle::severalBounces(Vec3 n, Vec3 v, const Metal& metal) const {
  if (metal.roughness == 0) return {};
  Vec3 sum;
  for (const auto* patches : {&coarse_, &bright_})
    for (const Patch& patch : *patches) {
      const double nl = dot(n, patch.direction);
      if (nl > 0) sum = sum + patch.light * (nl * (1 - metal.albedoAt(nl)));
    }
  return sum * ((1 - metal.albedoAt(dot(n, v))) / (std::numbers::pi * (1 - metal.averageAlbedo)));
}

double shownOf255(double radiance) {
  return 255 * std::pow(radiance / (1 + radiance), 1 / 2.2);
}

}  // namespace weft::theory
