#include "engine/assets/images/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace weft::assets {

namespace {

using Color = std::array<double, 3>;
constexpr double kPi = std::numbers::pi;

// Linear sRGB to CIE XYZ under D65, as exact fractions; rows sum to the white point below.
constexpr double kToXyz[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382},
};
constexpr Color kWhite = {kToXyz[0][0] + kToXyz[0][1] + kToXyz[0][2],
                          kToXyz[1][0] + kToXyz[1][1] + kToXyz[1][2],
                          kToXyz[2][0] + kToXyz[2][1] + kToXyz[2][2]};

Color toXyz(const Color& rgb) {
  Color xyz{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) xyz[i] += kToXyz[i][k] * rgb[k];
  return xyz;
}

// Solves by Cramer's rule, so that the two directions agree to the last bits.
Color fromXyz(const Color& xyz) {
  const auto& m = kToXyz;
  const auto minor = [&](std::size_t r, std::size_t c) {
    const std::size_t a = (r + 1) % 3, b = (r + 2) % 3, d = (c + 1) % 3, e = (c + 2) % 3;
    return m[a][d] * m[b][e] - m[a][e] * m[b][d];
  };
  const double whole = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Color rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t r = 0; r < 3; ++r) rgb[c] += minor(r, c) / whole * xyz[r];
  return rgb;
}

// YCxCz: the linear opponent space in which contrast sensitivity is known (section 4.1).
Color toOpponent(const Color& rgb) {
  Color xyz = toXyz(rgb);
  for (std::size_t i = 0; i < 3; ++i) xyz[i] /= kWhite[i];
  return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

Color fromOpponent(const Color& c) {
  const double y = (c[0] + 16) / 116;
  return fromXyz({(y + c[1] / 500) * kWhite[0], y * kWhite[1], (y - c[2] / 200) * kWhite[2]});
}

// L*a*b* with the chroma scaled by the lightness: the Hunt effect (section 4.1.3).
Color toHuntLab(const Color& rgb) {
  Color xyz = toXyz(rgb);
  constexpr double kDelta = 6.0 / 29;
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = xyz[i] / kWhite[i];
    xyz[i] = t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  }
  const double l = 116 * xyz[1] - 16;
  return {l, 0.01 * l * 500 * (xyz[0] - xyz[1]), 0.01 * l * 200 * (xyz[1] - xyz[2])};
}

double distanceOf(const Color& a, const Color& b) {  // HyAB
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// A plane of the picture and filters along one axis; both axes make a separable filter. Beyond the edge the picture repeats its
// outermost pixels.
using Plane = std::vector<double>;
struct Kernel {
  int radius = 0;
  std::vector<double> weights{};  // 2 * radius + 1
};

template <class Weight>
Kernel makeKernel(int radius, Weight&& weight) {
  Kernel kernel{radius, {}};
  for (int i = -radius; i <= radius; ++i) kernel.weights.push_back(weight(i));
  return kernel;
}

// The positive weights sum to 1, the negative ones to -1. The sign of a two-dimensional filter is that of its factor along the
// derivative, so that normalizing the factors normalizes the product.
void normalize(Kernel& kernel) {
  double positive = 0, negative = 0;
  for (const double w : kernel.weights) (w > 0 ? positive : negative) += std::abs(w);
  for (double& w : kernel.weights) w /= w > 0 ? positive : negative > 0 ? negative : 1;
}

class Filter {
 public:
  Filter(int width, int height) : width_(width), height_(height) {}

  Plane apply(const Plane& plane, const Kernel& alongX, const Kernel& alongY) {
    Plane middle(plane.size()), out(plane.size());
    pass(plane, middle, alongX, width_, 1, height_, width_);
    pass(middle, out, alongY, height_, width_, width_, 1);
    return out;
  }

 private:
  // Along `count` pixels that are `step` apart, for `lines` lines that begin `lineStep` apart.
  static void pass(const Plane& from, Plane& to, const Kernel& kernel, int count, int step, int lines,
                   int lineStep) {
    for (int line = 0; line < lines; ++line) {
      const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(line) * lineStep;
      for (int i = 0; i < count; ++i) {
        double sum = 0;
        for (int k = -kernel.radius; k <= kernel.radius; ++k) {
          const int at = std::clamp(i + k, 0, count - 1);
          sum += kernel.weights[static_cast<std::size_t>(k + kernel.radius)] *
                 from[static_cast<std::size_t>(begin + static_cast<std::ptrdiff_t>(at) * step)];
        }
        to[static_cast<std::size_t>(begin + static_cast<std::ptrdiff_t>(i) * step)] = sum;
      }
    }
  }

  int width_, height_;
};

// Contrast sensitivity (table 1): sums of a * sqrt(pi / b) * exp(-pi^2 d^2 / b) at a distance of d degrees.
struct Gaussian {
  double a, b;
};
constexpr Gaussian kAchromatic = {1, 0.0047}, kRedGreen = {1, 0.0053}, kBlueYellow = {34.1, 0.04},
                   kBlueYellow2 = {13.5, 0.025};

struct Features {
  Plane edges, points;  // lengths of the two directions
};

class Side {
 public:
  Side(const Image8& image, double pixelsPerDegree)
      : filter_(image.width, image.height), density_(pixelsPerDegree) {
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t pixels = image.texels.size() / channels;
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < 256; ++i) {
      const double v = static_cast<double>(i) / 255;
      linear[i] = v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92;
    }
    for (Plane& plane : opponent_) plane.resize(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
      const std::uint8_t* texel = &image.texels[p * channels];
      const Color c = toOpponent({linear[texel[0]], linear[texel[1]], linear[texel[2]]});
      for (std::size_t i = 0; i < 3; ++i) opponent_[i][p] = c[i];
    }
  }

  // What is seen of the colours from that distance, in Hunt-adjusted L*a*b*.
  std::vector<Color> seen() {
    const Plane y = blur(opponent_[0], {kAchromatic}), x = blur(opponent_[1], {kRedGreen}),
                z = blur(opponent_[2], {kBlueYellow, kBlueYellow2});
    std::vector<Color> out(y.size());
    for (std::size_t p = 0; p < out.size(); ++p) {
      Color rgb = fromOpponent({y[p], x[p], z[p]});
      for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
      out[p] = toHuntLab(rgb);
    }
    return out;
  }

  // Section 4.2: first and second derivatives of a Gaussian, as wide as the eye's detectors.
  Features features() {
    constexpr double kWidth = 0.082;  // degrees between peak and trough
    const double deviation = 0.5 * kWidth * density_;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gauss = [&](int i) { return std::exp(-i * i / (2 * deviation * deviation)); };
    Kernel smooth = makeKernel(radius, gauss);
    Kernel edge = makeKernel(radius, [&](int i) { return -i * gauss(i); });
    Kernel point =
        makeKernel(radius, [&](int i) { return (i * i / (deviation * deviation) - 1) * gauss(i); });
    for (Kernel* kernel : {&smooth, &edge, &point}) normalize(*kernel);
    Plane y = opponent_[0];
    for (double& v : y) v = (v + 16) / 116;
    return {lengths(y, edge, smooth), lengths(y, point, smooth)};
  }

 private:
  Plane blur(const Plane& plane, const std::vector<Gaussian>& sums) {
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kBlueYellow.b / (2 * kPi * kPi)) * density_));
    Plane out(plane.size(), 0.0);
    double whole = 0;
    for (const Gaussian& g : sums) {
      const Kernel kernel = makeKernel(radius, [&](int i) {
        const double d = i / density_;
        return std::exp(-kPi * kPi * d * d / g.b);
      });
      double side = 0;
      for (const double w : kernel.weights) side += w;
      const double height = g.a * std::sqrt(kPi / g.b);
      whole += height * side * side;
      const Plane part = filter_.apply(plane, kernel, kernel);
      for (std::size_t p = 0; p < out.size(); ++p) out[p] += height * part[p];
    }
    for (double& v : out) v /= whole;
    return out;
  }

  Plane lengths(const Plane& y, const Kernel& derivative, const Kernel& smooth) {
    Plane x = filter_.apply(y, derivative, smooth);
    const Plane other = filter_.apply(y, smooth, derivative);
    for (std::size_t p = 0; p < x.size(); ++p) x[p] = std::hypot(x[p], other[p]);
    return x;
  }

  Filter filter_;
  double density_;
  std::array<Plane, 3> opponent_;
};

constexpr double kColorExponent = 0.7, kFeatureExponent = 0.5;

// Section 4.1.4: a large share of the range is given to the small differences.
double redistribute(double error, double largest) {
  constexpr double kShare = 0.4, kValue = 0.95;
  const double knee = kShare * largest;
  return error < knee ? kValue / knee * error : kValue + (error - knee) / (largest - knee) * (1 - kValue);
}

}  // namespace

FlipMap computeFlip(const Image8& reference, const Image8& test, double pixelsPerDegree) {
  FlipMap map;
  if (reference.width != test.width || reference.height != test.height || reference.channels < 3 ||
      test.channels < 3)
    return map;
  map.width = reference.width;
  map.height = reference.height;
  Side a(reference, pixelsPerDegree), b(test, pixelsPerDegree);
  const std::vector<Color> colors = a.seen(), others = b.seen();
  const Features features = a.features(), otherFeatures = b.features();
  const double largest = std::pow(distanceOf(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kColorExponent);
  map.errors.resize(colors.size());
  for (std::size_t p = 0; p < colors.size(); ++p) {
    const double color = redistribute(std::pow(distanceOf(colors[p], others[p]), kColorExponent), largest);
    const double feature = std::max(std::abs(features.edges[p] - otherFeatures.edges[p]),
                                    std::abs(features.points[p] - otherFeatures.points[p]));
    const double structure = std::pow(feature / std::numbers::sqrt2, kFeatureExponent);
    map.errors[p] = static_cast<float>(std::pow(color, 1 - structure));
  }
  return map;
}

FlipSummary summarizeFlip(const FlipMap& map, const std::vector<std::uint8_t>& weights) {
  FlipSummary out;
  std::size_t counted = 0;
  for (std::size_t p = 0; p < map.errors.size(); ++p) {
    if (!weights.empty() && weights[p] == 0) continue;
    const double error = static_cast<double>(map.errors[p]);
    out.mean += error;
    ++counted;
    if (error <= out.peak) continue;
    out.peak = error;
    out.x = static_cast<int>(p % static_cast<std::size_t>(map.width));
    out.y = static_cast<int>(p / static_cast<std::size_t>(map.width));
  }
  if (counted > 0) out.mean /= static_cast<double>(counted);
  return out;
}

Image8 colorFlip(const FlipMap& map) {
  // Matt Zucker's fit of degree 6 to the table of magma (https://www.shadertoy.com/view/WlfXRN, CC0).
  static constexpr Color kMagma[7] = {
      {-0.002136485053939582, -0.000749655052795221, -0.005386127855323933},
      {0.2516605407371642, 0.6775232436837668, 2.494026599312351},
      {8.353717279216625, -3.577719514958484, 0.3144679030132573},
      {-27.66873308576866, 14.26473078096533, -13.64921318813922},
      {52.17613981234068, -27.94360607168351, 12.94416944238394},
      {-50.76852536473588, 29.04658282127291, 4.23415299384598},
      {18.65570506591883, -11.48977351997711, -5.601961508734096},
  };
  Image8 out{map.width, map.height, 3, {}};
  out.texels.reserve(map.errors.size() * 3);
  for (const float error : map.errors)
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = std::clamp(static_cast<double>(error), 0.0, 1.0);
      double value = 0;
      for (std::size_t i = 7; i-- > 0;) value = value * x + kMagma[i][c];
      out.texels.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255)));
    }
  return out;
}

}  // namespace weft::assets
