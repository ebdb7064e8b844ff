#include "tests/theory/lens/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/load_image.h"

namespace weft::theory {

namespace {

double shown(double radiance) {
  return 255 * std::pow(radiance / (1 + radiance), 1 / 2.2);
}

}  // namespace

Difference differenceOf(const Radiance& a, const Radiance& b) {
  std::vector<double> pixels;
  Difference result;
  for (std::size_t i = 0; i < a.size(); i += 3) {
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(shown(a[i + c]) - shown(b[i + c])));
    pixels.push_back(worst);
    result.mean += worst;
    result.above32 += worst > 32;
  }
  std::sort(pixels.begin(), pixels.end());
  result.mean /= double(pixels.size());
  result.above32 /= double(pixels.size());
  result.percentile99 = pixels[pixels.size() * 99 / 100];
  return result;
}

namespace {

std::shared_ptr<const assets::ImageF> loadCoarse() {
  text::Diagnostics diagnostics;
  auto sky = assets::loadEnvironment(
      std::string(WEFT_SOURCE_DIR) + "/scenes/environments/spiaggia_di_mondello_1k.hdr", diagnostics);
  REQUIRE_MESSAGE(sky, diagnostics.text());
  constexpr int kCoarser = 8;
  assets::ImageF coarse{.width = sky->width / kCoarser, .height = sky->height / kCoarser, .channels = 4};
  coarse.texels.resize(std::size_t(coarse.width * coarse.height) * 4);
  for (int y = 0; y < coarse.height * kCoarser; ++y)
    for (int x = 0; x < coarse.width * kCoarser; ++x)
      for (int c = 0; c < 4; ++c)
        coarse.texels[std::size_t((y / kCoarser) * coarse.width + x / kCoarser) * 4 + std::size_t(c)] +=
            std::min(sky->texels[std::size_t(y * sky->width + x) * 4 + std::size_t(c)], 20.0f) /
            (kCoarser * kCoarser);
  return std::make_shared<const assets::ImageF>(std::move(coarse));
}

}  // namespace

std::shared_ptr<const assets::ImageF> coarseEnvironment() {
  static const std::shared_ptr<const assets::ImageF> once = loadCoarse();
  return once;
}

}  // namespace weft::theory
