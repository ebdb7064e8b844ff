#include "engine/assets/images/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/glm.hpp>
#include <numbers>

namespace weft::assets {

namespace {

using Color = glm::dvec3;
constexpr double kPi = std::numbers::pi;

// Linear sRGB to CIE XYZ under D65, as exact fractions; rows sum to the white point.
const glm::dmat3 kToXyz = glm::transpose(glm::dmat3(                    //
    10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,  //
    2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,    //
    1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
const glm::dmat3 kFromXyz = glm::inverse(kToXyz);
const Color kWhite = kToXyz * Color(1);

// YCxCz: the linear opponent space in which contrast sensitivity is known (section 4.1).
Color toOpponent(const Color& rgb) {
  const Color xyz = kToXyz * rgb / kWhite;
  return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

Color fromOpponent(const Color& c) {
  const double y = (c[0] + 16) / 116;
  return kFromXyz * (Color(y + c[1] / 500, y, y - c[2] / 200) * kWhite);
}

// L*a*b* with the chroma scaled by the lightness: the Hunt effect (section 4.1.3).
Color toHuntLab(const Color& rgb) {
  Color xyz = kToXyz * rgb / kWhite;
  constexpr double kDelta = 6.0 / 29;
  for (int i = 0; i < 3; ++i)
    xyz[i] =
        xyz[i] > kDelta * kDelta * kDelta ? std::cbrt(xyz[i]) : xyz[i] / (3 * kDelta * kDelta) + 4.0 / 29;
  const double l = 116 * xyz.y - 16;
  return {l, 0.01 * l * 500 * (xyz.x - xyz.y), 0.01 * l * 200 * (xyz.y - xyz.z)};
}

double distanceOf(const Color& a, const Color& b) {  // HyAB
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

using Plane = std::vector<double>;
using Kernel = std::vector<double>;  // an odd number of weights

template <class Weight>
Kernel makeKernel(int radius, Weight&& weight) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(i));
  return kernel;
}

// The positive weights sum to 1, the negative ones to -1. The sign of a two-dimensional filter is that of its factor along the
// derivative, so that normalizing the factors normalizes the product.
void normalize(Kernel& kernel) {
  double positive = 0, negative = 0;
  for (const double w : kernel) (w > 0 ? positive : negative) += std::abs(w);
  for (double& w : kernel) w /= w > 0 ? positive : negative > 0 ? negative : 1;
}

// Filters along one axis: along `count` pixels that are `step` apart, for `lines` lines that begin `lineStep` apart. Beyond the edge
// the picture repeats its outermost pixels.
Plane filter(const Plane& from, const Kernel& kernel, int count, int step, int lines, int lineStep) {
  Plane to(from.size());
  const int radius = static_cast<int>(kernel.size() / 2);
  for (int line = 0; line < lines; ++line) {
    const std::ptrdiff_t begin = std::ptrdiff_t{line} * lineStep;
    for (int i = 0; i < count; ++i) {
      double sum = 0;
      for (int k = -radius; k <= radius; ++k)
        sum += kernel[static_cast<std::size_t>(k + radius)] *
               from[static_cast<std::size_t>(begin + std::ptrdiff_t{std::clamp(i + k, 0, count - 1)} * step)];
      to[static_cast<std::size_t>(begin + std::ptrdiff_t{i} * step)] = sum;
    }
  }
  return to;
}

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
      : width_(image.width), height_(image.height), density_(pixelsPerDegree) {
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t pixels = image.texels.size() / channels;
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < 256; ++i)
      linear[i] = static_cast<double>(decodeSrgb(static_cast<float>(i) / 255));
    for (Plane& plane : opponent_) plane.resize(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
      const std::uint8_t* texel = &image.texels[p * channels];
      const Color c = toOpponent({linear[texel[0]], linear[texel[1]], linear[texel[2]]});
      for (int i = 0; i < 3; ++i) opponent_[static_cast<std::size_t>(i)][p] = c[i];
    }
  }

  // What is seen of the colors from that distance, in Hunt-adjusted L*a*b*.
  std::vector<Color> seen() {
    const Plane y = blur(opponent_[0], {kAchromatic}), x = blur(opponent_[1], {kRedGreen}),
                z = blur(opponent_[2], {kBlueYellow, kBlueYellow2});
    std::vector<Color> out(y.size());
    for (std::size_t p = 0; p < out.size(); ++p) {
      out[p] = toHuntLab(glm::clamp(fromOpponent({y[p], x[p], z[p]}), 0.0, 1.0));
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
  Plane apply(const Plane& plane, const Kernel& alongX, const Kernel& alongY) const {
    return filter(filter(plane, alongX, width_, 1, height_, width_), alongY, height_, width_, width_, 1);
  }

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
      for (const double w : kernel) side += w;
      const double height = g.a * std::sqrt(kPi / g.b);
      whole += height * side * side;
      const Plane part = apply(plane, kernel, kernel);
      for (std::size_t p = 0; p < out.size(); ++p) out[p] += height * part[p];
    }
    for (double& v : out) v /= whole;
    return out;
  }

  Plane lengths(const Plane& y, const Kernel& derivative, const Kernel& smooth) {
    Plane x = apply(y, derivative, smooth);
    const Plane other = apply(y, smooth, derivative);
    for (std::size_t p = 0; p < x.size(); ++p) x[p] = std::hypot(x[p], other[p]);
    return x;
  }

  int width_, height_;
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

Comparison compareImages(const Image8& a, const Image8& b, double tolerance) {
  Comparison result;
  result.sameShape = a.width == b.width && a.height == b.height && a.channels == b.channels &&
                     a.texels.size() == b.texels.size();
  if (!result.sameShape || a.texels.empty()) return result;
  const auto channels = static_cast<std::size_t>(a.channels), width = static_cast<std::size_t>(a.width);
  for (std::size_t pixel = 0; pixel < a.texels.size() / channels; ++pixel) {
    int largest = 0;
    for (std::size_t i = pixel * channels; i < (pixel + 1) * channels; ++i)
      largest = std::max(largest, std::abs(int{a.texels[i]} - int{b.texels[i]}));
    if (largest > tolerance) ++result.differingPixels;
    if (largest <= result.maxDifference) continue;
    result.maxDifference = largest;
    result.worstX = static_cast<int>(pixel % width);
    result.worstY = static_cast<int>(pixel / width);
  }
  return result;
}

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
  static const Color kMagma[7] = {
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
  for (const float error : map.errors) {
    Color value(0);
    for (std::size_t i = 7; i-- > 0;)
      value = value * std::clamp(static_cast<double>(error), 0.0, 1.0) + kMagma[i];
    for (int c = 0; c < 3; ++c)
      out.texels.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value[c], 0.0, 1.0) * 255)));
  }
  return out;
}

}  // namespace weft::assets
