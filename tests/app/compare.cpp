// weft_compare: how two PNG files differ, for the golden and window tests.
//   weft_compare ACTUAL EXPECTED STEP FRACTION [DIFFERENCE.png]   exit 0 when at most FRACTION of the pixels have a channel
//                                                                 that differs, and none by more than STEP (of 255)
//   weft_compare --describe FILE                                  width, height, mean and standard deviation of the colors
//   weft_compare --flip REFERENCE TEST PIXELS_PER_DEGREE          the FLIP error of each pixel, a line each

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/assets/images/flip.h"

using namespace weft;

namespace {

int printFlip(const std::string& reference, const std::string& test, double density) {
  text::Diagnostics diagnostics;
  const auto a = assets::loadImage8(reference, 3, diagnostics), b = assets::loadImage8(test, 3, diagnostics);
  if (!a || !b) {
    std::fputs(diagnostics.text().c_str(), stderr);
    return 2;
  }
  const assets::FlipMap map = assets::computeFlip(*a, *b, density);
  for (const float error : map.errors) std::printf("%.9g\n", static_cast<double>(error));
  return map.errors.empty() ? 1 : 0;
}

int describe(const std::string& path) {
  text::Diagnostics diagnostics;
  const auto image = assets::loadImage8(path, 3, diagnostics);
  if (!image) {
    std::fputs(diagnostics.text().c_str(), stderr);
    return 2;
  }
  double sum = 0, squares = 0;
  for (const std::uint8_t x : image->texels) {
    sum += x;
    squares += double(x) * x;
  }
  const double count = static_cast<double>(image->texels.size());
  std::printf("%d %d %.3f %.3f\n", image->width, image->height, sum / count,
              std::sqrt(squares / count - sum / count * sum / count));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 2 && arguments[0] == "--describe") return describe(arguments[1]);
  if (arguments.size() == 4 && arguments[0] == "--flip")
    return printFlip(arguments[1], arguments[2], std::atof(arguments[3].c_str()));
  if (arguments.size() < 4) return 2;
  text::Diagnostics diagnostics;
  const auto actual = assets::loadImage8(arguments[0], 4, diagnostics);
  const auto expected = assets::loadImage8(arguments[1], 4, diagnostics);
  if (!actual || !expected) {
    std::fputs(diagnostics.text().c_str(), stderr);
    return 2;
  }
  const assets::Comparison found = assets::compareImages(*actual, *expected);
  if (!found.sameShape) {
    std::printf("%dx%d, not %dx%d\n", actual->width, actual->height, expected->width, expected->height);
    return 1;
  }
  const double share = static_cast<double>(found.differingPixels) / (double(actual->width) * actual->height);
  std::printf("%zu pixels differ (%.4f %%), at most by %.0f, at %d,%d\n", found.differingPixels, share * 100,
              found.maxDifference, found.worstX, found.worstY);
  if (found.maxDifference <= std::atof(arguments[2].c_str()) && share <= std::atof(arguments[3].c_str()))
    return 0;
  if (arguments.size() > 4) {
    assets::Image8 difference = *actual;  // 16 times as much; alpha is opaque
    for (std::size_t i = 0; i < difference.texels.size(); ++i) {
      const bool alpha = difference.channels == 4 && i % 4 == 3;
      const int off = 16 * std::abs(int{actual->texels[i]} - int{expected->texels[i]});
      difference.texels[i] = alpha ? 255 : static_cast<std::uint8_t>(std::min(off, 255));
    }
    assets::savePng8(arguments[4], difference.width, difference.height, difference.channels,
                     difference.texels, diagnostics);
  }
  return 1;
}
