#include "engine/assets/images/image_check.h"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <cstdint>

namespace weft::assets {

namespace {

std::uint8_t byteAt(std::string_view bytes, std::size_t i) {
  return static_cast<std::uint8_t>(bytes[i]);
}

std::string endsEarly(std::size_t line, std::size_t lines) {
  return fmt::format("the file ends in line {} of {}", line + 1, lines);
}

}  // namespace

// Ward, "Real Pixels", Graphics Gems II: text header, empty line, "-Y height +X width", then lines of four
// RLE planes.
std::string checkHdr(std::string_view bytes) {
  std::size_t at = bytes.find("\n\n");
  if (at == std::string_view::npos) return "the header has no end";
  at += 2;
  const std::size_t end = bytes.find('\n', at);
  if (end == std::string_view::npos) return "the resolution line is missing";
  const std::string_view line = bytes.substr(at, end - at);
  std::size_t width = 0, height = 0;
  const std::size_t x = line.find(" +X ");
  if (!line.starts_with("-Y ") || x == std::string_view::npos)
    return "the resolution line is not '-Y height +X width'";
  std::from_chars(line.data() + 3, line.data() + x, height);
  std::from_chars(line.data() + x + 4, line.data() + line.size(), width);
  at = end + 1;
  const auto isRle = [&] {
    return width >= 8 && width < 32768 && at + 4 <= bytes.size() && byteAt(bytes, at) == 2 &&
           byteAt(bytes, at + 1) == 2 && byteAt(bytes, at + 2) < 128;
  };
  if (!isRle()) {
    if (bytes.size() - at < width * height * 4) return endsEarly((bytes.size() - at) / (width * 4), height);
    return "";
  }
  for (std::size_t y = 0; y < height; ++y) {
    if (at + 4 > bytes.size()) return endsEarly(y, height);
    if (!isRle() || (std::size_t{byteAt(bytes, at + 2)} << 8 | byteAt(bytes, at + 3)) != width)
      return fmt::format("line {} of {} has a wrong header", y + 1, height);
    at += 4;
    for (int plane = 0; plane < 4; ++plane) {
      for (std::size_t done = 0; done < width;) {
        if (at + 2 > bytes.size()) return endsEarly(y, height);
        const std::size_t code = byteAt(bytes, at);
        const std::size_t run = code > 128 ? code - 128 : code;
        if (run == 0 || done + run > width)
          return fmt::format("line {} of {} has a wrong run length", y + 1, height);
        done += run;
        at += 1 + (code > 128 ? 1 : run);
      }
    }
    if (at > bytes.size()) return endsEarly(y, height);
  }
  return "";
}

bool isJpeg(std::string_view bytes) {
  const std::size_t at = bytes.find_first_not_of('\xff');
  return at != std::string_view::npos && at > 0 && bytes[at] == '\xd8';
}

// ITU T.81, annex B. Markers are taken exactly where stb_image takes them: any run of 0xff, then a byte that
// is neither 0 (stuffing) nor a restart. What lies between segments, entropy-coded data included, is skipped.
std::string checkJpeg(std::string_view bytes) {
  const std::string early = "the file ends before its end marker";
  const auto word = [&](std::size_t i) { return std::size_t{byteAt(bytes, i)} << 8 | byteAt(bytes, i + 1); };
  for (std::size_t at = bytes.find('\xd8') + 1;;) {
    at = bytes.find('\xff', at);
    if (at != std::string_view::npos) at = bytes.find_first_not_of('\xff', at);
    if (at == std::string_view::npos) return early;
    const std::uint8_t marker = byteAt(bytes, at++);
    if (marker == 0xd9) return "";
    if (marker == 0 || (marker >= 0xd0 && marker <= 0xd7)) continue;
    if (at + 2 > bytes.size()) return early;
    const std::size_t end = at + word(at);
    if (end > bytes.size()) return early;
    if (end < at + 2) return fmt::format("a segment at byte {} has no length", at);
    if (marker == 0xc4) {  // Huffman tables: class and id, 16 counts, that many values
      for (std::size_t table = at + 2; table < end;) {
        if (table + 17 > end) return fmt::format("a Huffman table at byte {} is cut off", table);
        std::size_t codes = 0;
        for (std::size_t i = 1; i <= 16; ++i) codes += byteAt(bytes, table + i);
        if (codes > 256)
          return fmt::format("a Huffman table at byte {} has {} codes, more than 256", table, codes);
        table += 17 + codes;
      }
    }
    at = end;
  }
}

// Truevision TGA 2.0: 18 bytes of header, id, colour map, then texels or run-length packets.
std::string checkTga(std::string_view bytes) {
  if (bytes.size() < 18) return "the file ends in its header";
  const auto word = [&](std::size_t i) {
    return static_cast<std::size_t>(byteAt(bytes, i) | byteAt(bytes, i + 1) << 8);
  };
  const std::size_t kind = byteAt(bytes, 2);
  const std::size_t width = word(12), height = word(14), texel = (std::size_t{byteAt(bytes, 16)} + 7) / 8;
  std::size_t at = 18 + byteAt(bytes, 0);
  if (byteAt(bytes, 1) == 1) at += word(5) * ((std::size_t{byteAt(bytes, 7)} + 7) / 8);
  const std::size_t texels = width * height;
  if (at > bytes.size()) return "the file ends before its texels";
  if (kind < 8)
    return bytes.size() - at < texels * texel ? endsEarly((bytes.size() - at) / (width * texel), height) : "";
  for (std::size_t done = 0; done < texels;) {
    if (at >= bytes.size()) return endsEarly(done / width, height);
    const std::size_t packet = byteAt(bytes, at), run = (packet & 127) + 1;
    at += 1 + texel * (packet >= 128 ? 1 : run);
    done += run;
    if (at > bytes.size()) return endsEarly(done / width, height);
  }
  return "";
}

}  // namespace weft::assets
