// FLIP's properties; flip_judge.py holds its values against a second implementation.
#include "engine/assets/images/flip.h"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/assets/images/image.h"

using namespace weft::assets;

namespace {

Image8 plain(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  Image8 image{width, height, 3, {}};
  for (int i = 0; i < width * height; ++i) image.texels.insert(image.texels.end(), {r, g, b});
  return image;
}

void put(Image8& image, int x, int y, std::uint8_t value) {
  for (int c = 0; c < 3; ++c) image.texels[static_cast<std::size_t>((y * image.width + x) * 3 + c)] = value;
}

}  // namespace

TEST_CASE("FLIP of a picture with itself is 0, and the two sides may be exchanged") {
  Image8 a = plain(20, 14, 40, 90, 160), b = a;
  put(b, 7, 5, 255);
  const FlipMap same = computeFlip(a, a), ab = computeFlip(a, b), ba = computeFlip(b, a);
  CHECK(summarizeFlip(same).mean == 0);
  CHECK(summarizeFlip(same).peak == 0);
  CHECK(ab.errors == ba.errors);
  const FlipSummary found = summarizeFlip(ab);
  CHECK(found.peak > 0.3);
  CHECK(found.x == 7);
  CHECK(found.y == 5);
  CHECK(found.mean < found.peak);
}

TEST_CASE("a larger difference is a larger error, and none is beyond 1") {
  double before = 0;
  for (const int value : {101, 105, 120, 160, 255}) {
    const auto v = static_cast<std::uint8_t>(value);
    const double mean = summarizeFlip(computeFlip(plain(9, 9, 100, 100, 100), plain(9, 9, v, v, v))).mean;
    CHECK(mean > before);
    before = mean;
  }
  const FlipSummary most = summarizeFlip(computeFlip(plain(9, 9, 0, 0, 0), plain(9, 9, 255, 255, 255)));
  CHECK(most.peak <= 1);
  CHECK(most.mean > 0.9);
}

TEST_CASE("alpha does not count, shapes must agree, and weights leave pixels out") {
  Image8 opaque{2, 1, 4, {10, 20, 30, 255, 40, 50, 60, 255}}, clear = opaque;
  clear.texels[3] = 0;
  CHECK(summarizeFlip(computeFlip(opaque, clear)).peak == 0);
  CHECK(computeFlip(plain(3, 2, 0, 0, 0), plain(2, 3, 0, 0, 0)).errors.empty());
  const FlipMap map{2, 1, {0.5f, 0.25f}};
  CHECK(summarizeFlip(map).mean == doctest::Approx(0.375));
  CHECK(summarizeFlip(map, {0, 1}).mean == doctest::Approx(0.25));
  CHECK(summarizeFlip(map, {0, 1}).x == 1);
  CHECK(summarizeFlip(map, {0, 0}).mean == 0);
}

TEST_CASE("seen from afar, fine structure matters less") {
  Image8 flat = plain(24, 24, 128, 128, 128), board = flat;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) put(board, x, y, (x + y) % 2 ? 138 : 118);
  CHECK(summarizeFlip(computeFlip(flat, board, 120)).mean < summarizeFlip(computeFlip(flat, board, 10)).mean);
}

TEST_CASE("the colors of errors become lighter evenly") {
  FlipMap map{256, 1, {}};
  for (int i = 0; i < 256; ++i) map.errors.push_back(static_cast<float>(i) / 255);
  const Image8 colors = colorFlip(map);
  double before = -1, worst = 0;
  for (std::size_t i = 0; i < 256; ++i) {
    const std::uint8_t* c = &colors.texels[3 * i];
    const double y = 0.2126 * static_cast<double>(decodeSrgb(static_cast<float>(c[0]) / 255)) +
                     0.7152 * static_cast<double>(decodeSrgb(static_cast<float>(c[1]) / 255)) +
                     0.0722 * static_cast<double>(decodeSrgb(static_cast<float>(c[2]) / 255));
    const double lightness = y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
    worst = std::max(worst, std::abs(lightness - 98.0 * static_cast<double>(i) / 255));
    CHECK(lightness > before - 0.6);
    before = lightness;
  }
  CHECK(worst < 6);  // magma is even in CAM02-UCS, whose lightness is not quite L*
  CHECK(encodePng8(256, 1, 3, colors.texels).starts_with("\x89PNG"));
}
