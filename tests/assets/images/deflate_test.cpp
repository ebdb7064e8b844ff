// Streams of deflateFast(), taken apart by stb's decoder.
#include "engine/assets/images/deflate.h"

#include <doctest/doctest.h>
#include <stb/stb_image.h>

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

using namespace weft::assets;

namespace {

bool comesBack(const std::vector<std::uint8_t>& bytes) {
  const std::string packed = deflateFast(bytes);
  int count = 0;
  char* unpacked = stbi_zlib_decode_malloc(packed.data(), static_cast<int>(packed.size()), &count);
  const bool same = unpacked && std::string(unpacked, static_cast<std::size_t>(count)) ==
                                    std::string(bytes.begin(), bytes.end());
  std::free(unpacked);
  // stb does not look at the checksum.
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  std::string sum;
  for (const std::uint32_t part : {b >> 8, b, a >> 8, a}) sum += static_cast<char>(part & 0xff);
  return same && packed.ends_with(sum);
}

}  // namespace

TEST_CASE("every length and many distances come back, and so do bytes without any order") {
  for (std::size_t count = 0; count < 600; ++count) CHECK(comesBack(std::vector<std::uint8_t>(count, 7)));
  std::mt19937 random(1);
  for (const std::size_t distance :
       {std::size_t{4}, std::size_t{5}, std::size_t{12}, std::size_t{257}, std::size_t{4097},
        std::size_t{24577}, std::size_t{32767}, std::size_t{32768}, std::size_t{32769}}) {
    CAPTURE(distance);
    std::vector<std::uint8_t> bytes(distance);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    for (std::size_t i = 0; i < 300; ++i) bytes.push_back(bytes[i]);
    CHECK(comesBack(bytes));
  }
  for (int round = 0; round < 300; ++round) {
    std::vector<std::uint8_t> bytes(random() % 50000);
    const std::uint32_t most = 1 + random() % 255;  // the fewer values, the more repeats
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = i > 100 && random() % 3 == 0 ? bytes[i - 1 - random() % 100]
                                              : static_cast<std::uint8_t>(random() % most);
    CHECK(comesBack(bytes));
  }
}

TEST_CASE("repeats take few bytes") {
  CHECK(deflateFast(std::vector<std::uint8_t>(100000)).size() < 1000);
}
