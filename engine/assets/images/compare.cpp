#include "engine/assets/images/compare.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace weft::assets {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double difference(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double d = std::abs(static_cast<double>(a) - static_cast<double>(b));
  return std::isnan(d) ? kInfinity : d;
}

double difference(std::uint8_t a, std::uint8_t b) {
  return std::abs(static_cast<int>(a) - static_cast<int>(b));
}

template <class Image>
bool haveSameShape(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         a.texels.size() == b.texels.size();
}

template <class Image>
Comparison compare(const Image& a, const Image& b, double tolerance, double peak) {
  Comparison result;
  result.sameShape = haveSameShape(a, b);
  if (!result.sameShape) return result;
  const std::size_t channels = static_cast<std::size_t>(a.channels);
  const std::size_t pixels = channels == 0 ? 0 : a.texels.size() / channels;
  double sum = 0, squares = 0;
  std::size_t worst = 0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    double largest = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      const double d = difference(a.texels[pixel * channels + c], b.texels[pixel * channels + c]);
      largest = std::max(largest, d);
      sum += d;
      squares += d * d;
    }
    if (largest > tolerance) ++result.differingPixels;
    if (largest > result.maxDifference) {
      result.maxDifference = largest;
      worst = pixel;
    }
  }
  if (pixels > 0) {
    const double components = static_cast<double>(a.texels.size());
    result.meanDifference = sum / components;
    result.psnr = squares > 0 ? 10 * std::log10(peak * peak * components / squares) : kInfinity;
    result.worstX = static_cast<int>(worst % static_cast<std::size_t>(a.width));
    result.worstY = static_cast<int>(worst / static_cast<std::size_t>(a.width));
  }
  return result;
}

}  // namespace

Comparison compareImages(const Image8& a, const Image8& b, double tolerance) {
  return compare(a, b, tolerance, 255);
}
Comparison compareImages(const ImageF& a, const ImageF& b, double tolerance) {
  return compare(a, b, tolerance, 1);
}

Image8 makeDifference(const Image8& a, const Image8& b, int gain) {
  assert(haveSameShape(a, b));
  Image8 result = a;
  for (std::size_t i = 0; i < a.texels.size(); ++i) {
    const bool alpha = a.channels % 2 == 0 &&
                       i % static_cast<std::size_t>(a.channels) + 1 == static_cast<std::size_t>(a.channels);
    const int d = std::abs(static_cast<int>(a.texels[i]) - static_cast<int>(b.texels[i])) * gain;
    result.texels[i] = alpha ? 255 : static_cast<std::uint8_t>(std::clamp(d, 0, 255));
  }
  return result;
}

}  // namespace weft::assets
