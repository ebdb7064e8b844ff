#include "engine/assets/images/deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <vector>

namespace weft::assets {

namespace {

constexpr std::size_t kWindow = 32768, kLongest = 258, kShortest = 4;
constexpr unsigned kHashBits = 15;

struct BitCode {
  std::uint32_t bits = 0;
  unsigned count = 0;
};

// Huffman codes begin with their highest bit, all else with its lowest.
BitCode reversed(std::uint32_t bits, unsigned count) {
  BitCode code{.count = count};
  for (unsigned i = 0; i < count; ++i) code.bits |= (bits >> i & 1u) << (count - 1 - i);
  return code;
}

// The fixed codes of RFC 1951, 3.2.6.
BitCode symbolCode(std::uint32_t symbol) {
  if (symbol < 144) return reversed(0x30 + symbol, 8);
  if (symbol < 256) return reversed(0x190 + symbol - 144, 9);
  if (symbol < 280) return reversed(symbol - 256, 7);
  return reversed(0xc0 + symbol - 280, 8);
}

BitCode withExtra(BitCode code, std::uint32_t extra, unsigned count) {
  return {code.bits | extra << code.count, code.count + count};
}

// The code of a length with its extra bits (3.2.5).
BitCode lengthCode(std::uint32_t length) {
  if (length == kLongest) return symbolCode(285);
  const std::uint32_t above = length - 3;
  const unsigned extra = above < 8 ? 0 : static_cast<unsigned>(std::bit_width(above)) - 3;
  return withExtra(symbolCode(257 + 4 * extra + (above >> extra)), above & ((1u << extra) - 1), extra);
}

// And of a distance.
BitCode distanceCode(std::uint32_t distance) {
  const std::uint32_t above = distance - 1;
  const unsigned extra = above < 4 ? 0 : static_cast<unsigned>(std::bit_width(above)) - 2;
  return withExtra(reversed(2 * extra + (above >> extra), 5), above & ((1u << extra) - 1), extra);
}

struct Tables {
  std::array<BitCode, 256> literals;
  std::array<BitCode, kLongest + 1> lengths;
  Tables() {
    for (std::uint32_t i = 0; i < literals.size(); ++i) literals[i] = symbolCode(i);
    for (std::uint32_t i = 3; i < lengths.size(); ++i) lengths[i] = lengthCode(i);
  }
};

class BitWriter {
 public:
  explicit BitWriter(char* out) : at_(out) {}
  void put(BitCode code) {  // of at most 32 bits
    bits_ |= std::uint64_t{code.bits} << count_;
    count_ += code.count;
    for (; count_ >= 8; count_ -= 8, bits_ >>= 8) *at_++ = static_cast<char>(bits_ & 0xff);
  }
  char* finish() {
    if (count_ > 0) *at_++ = static_cast<char>(bits_ & 0xff);
    return at_;
  }

 private:
  char* at_;
  std::uint64_t bits_ = 0;
  unsigned count_ = 0;
};

std::uint32_t fourBytes(const std::uint8_t* at) {
  std::uint32_t value = 0;
  std::memcpy(&value, at, sizeof value);
  return value;
}

std::uint32_t adler32(std::span<const std::uint8_t> bytes) {
  std::uint32_t a = 1, b = 0;
  while (!bytes.empty()) {
    const auto part = bytes.first(std::min<std::size_t>(bytes.size(), 5552));  // before b overflows
    for (const std::uint8_t byte : part) b += a += byte;
    a %= 65521;
    b %= 65521;
    bytes = bytes.subspan(part.size());
  }
  return b << 16 | a;
}

}  // namespace

std::string deflateFast(std::span<const std::uint8_t> bytes) {
  static const Tables tables;
  std::string out(bytes.size() + bytes.size() / 8 + 16, '\0');  // a literal takes 9 bits at most
  out[0] = '\x78';                                              // a window of 32 KiB
  out[1] = '\x01';
  BitWriter bits(out.data() + 2);
  bits.put({.bits = 0b011, .count = 3});  // the last block, of fixed codes
  constexpr std::uint32_t kNowhere = ~std::uint32_t{0};
  std::vector<std::uint32_t> last(std::size_t{1} << kHashBits, kNowhere);
  const std::uint8_t* const data = bytes.data();
  for (std::size_t i = 0; i < bytes.size();) {
    std::size_t length = 0, from = 0;
    if (i + kShortest <= bytes.size()) {
      const std::uint32_t here = fourBytes(data + i);
      std::uint32_t& place = last[here * 2654435761u >> (32 - kHashBits)];
      from = place;
      place = static_cast<std::uint32_t>(i);
      if (from != kNowhere && i - from <= kWindow && fourBytes(data + from) == here) {
        const std::size_t most = std::min(kLongest, bytes.size() - i);
        length = kShortest;
        while (length < most && data[from + length] == data[i + length]) ++length;
      }
    }
    if (length == 0) {
      bits.put(tables.literals[data[i++]]);
      continue;
    }
    bits.put(tables.lengths[length]);
    bits.put(distanceCode(static_cast<std::uint32_t>(i - from)));
    i += length;
  }
  bits.put(symbolCode(256));
  char* at = bits.finish();
  const std::uint32_t sum = adler32(bytes);
  for (const unsigned shift : {24u, 16u, 8u, 0u}) *at++ = static_cast<char>(sum >> shift & 0xff);
  out.resize(static_cast<std::size_t>(at - out.data()));
  return out;
}

}  // namespace weft::assets
