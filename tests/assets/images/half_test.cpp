#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/assets/images/image.h"

using namespace weft::assets;

TEST_CASE("every half survives the way to float and back, by element") {
  std::vector<std::uint16_t> all(65536);
  std::vector<float> floats(65536);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint16_t>(i);
  for (std::size_t i = 0; i < all.size(); ++i) floats[i] = halfToFloat(all[i]);
  int wrong = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    wrong += floatToHalf(floats[i]) != all[i];
  }
  CHECK(wrong == 0);
}

TEST_CASE("known conversions") {
  CHECK(floatToHalf(0.0f) == 0);
  CHECK(floatToHalf(-0.0f) == 0x8000);
  CHECK(floatToHalf(1.0f) == 0x3c00);
  CHECK(floatToHalf(65504.0f) == 0x7bff);
  CHECK(floatToHalf(65519.996f) == 0x7bff);
  CHECK(floatToHalf(65520.0f) == 0x7c00);
  CHECK(floatToHalf(-std::numeric_limits<float>::infinity()) == 0xfc00);
  CHECK(floatToHalf(0x1p-24f) == 1);
  CHECK(floatToHalf(0x1p-25f) == 0);  // a tie goes to even
  CHECK(floatToHalf(std::nextafter(0x1p-25f, 1.0f)) == 1);
  CHECK(floatToHalf(1.0f + 0x1p-11f) == 0x3c00);      // tie, even below
  CHECK(floatToHalf(1.0f + 3 * 0x1p-11f) == 0x3c02);  // tie, even above
  CHECK(halfToFloat(0x3555) == doctest::Approx(0.33325195));
}

TEST_CASE("rounding is to the nearest half, by search") {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> exponent(-26, 15.9f);
  for (int i = 0; i < 20000; ++i) {
    const float x = std::exp2(exponent(random));
    const std::uint16_t h = floatToHalf(x);
    const double error = std::abs(static_cast<double>(halfToFloat(h)) - x);
    if (h > 0)
      REQUIRE(error <= std::abs(static_cast<double>(halfToFloat(static_cast<std::uint16_t>(h - 1))) - x));
    if (h < 0x7bff)
      REQUIRE(error <= std::abs(static_cast<double>(halfToFloat(static_cast<std::uint16_t>(h + 1))) - x));
  }
}
