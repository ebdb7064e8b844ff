// .hdr, Radiance pictures. Ward, "Real Pixels", Graphics Gems II, 1991, and "Radiance File Formats" (radsite.lbl.gov): a text
// header, an empty line, a resolution line, then scanlines of four bytes a texel, plain or run-length encoded. Declared in
// image_codecs.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "engine/assets/images/image_codecs.h"
#include "engine/text/chars.h"

namespace weft::assets {

using text::Diagnostics;

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

struct HdrHeader {
  bool xyz = false;
  std::array<float, 3> gain{1, 1, 1};  // what makes radiance of the values
  // Scanlines are along the second axis: their number, and texels in each.
  bool columns = false;                              // the first axis is X
  bool flippedFirst = false, flippedSecond = false;  // against top to bottom, or left to right
  std::size_t lines = 0, length = 0;
  std::string problem{};

  std::size_t width() const { return columns ? lines : length; }
  std::size_t height() const { return columns ? length : lines; }
};

// "-Y 512", of the axes of the resolution line. False for anything else.
bool takeAxis(std::string_view& line, char& axis, bool& flipped, std::size_t& size) {
  const std::string_view sign = text::takeWord(line), digits = text::takeWord(line);
  const auto number = text::numberIn<std::size_t>(digits);
  if (sign.size() != 2 || (sign[0] != '+' && sign[0] != '-') || !number) return false;
  axis = sign[1];
  flipped = (sign[0] == '-') != (axis == 'Y');
  size = *number;
  return axis == 'X' || axis == 'Y';
}

// Moves `bytes` to the first scanline.
HdrHeader readHeaderLines(std::string_view& bytes) {
  HdrHeader header;
  const auto fails = [&](std::string problem) {
    header.problem = std::move(problem);
    return header;
  };
  if (!bytes.starts_with("#?")) return fails("it does not begin as a Radiance picture (#?RADIANCE)");
  for (;;) {
    if (bytes.find('\n') == bytes.npos) return fails("the header has no end");
    std::string_view line = text::takeLine(bytes);
    if (line.empty()) break;
    const std::size_t equal = line.find('=');
    if (line[0] == '#' || equal == line.npos) continue;  // a comment, or the command that made it
    const std::string_view key = line.substr(0, equal);
    std::string_view values = line.substr(equal + 1);
    if (key == "FORMAT") {
      const std::string_view format = text::takeWord(values);
      header.xyz = format == "32-bit_rle_xyze";
      if (!header.xyz && format != "32-bit_rle_rgbe") return fails(fmt::format("its format is '{}'", format));
    } else if (key == "EXPOSURE" || key == "COLORCORR") {  // each time multiplied into the values
      float number = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        if (c == 0 || key == "COLORCORR") number = text::numberIn<float>(text::takeWord(values)).value_or(0);
        if (!(number > 0)) return fails(fmt::format("{} needs numbers over 0", key));
        header.gain[c] /= number;
      }
    }
  }
  if (bytes.find('\n') == bytes.npos) return fails("the resolution line is missing");
  std::string_view line = text::takeLine(bytes);
  char first = 0, second = 0;
  if (!takeAxis(line, first, header.flippedFirst, header.lines) ||
      !takeAxis(line, second, header.flippedSecond, header.length) || first == second)
    return fails("the resolution line is not '-Y height +X width', in any order and with any signs");
  header.columns = first == 'X';
  return header;
}

// Takes one scanline. What is wrong, or "".
std::string takeScanline(std::string_view& bytes, std::vector<Rgbe>& line) {
  const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  const std::size_t length = line.size();
  if (length >= 8 && length < 32768 && bytes.size() >= 4 && at(0) == 2 && at(1) == 2 && at(2) < 128) {
    if ((std::size_t{at(2)} << 8 | at(3)) != length) return "has a wrong header";
    bytes.remove_prefix(4);
    for (std::size_t plane = 0; plane < 4; ++plane)
      for (std::size_t done = 0; done < length;) {
        if (bytes.size() < 2) return "is cut off";
        const std::size_t code = at(0);
        const bool run = code > 128;
        const std::size_t count = run ? code - 128 : code;
        if (count == 0 || done + count > length) return "has a wrong run length";
        if (bytes.size() < (run ? 2 : 1 + count)) return "is cut off";
        for (std::size_t i = 0; i < count; ++i) line[done++][plane] = at(run ? 1 : 1 + i);
        bytes.remove_prefix(run ? 2 : 1 + count);
      }
    return "";
  }
  // Of before 1991: a texel of three ones repeats the one before it; several such in a row are digits of 8 bits, lowest first.
  std::size_t shift = 0;
  for (std::size_t done = 0; done < length;) {
    if (bytes.size() < 4) return "is cut off";
    const Rgbe texel = {at(0), at(1), at(2), at(3)};
    bytes.remove_prefix(4);
    if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
      line[done++] = texel;
      shift = 0;
      continue;
    }
    const std::size_t count = shift < 32 ? std::size_t{texel[3]} << shift : length + 1;
    if (done == 0 || done + count > length) return "has a wrong run length";
    for (std::size_t i = 0; i < count; ++i, ++done) line[done] = line[done - 1];
    shift += 8;
  }
  return "";
}

std::array<float, 3> toRadiance(const Rgbe& texel, const HdrHeader& header) {
  const float scale = texel[3] == 0 ? 0.0f : std::ldexp(1.0f, texel[3] - (128 + 8));
  std::array<float, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) c[i] = static_cast<float>(texel[i]) * scale;
  if (header.xyz)  // to the primaries and the white of ITU-R BT.709; what they cannot show is negative
    c = {3.2404542f * c[0] - 1.5371385f * c[1] - 0.4985314f * c[2],
         -0.9692660f * c[0] + 1.8760108f * c[1] + 0.0415560f * c[2],
         0.0556434f * c[0] - 0.2040259f * c[1] + 1.0572252f * c[2]};
  for (std::size_t i = 0; i < 3; ++i) c[i] = c[i] * header.gain[i];
  return c;
}

}  // namespace

std::optional<ImageF> readHdr(std::string_view bytes, const std::string& name, bool decodes,
                              Diagnostics& diagnostics) {
  const HdrHeader header = readHeaderLines(bytes);
  const std::size_t width = header.width(), height = header.height();
  const auto bounded = [](std::size_t size) {
    return static_cast<long long>(std::min<std::size_t>(size, kMaxImageSide + 1));
  };
  if (!header.problem.empty()) reportUnreadable(diagnostics, name, header.problem);
  if (!header.problem.empty() || !checkSize(diagnostics, name, bounded(width), bounded(height))) return {};
  ImageF image{static_cast<int>(width), static_cast<int>(height), 3, {}};
  if (decodes) image.texels.resize(width * height * 3);
  std::vector<Rgbe> line(header.length);
  for (std::size_t i = 0; i < header.lines; ++i) {
    if (const std::string problem = takeScanline(bytes, line); !problem.empty()) {
      reportUnreadable(diagnostics, name, fmt::format("line {} of {} {}", i + 1, header.lines, problem));
      return {};
    }
    const std::size_t first = header.flippedFirst ? header.lines - 1 - i : i;
    for (std::size_t j = 0; decodes && j < line.size(); ++j) {
      const std::size_t second = header.flippedSecond ? line.size() - 1 - j : j;
      const std::size_t texel = header.columns ? second * width + first : first * width + second;
      const std::array<float, 3> color = toRadiance(line[j], header);
      std::memcpy(&image.texels[texel * 3], color.data(), sizeof color);
    }
  }
  return image;
}

}  // namespace weft::assets
