// A zlib stream (RFC 1950 and 1951), made fast: fixed codes, and of earlier places with the same four bytes only the last one is
// tried. Does not: look for the smallest stream.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace weft::assets {

std::string deflateFast(std::span<const std::uint8_t> bytes);

}  // namespace weft::assets
