#include "engine/assets/images/half.h"

#include <bit>
#include <cassert>
#include <cstddef>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace weft::assets {

namespace {

#if defined(__aarch64__)
using Half = __fp16;
#else
using Half = _Float16;
#endif

#if defined(__x86_64__)

// How many elements it did: the greatest multiple of 8.
__attribute__((target("avx,f16c"))) std::size_t convertEights(const float* from, std::uint16_t* to,
                                                              std::size_t count) {
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    const __m128i halves = _mm256_cvtps_ph(_mm256_loadu_ps(from + i), _MM_FROUND_TO_NEAREST_INT);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + i), halves);
  }
  return i;
}

#endif

}  // namespace

std::uint16_t floatToHalf(float value) {
  return std::bit_cast<std::uint16_t>(static_cast<Half>(value));
}

float halfToFloat(std::uint16_t half) {
  return static_cast<float>(std::bit_cast<Half>(half));
}

void floatsToHalves(std::span<const float> from, std::span<std::uint16_t> to) {
  assert(from.size() == to.size());
  std::size_t done = 0;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx") && __builtin_cpu_supports("f16c"))
    done = convertEights(from.data(), to.data(), from.size());
#endif
  for (std::size_t i = done; i < from.size(); ++i) to[i] = floatToHalf(from[i]);
}

}  // namespace weft::assets
