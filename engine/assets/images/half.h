// IEEE 754 binary16 <-> binary32. To half rounds to nearest even, overflows to infinity, keeps subnormals; a
// NaN stays a quiet NaN with the top ten bits of its payload (what F16C does, so that every path gives
// the same bits).
#pragma once

#include <cstdint>
#include <span>

namespace weft::assets {

constexpr float kHalfMax = 65504.0f;

std::uint16_t floatToHalf(float value);
float halfToFloat(std::uint16_t half);

// Element by element; both spans have the same length.
void floatsToHalves(std::span<const float> from, std::span<std::uint16_t> to);

}  // namespace weft::assets
