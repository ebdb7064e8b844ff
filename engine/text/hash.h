// 64-bit FNV-1a over bytes and a mixer to combine hashes. Stable across runs and machines: fit for cache keys on disk.
#pragma once

#include <cstdint>
#include <string_view>

namespace weft::text {

constexpr std::uint64_t kHashSeed = 0xcbf29ce484222325ull;

constexpr std::uint64_t hashBytes(std::string_view bytes, std::uint64_t seed = kHashSeed) {
  for (const char c : bytes) seed = (seed ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return seed;
}

// Order-dependent combination (splitmix64 finaliser, Steele et al. 2014).
constexpr std::uint64_t hashCombine(std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = a * 0x9e3779b97f4a7c15ull + b + 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

}  // namespace weft::text
