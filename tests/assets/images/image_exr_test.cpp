// The kinds of .exr that others write: half floats, every compression, tiles, parts, windows, subsets of channels.
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfTiledOutputPart.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

#include "engine/assets/images/image.h"

using namespace weft;
using namespace weft::assets;

namespace {

constexpr int kWidth = 70, kHeight = 41;

float valueAt(int x, int y, int c) {
  return static_cast<float>(x + 100 * c) + static_cast<float>(y) / 64.0f;
}

using Names = std::vector<std::string>;

// Parts whose channel `names[c]` holds valueAt(x, y, c), as half floats. Written by the library that reads them: what is judged
// here is which channels become which, and that nothing of a kind is refused. The bytes are judged by hand below.
std::string encode(const std::vector<Names>& parts, int compression, bool tiled) {
  std::vector<Imf::Header> headers;
  for (const Names& names : parts) {
    Imf::Header header(kWidth, kHeight);
    header.compression() = static_cast<Imf::Compression>(compression);
    header.setName(std::to_string(headers.size()));
    header.setType(tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    if (tiled) header.setTileDescription({32, 16, Imf::MIPMAP_LEVELS});
    for (const std::string& name : names) header.channels().insert(name, Imf::Channel(Imf::HALF));
    headers.push_back(header);
  }
  Imf::StdOSStream stream;
  {
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t p = 0; p < parts.size(); ++p) {
      std::vector<std::vector<std::uint16_t>> planes(parts[p].size());
      Imf::FrameBuffer buffer;
      for (std::size_t c = 0; c < planes.size(); ++c) {
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x)
            planes[c].push_back(imath_float_to_half(valueAt(x, y, static_cast<int>(c))));
        buffer.insert(parts[p][c],
                      Imf::Slice(Imf::HALF, reinterpret_cast<char*>(planes[c].data()), 2, 2 * kWidth));
      }
      if (tiled) {
        Imf::TiledOutputPart part(file, static_cast<int>(p));
        part.setFrameBuffer(buffer);
        for (int level = 0; level < part.numLevels(); ++level)  // the smaller ones hold anything
          part.writeTiles(0, part.numXTiles(level) - 1, 0, part.numYTiles(level) - 1, level);
      } else {
        Imf::OutputPart part(file, static_cast<int>(p));
        part.setFrameBuffer(buffer);
        part.writePixels(kHeight);
      }
    }
  }
  return stream.str();
}

std::string encode(const Names& names, int compression, bool tiled) {
  return encode(std::vector<Names>{names}, compression, tiled);
}

// The same of channels with names of one letter.
std::string encode(const char* letters, int compression, bool tiled) {
  std::vector<std::string> names;
  for (const char letter : std::string_view(letters)) names.emplace_back(1, letter);
  return encode(names, compression, tiled);
}

int countWrong(const ImageF& image, const std::array<int, 4>& channels) {
  int wrong = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (std::size_t c = 0; c < 4; ++c) {
        const float expected =
            channels[c] < 0 ? 1.0f : imath_half_to_float(imath_float_to_half(valueAt(x, y, channels[c])));
        wrong += image.texels[static_cast<std::size_t>(y * kWidth + x) * 4 + c] != expected;
      }
  return wrong;
}

}  // namespace

TEST_CASE("half floats in every compression, as scan lines and as tiles") {
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
    for (const bool tiled : {false, true}) {
      CAPTURE(compression);
      CAPTURE(tiled);
      text::Diagnostics diagnostics;
      const auto image = decodeImage(encode("ABGR", compression, tiled), "a.exr", diagnostics);
      REQUIRE_MESSAGE(image, diagnostics.text());
      REQUIRE(image->width == kWidth);
      REQUIRE(image->height == kHeight);
      if (compression <= Imf::PXR24_COMPRESSION) {
        CHECK(countWrong(*image, {3, 2, 1, 0}) == 0);
        continue;
      }
      double error = 0, sum = 0;  // B44 and DWA lose some
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          for (int c = 0; c < 3; ++c) {
            const double value = valueAt(x, y, 3 - c);
            error += std::abs(
                static_cast<double>(image->texels[static_cast<std::size_t>((y * kWidth + x) * 4 + c)]) -
                value);
            sum += value;
          }
      CHECK(error < 0.02 * sum);
    }
}

TEST_CASE("of several parts the first with colors is the picture, else the first that is gray") {
  text::Diagnostics diagnostics;
  const auto wrong = [&](const std::vector<Names>& parts, const std::array<int, 4>& channels) {
    const auto image = decodeImage(encode(parts, Imf::ZIP_COMPRESSION, false), "a.exr", diagnostics);
    return image ? countWrong(*image, channels) : -1;
  };
  CHECK(wrong({{"Z"}, {"A", "B", "G", "R"}, {"R", "G", "B"}}, {3, 2, 1, 0}) == 0);
  CHECK(wrong({{"Z"}, {"X", "Z"}}, {0, 0, 0, -1}) == 0);
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
}

namespace {

// A file from the definition ("OpenEXR File Layout", openexr.com): uncompressed scan lines of three floats, in either order. The
// texel at (x, y) of the plane that the windows are on holds valueAt(x, y, c).
std::string encodeByHand(std::array<int, 4> data, std::array<int, 4> display, bool bottomFirst) {
  std::string bytes;
  const auto number = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto attribute = [&](const char* name, const char* type, const std::string& value) {
    bytes.append(name).append(1, '\0').append(type).append(1, '\0');
    number(static_cast<std::int32_t>(value.size()));
    bytes += value;
  };
  const auto bytesOf = [](const auto& value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  number(20000630);
  number(2);
  std::string channels;
  for (const char name : {'B', 'G', 'R'})
    channels += std::string(1, name) + '\0' + bytesOf(2) + std::string(4, '\0') + bytesOf(1) + bytesOf(1);
  attribute("channels", "chlist", channels + '\0');
  attribute("comments", "string", "");
  attribute("compression", "compression", std::string(1, '\0'));
  attribute("dataWindow", "box2i", bytesOf(data));
  attribute("displayWindow", "box2i", bytesOf(display));
  attribute("lineOrder", "lineOrder", std::string(1, bottomFirst ? '\1' : '\0'));
  attribute("pixelAspectRatio", "float", bytesOf(1.0f));
  attribute("screenWindowCenter", "v2f", std::string(8, '\0'));
  attribute("screenWindowWidth", "float", bytesOf(1.0f));
  bytes += '\0';
  const int width = data[2] - data[0] + 1, height = data[3] - data[1] + 1;
  const std::size_t line = 8 + 12 * static_cast<std::size_t>(width),
                    first = bytes.size() + 8 * static_cast<std::size_t>(height);
  const auto positionOf = [&](int row) {
    return static_cast<std::size_t>(bottomFirst ? height - 1 - row : row);
  };
  for (int row = 0; row < height; ++row) number(static_cast<std::uint64_t>(first + line * positionOf(row)));
  for (int i = 0; i < height; ++i) {
    const int y = data[1] + static_cast<int>(positionOf(i));
    number(y);
    number(12 * width);
    for (int c = 2; c >= 0; --c)
      for (int x = data[0]; x <= data[2]; ++x) number(valueAt(x, y, c));
  }
  return bytes;
}

}  // namespace

TEST_CASE(
    "the display window is the picture, in either order of lines: cut, or transparent where there is no "
    "data") {
  const std::array<int, 4> display = {-2, 3, 13, 10};
  using Window = std::array<int, 4>;
  for (const Window& data :
       {display, Window{1, 4, 8, 8}, Window{-4, 1, 15, 12}, Window{5, 0, 40, 6}, Window{20, 20, 21, 21}})
    for (const bool bottomFirst : {false, true}) {
      CAPTURE(data[0]);
      CAPTURE(bottomFirst);
      text::Diagnostics diagnostics;
      const auto image = decodeImage(encodeByHand(data, display, bottomFirst), "a.exr", diagnostics);
      REQUIRE_MESSAGE(image, diagnostics.text());
      // What shows nothing is read, as a frame of a sequence may be empty, but not in silence.
      CHECK(diagnostics.contains(text::Code::badImageSize) == (data[0] == 20));
      REQUIRE(image->width == 16);
      REQUIRE(image->height == 8);
      int wrong = 0;
      for (int y = display[1]; y <= display[3]; ++y)
        for (int x = display[0]; x <= display[2]; ++x) {
          const float* texel =
              &image->texels[static_cast<std::size_t>((y - display[1]) * 16 + x - display[0]) * 4];
          const bool there = x >= data[0] && x <= data[2] && y >= data[1] && y <= data[3];
          for (int c = 0; c < 3; ++c) wrong += texel[c] != (there ? valueAt(x, y, c) : 0.0f);
          wrong += texel[3] != (there ? 1.0f : 0.0f);
        }
      CHECK(wrong == 0);
    }
}

TEST_CASE("luminance and chroma become colors") {
  Imf::StdOSStream stream;
  std::vector<Imf::Rgba> colors(64 * 32, Imf::Rgba(0.75f, 0.5f, 0.25f, 1));
  {
    Imf::RgbaOutputFile file(stream, Imf::Header(64, 32), Imf::WRITE_YC);
    file.setFrameBuffer(colors.data(), 1, 64);
    file.writePixels(32);
  }
  text::Diagnostics diagnostics;
  const auto image = decodeImage(stream.str(), "a.exr", diagnostics);
  REQUIRE_MESSAGE(image, diagnostics.text());
  for (std::size_t i = 0; i < image->texels.size(); i += 4) {
    REQUIRE(image->texels[i] == doctest::Approx(0.75).epsilon(0.01));
    REQUIRE(image->texels[i + 1] == doctest::Approx(0.5).epsilon(0.01));
    REQUIRE(image->texels[i + 2] == doctest::Approx(0.25).epsilon(0.01));
  }
}

TEST_CASE("files with random bytes changed, in every compression") {
  const char* seed = std::getenv("WEFT_FUZZ_SEED");
  std::mt19937 random(seed ? static_cast<std::uint32_t>(std::atoi(seed)) : 9u);
  int images = 0, refused = 0;
  for (int kind = 0; kind < 2 * Imf::NUM_COMPRESSION_METHODS; ++kind) {
    const std::string sound = encode("ABGR", kind / 2, kind % 2 == 1);
    for (int i = 0; i < 50; ++i) {
      std::string bytes = sound;
      for (std::size_t k = 0, changes = 1 + random() % 8; k < changes; ++k)
        bytes[random() % (random() % 2 ? bytes.size() : 400)] =
            static_cast<char>(random() % 4 ? random() : 0xff * (random() % 2));
      text::Diagnostics diagnostics;
      const auto image = decodeImage(bytes, "a.exr", diagnostics);
      REQUIRE(image.has_value() == !diagnostics.hasErrors());
      ++(image ? images : refused);
    }
  }
  MESSAGE(images << " images, " << refused << " refused");
  CHECK(images > 0);
  CHECK(refused > 0);
}

TEST_CASE("RGB gets alpha 1, one channel is gray, and a file without color is refused") {
  text::Diagnostics diagnostics;
  CHECK(countWrong(*decodeImage(encode("BGR", Imf::ZIP_COMPRESSION, false), "a.exr", diagnostics),
                   {2, 1, 0, -1}) == 0);
  CHECK(countWrong(*decodeImage(encode("Z", Imf::ZIP_COMPRESSION, false), "a.exr", diagnostics),
                   {0, 0, 0, -1}) == 0);
  CHECK(diagnostics.empty());
  CHECK_FALSE(decodeImage(encode("XZ", Imf::ZIP_COMPRESSION, false), "a.exr", diagnostics));
  CHECK_FALSE(decodeImage(encode("A", Imf::ZIP_COMPRESSION, false), "a.exr", diagnostics));
  CHECK(diagnostics.errorCount() == 2);
}

TEST_CASE(
    "the picture itself is read, whatever layers stand beside it, and no choice is made between layers") {
  text::Diagnostics diagnostics;
  const auto wrong = [&](const std::vector<std::string>& names, const std::array<int, 4>& channels) {
    CAPTURE(names.size());
    const auto image = decodeImage(encode(names, Imf::ZIP_COMPRESSION, false), "a.exr", diagnostics);
    return image ? countWrong(*image, channels) : -1;
  };
  CHECK(wrong({"B", "G", "R", "albedo.B", "albedo.G", "albedo.R", "depth.Z"}, {2, 1, 0, -1}) == 0);
  CHECK(wrong({"A", "B", "G", "R", "Albedo.A", "Albedo.R"}, {3, 2, 1, 0}) == 0);
  CHECK(wrong({"View.Combined.A", "View.Combined.B", "View.Combined.G", "View.Combined.R", "View.Depth.Z"},
              {3, 2, 1, 0}) == 0);
  CHECK(wrong({"A", "Y"}, {1, 1, 1, 0}) == 0);
  CHECK(wrong({"Y", "Z"}, {0, 0, 0, -1}) == 0);
  CHECK(diagnostics.empty());
  CHECK(wrong({"albedo.B", "albedo.G", "albedo.R", "light.B", "light.G", "light.R"}, {}) == -1);
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].message ==
        "cannot read image 'a.exr': it has several layers ('albedo', 'light') and no picture of its own; "
        "save one "
        "of them as a file");
  CHECK(wrong({"albedo.G", "albedo.R", "light.B"}, {}) == -1);  // no layer is whole
  CHECK(wrong({"X", "Y", "Z"}, {}) == -1);
  CHECK(diagnostics.errorCount() == 3);
}
