#include "engine/assets/images/image.h"

#include <doctest/doctest.h>
#include <webp/encode.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/assets/images/save_hdr.h"
#include "tests/load_image.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::assets;

static ImageF makeRamp(int width, int height, int channels) {
  ImageF image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i) image.texels.push_back(static_cast<float>(i) * 0.125f);
  return image;
}

static std::string webpOf(const std::vector<std::uint8_t>& texels, int width, int height, int channels) {
  std::uint8_t* encoded = nullptr;
  const auto encode = channels == 4 ? WebPEncodeLosslessRGBA : WebPEncodeLosslessRGB;
  const std::size_t size = encode(texels.data(), width, height, width * channels, &encoded);
  REQUIRE(size > 0);
  std::string bytes(reinterpret_cast<const char*>(encoded), size);
  WebPFree(encoded);
  return bytes;
}

static std::string sizeOf(std::size_t size) {
  return {static_cast<char>(size), static_cast<char>(size >> 8), '\0', '\0'};
}

// A simple .webp in the extended format: with these flags, and chunks behind its picture. developers.google.com/speed/webp/docs/riff_container
static std::string extended(const std::string& simple, int width, int height, char flags,
                            const std::string& chunks) {
  const std::string picture = simple.substr(12), body = "WEBPVP8X" + sizeOf(10) + flags +
                                                        std::string(3, '\0') + static_cast<char>(width - 1) +
                                                        std::string(2, '\0') + static_cast<char>(height - 1) +
                                                        std::string(2, '\0') + picture + chunks;
  return "RIFF" + sizeOf(body.size()) + body;
}

TEST_CASE("PNG bytes come back as they were, for every channel count, top row first") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  for (int channels = 1; channels <= 4; ++channels) {
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < 5 * 3 * channels; ++i) texels.push_back(static_cast<std::uint8_t>(i * 37 + 11));
    REQUIRE(savePng8(folder.at("a.png"), 5, 3, channels, texels, diagnostics));
    const auto image = loadImage8(folder.at("a.png"), 0, diagnostics);
    REQUIRE(image);
    CHECK(image->width == 5);
    CHECK(image->height == 3);
    CHECK(image->channels == channels);
    CHECK(image->texels == texels);
  }
  CHECK(loadImage8(folder.at("a.png"), 3, diagnostics)->channels == 3);
  CHECK(diagnostics.empty());
}

TEST_CASE("PNG: the one gray of tRNS is transparent, in every depth") {
  // "Portable Network Graphics", 11.3.2.1. Two texels, 0 and the largest number, of which the second is named.
  const TemporaryFolder folder;
  for (const int bits : {1, 2, 4, 8, 16}) {
    CAPTURE(bits);
    const int most = (1 << bits) - 1;
    std::string row(1, '\0');  // no filter
    if (bits == 16)
      row += std::string("\0\0\xff\xff", 4);
    else
      row += bits == 8 ? std::string("\0\xff", 2) : std::string(1, static_cast<char>(most << (8 - 2 * bits)));
    const auto count = static_cast<char>(row.size());
    const std::string stream = std::string("\x78\x01\x01", 3) + count + '\0' + static_cast<char>(~count) +
                               '\xff' + row + std::string(4, '\0');
    const auto chunk = [](const std::string& name, const std::string& data) {
      return std::string(3, '\0') + static_cast<char>(data.size()) + name + data + std::string(4, '\0');
    };
    const std::string header =
        std::string("\0\0\0\2\0\0\0\1", 8) + static_cast<char>(bits) + std::string(4, '\0');
    const std::string key{static_cast<char>(most >> 8), static_cast<char>(most)};
    text::Diagnostics diagnostics;
    const auto image =
        loadImage8(folder.write("a.png", "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("tRNS", key) +
                                             chunk("IDAT", stream) + chunk("IEND", "")),
                   4, diagnostics);
    REQUIRE_MESSAGE(image, diagnostics.text());
    CHECK(image->texels == std::vector<std::uint8_t>{0, 0, 0, 255, 255, 255, 255, 0});
  }
}

TEST_CASE("WebP: texels as they were, in as many channels as are asked for") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const std::vector<std::uint8_t> clear = {10, 20, 30, 255, 200, 100, 50, 128},
                                  solid = {10, 20, 30, 200, 100, 50};
  folder.write("clear.webp", webpOf(clear, 2, 1, 4));
  folder.write("solid.WEBP", webpOf(solid, 2, 1, 3));
  const auto texelsOf = [&](const char* name, int channels) {
    const auto image = loadImage8(folder.at(name), channels, diagnostics);
    REQUIRE_MESSAGE(image, diagnostics.text());
    return image->texels;
  };
  CHECK(texelsOf("clear.webp", 0) == clear);
  CHECK(texelsOf("solid.WEBP", 0) == solid);
  CHECK(texelsOf("clear.webp", 3) == solid);
  CHECK(texelsOf("solid.WEBP", 4) == std::vector<std::uint8_t>{10, 20, 30, 255, 200, 100, 50, 255});
  // What stb_image makes of the same colors.
  REQUIRE(savePng8(folder.at("clear.png"), 2, 1, 4, clear, diagnostics));
  for (const int channels : {1, 2})
    CHECK(texelsOf("clear.webp", channels) == texelsOf("clear.png", channels));
  const auto light = loadImage(folder.at("clear.webp"), diagnostics);
  REQUIRE(light);
  CHECK(light->texels[4] == doctest::Approx(0.577580).epsilon(1e-5));
  CHECK(light->texels[7] == doctest::Approx(128 / 255.0));
  CHECK(diagnostics.empty());

  const std::string whole = webpOf(clear, 2, 1, 4);
  for (std::size_t size = 0; size < whole.size() - 1; ++size)
    CHECK_FALSE(loadImage8(folder.write("cut.webp", whole.substr(0, size)), 4, diagnostics));
  text::Diagnostics moving;
  CHECK_FALSE(loadHeader(folder.write("moving.webp", extended(whole, 2, 1, '\x2', "")), moving));
  CHECK(moving.text().find("moves") != std::string::npos);
}

TEST_CASE("a PNG as floats is decoded from sRGB, its alpha is not") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const std::vector<std::uint8_t> texels = {0, 10, 188, 128, 255, 255, 255, 255};
  REQUIRE(savePng8(folder.at("a.PNG"), 2, 1, 4, texels, diagnostics));
  const auto image = loadImage(folder.at("a.PNG"), diagnostics);
  REQUIRE(image);
  CHECK(image->texels[0] == 0);
  CHECK(image->texels[1] == doctest::Approx(10 / 255.0 / 12.92));
  CHECK(image->texels[2] == doctest::Approx(0.502886).epsilon(1e-5));
  CHECK(image->texels[3] == doctest::Approx(128 / 255.0));
  CHECK(image->texels[4] == 1);
}

TEST_CASE("EXR keeps floats exactly, for 1, 3 and 4 channels") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  for (const int channels : {1, 3, 4}) {
    const ImageF image = makeRamp(33, 17, channels);
    REQUIRE(saveExr(folder.at("a.exr"), image, diagnostics));
    const auto loaded = loadImage(folder.at("a.exr"), diagnostics);
    REQUIRE(loaded);
    REQUIRE(loaded->channels == 4);
    CHECK(loaded->width == 33);
    CHECK(loaded->height == 17);
    int wrong = 0;
    for (std::size_t i = 0; i < 33 * 17; ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        wrong += loaded->texels[i * 4 + c] !=
                 image.texels[i * static_cast<std::size_t>(channels) + (channels == 1 ? 0 : c)];
      wrong += loaded->texels[i * 4 + 3] != (channels == 4 ? image.texels[i * 4 + 3] : 1.0f);
    }
    CHECK(wrong == 0);
  }
  CHECK(diagnostics.empty());
}

TEST_CASE("Radiance keeps values to its 8-bit mantissa, narrow (flat) and wide (run-length) lines") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  for (const int width : {5, 64}) {
    const ImageF image = makeRamp(width, 9, 3);
    REQUIRE(saveHdr(folder.at("a.hdr"), image, diagnostics));
    const auto loaded = loadImage(folder.at("a.hdr"), diagnostics);
    REQUIRE(loaded);
    CHECK(loaded->channels == 3);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
      const float largest = image.texels[i / 3 * 3 + 2];
      CHECK(std::abs(loaded->texels[i] - image.texels[i]) <= largest / 128 + 1e-6f);
    }
  }
}

TEST_CASE("Radiance in all eight orientations, and with the run lengths of before 1991") {
  // Texel (x, y) of the upright picture, 3 x 2, is red x + 1 and green y + 1.
  const auto texel = [](int x, int y) {
    return std::string(
        {static_cast<char>(128 + x), static_cast<char>(128 + y), '\0', static_cast<char>(136)});
  };
  text::Diagnostics diagnostics;
  for (const char* size : {"-Y 2 +X 3", "-Y 2 -X 3", "+Y 2 +X 3", "+Y 2 -X 3", "+X 3 -Y 2", "-X 3 -Y 2",
                           "+X 3 +Y 2", "-X 3 +Y 2"}) {
    CAPTURE(size);
    std::string bytes = std::string("#?RGBE\n# made by hand\n\n") + size + "\n";
    // "Radiance File Formats": the first axis is the one of scanlines; -Y goes down, +X to the right.
    const bool columns = size[1] == 'X', turnedFirst = size[0] != (columns ? '+' : '-'),
               turnedSecond = size[5] != (columns ? '-' : '+');
    const int lines = columns ? 3 : 2, length = columns ? 2 : 3;
    for (int i = 0; i < lines; ++i)
      for (int j = 0; j < length; ++j) {
        const int first = turnedFirst ? lines - 1 - i : i, second = turnedSecond ? length - 1 - j : j;
        bytes += columns ? texel(first, second) : texel(second, first);
      }
    const auto image = decodeImage(bytes, "a.hdr", diagnostics);
    REQUIRE_MESSAGE(image, diagnostics.text());
    REQUIRE(image->width == 3);
    REQUIRE(image->height == 2);
    for (std::size_t i = 0; i < 6; ++i) {
      CHECK(image->texels[i * 3] == static_cast<float>(128 + i % 3));
      CHECK(image->texels[i * 3 + 1] == static_cast<float>(128 + i / 3));
    }
  }
  // 300 = 44 + 256 repeats.
  const std::string runs = texel(1, 2) + std::string("\1\1\1\54\1\1\1\1", 8) + texel(3, 4);
  const auto image = decodeImage("#?RADIANCE\n\n-Y 1 +X 302\n" + runs, "a.hdr", diagnostics);
  REQUIRE_MESSAGE(image, diagnostics.text());
  CHECK(image->texels[3 * 300] == 129.0f);
  CHECK(image->texels[3 * 301] == 131.0f);
}

TEST_CASE("Radiance: what EXPOSURE and COLORCORR multiplied in is taken out; XYZ becomes RGB") {
  text::Diagnostics diagnostics;
  const auto texelOf = [&](const std::string& header, const std::string& texel) {
    const auto image = decodeImage("#?RADIANCE\n" + header + "\n-Y 1 +X 1\n" + texel, "a.hdr", diagnostics);
    REQUIRE_MESSAGE(image, diagnostics.text());
    return image->texels;
  };
  const std::string twos("\x80\x80\x80\x82", 4);
  CHECK(texelOf("FORMAT=32-bit_rle_rgbe\n", twos) == std::vector<float>{2, 2, 2});
  CHECK(texelOf("EXPOSURE= 4\nEXPOSURE=0.25\nEXPOSURE=0.5\nCOLORCORR= 1 2 4\n", twos) ==
        std::vector<float>{4, 2, 1});
  // The white D65 of CIE 15 (0.9505, 1, 1.089), half as bright, in mantissas over 2^7.
  const std::vector<float> white = texelOf("FORMAT=32-bit_rle_xyze\n", std::string("\x7a\x80\x8b\x80", 4));
  for (const float c : white) CHECK(c == doctest::Approx(0.5).epsilon(0.01));
  // The red of BT.709 under D65 (0.4124, 0.2126, 0.0193), in mantissas over 2^9.
  const std::vector<float> red = texelOf("FORMAT=32-bit_rle_xyze\n", std::string("\xd3\x6d\x0a\x7f", 4));
  for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(red[c] - (c == 0 ? 1.0f : 0.0f)) < 0.005f);
  for (const char* wrong : {"EXPOSURE=0\n", "EXPOSURE=x\n", "COLORCORR=1 1\n", "FORMAT=32-bit_rle_lab\n"})
    CHECK_FALSE(decodeImage(std::string("#?RADIANCE\n") + wrong + "\n-Y 1 +X 1\nabcd", "a.hdr", diagnostics));
}

TEST_CASE("a .jpg, a .png and a .webp stand upright, as their Exif orientation says") {
  const TemporaryFolder folder;
  // Exif 2.3, table of tag 0x0112: where the first row and the first column as stored are seen.
  struct Seen {
    bool columns, fromRight,
        fromBottom;  // the first row is seen as a column; as seen, the first texel is at the right, the bottom
  };
  const Seen seen[8] = {{false, false, false}, {false, true, false}, {false, true, true},
                        {false, false, true},  {true, false, false}, {true, true, false},
                        {true, true, true},    {true, false, true}};
  constexpr int kWide = 32,
                kHigh = 16;  // as stored: the first quarter white, the rest of the first half row red
  std::vector<std::uint8_t> texels(kWide * kHigh * 3, 0);
  for (int y = 0; y < kHigh / 2; ++y)
    for (int x = 0; x < kWide; ++x)
      for (int c = 0; c < 3; ++c)
        texels[static_cast<std::size_t>((y * kWide + x) * 3 + c)] = x < kWide / 2 || c == 0 ? 255 : 0;
  std::string jpeg;
  stbi_write_jpg_to_func(
      [](void* out, void* data, int count) {
        static_cast<std::string*>(out)->append(static_cast<char*>(data), static_cast<std::size_t>(count));
      },
      &jpeg, kWide, kHigh, 3, texels.data(), 95);
  const std::string png = encodePng8(kWide, kHigh, 3, texels), webp = webpOf(texels, kWide, kHigh, 3);
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const char value = static_cast<char>(orientation);
    const std::string big =
        std::string("MM\0\x2a\0\0\0\x8\0\x1\x1\x12\0\x3\0\0\0\x1\0", 19) + value + std::string(6, '\0');
    const std::string little =
        std::string("II\x2a\0\x8\0\0\0\x1\0\x12\x1\x3\0\x1\0\0\0", 18) + value + std::string(7, '\0');
    const std::string inJpeg = jpeg.substr(0, 2) + std::string("\xff\xe1\0\x22", 4) +
                               std::string("Exif\0\0", 6) + big + jpeg.substr(2);
    const std::string inPng = png.substr(0, 33) + std::string("\0\0\0\x1a", 4) + "eXIf" + little +
                              std::string(4, '\0') + png.substr(33);
    const std::string inWebp = extended(webp, kWide, kHigh, '\x8', "EXIF" + sizeOf(26) + little);
    for (const auto& [name, bytes] : {std::pair{"a.jpg", inJpeg}, {"a.png", inPng}, {"a.webp", inWebp}}) {
      CAPTURE(name);
      CAPTURE(orientation);
      text::Diagnostics diagnostics;
      const std::string path = folder.write(name, bytes);
      const auto image = loadImage8(path, 3, diagnostics);
      REQUIRE_MESSAGE(image, diagnostics.text());
      const Seen& want = seen[orientation - 1];
      REQUIRE(image->width == (want.columns ? kHigh : kWide));
      REQUIRE(image->height == (want.columns ? kWide : kHigh));
      const auto header = loadHeader(path, diagnostics);
      REQUIRE(header);
      CHECK(header->width == image->width);
      const auto colorAt = [&](bool right, bool bottom) {
        const int x = image->width * (right ? 3 : 1) / 4, y = image->height * (bottom ? 3 : 1) / 4;
        const std::uint8_t* color = &image->texels[static_cast<std::size_t>((y * image->width + x) * 3)];
        return color[0] < 128 ? 'k' : color[1] < 128 ? 'r' : 'w';
      };
      CHECK(colorAt(want.fromRight, want.fromBottom) == 'w');
      // The other half of the first row lies along it.
      CHECK(colorAt(want.columns ? want.fromRight : !want.fromRight,
                    want.columns ? !want.fromBottom : want.fromBottom) == 'r');
    }
  }
}

TEST_CASE("an environment becomes RGBA, finite and non-negative, and says how much was replaced") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  ImageF image = makeRamp(4, 2, 3);
  image.texels[0] = nan;
  image.texels[1] = -1;
  image.texels[2] = -infinity;
  image.texels[3] = infinity;
  image.texels[5] = kHalfMax;
  image.texels[7] = 70000;
  REQUIRE(saveExr(folder.at("a.exr"), image, diagnostics));
  const auto environment = loadEnvironment(folder.at("a.exr"), diagnostics);
  REQUIRE(environment);
  REQUIRE(environment->channels == 4);
  CHECK(environment->texels[0] == 0);
  CHECK(environment->texels[1] == 0);
  CHECK(environment->texels[2] == 0);
  CHECK(environment->texels[3] == 1);
  CHECK(environment->texels[4] == kHalfMax);
  CHECK(environment->texels[5] == 0.5f);
  CHECK(environment->texels[6] == kHalfMax);
  CHECK(environment->texels[9] == kHalfMax);
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == text::Code::texelsReplaced);
  CHECK(diagnostics.items()[0].message ==
        "5 of 24 color values are no radiance and were replaced");  // 4x2 of RGB
  CHECK_FALSE(diagnostics.hasErrors());
  CHECK(diagnostics.items()[0].found.find("1 not a number, 2 negative") != std::string::npos);
  CHECK(diagnostics.items()[0].found.find("1 infinite (now 65504), 1 above the range") != std::string::npos);

  // A sun beyond the halves alone is no more than a note.
  CHECK(diagnostics.items()[0].severity == text::Severity::warning);
  diagnostics.clear();
  image = makeRamp(4, 2, 3);
  image.texels[4] = 1e6f;
  REQUIRE(saveExr(folder.at("sun.exr"), image, diagnostics));
  CHECK(loadEnvironment(folder.at("sun.exr"), diagnostics));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == text::Code::texelsReplaced);
  CHECK(diagnostics.items()[0].severity == text::Severity::note);

  // Colors of a screen are decoded, and said to be no radiance.
  diagnostics.clear();
  const std::uint8_t gray[] = {0, 128, 255, 188, 188, 188};
  REQUIRE(savePng8(folder.at("photo.png"), 2, 1, 3, gray, diagnostics));
  const auto photo = loadEnvironment(folder.at("photo.png"), diagnostics);
  REQUIRE(photo);
  CHECK(photo->texels[0] == 0);
  CHECK(photo->texels[1] == doctest::Approx(std::pow((128 / 255.0 + 0.055) / 1.055, 2.4)));
  CHECK(photo->texels[2] == 1);
  CHECK(photo->texels[3] == 1);
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == text::Code::displayReferred);
  CHECK(diagnostics.items()[0].severity == text::Severity::warning);

  diagnostics.clear();
  REQUIRE(saveHdr(folder.at("clean.hdr"), makeRamp(16, 8, 3), diagnostics));
  CHECK(loadEnvironment(folder.at("clean.hdr"), diagnostics));
  CHECK(diagnostics.empty());
}

namespace {

double lightOf(const ImageF& map, int channel) {
  double sum = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      sum += map.texels[static_cast<std::size_t>((y * map.width + x) * map.channels + channel)] *
             std::sin((y + 0.5) * std::numbers::pi / map.height);
  return sum;
}

}  // namespace

TEST_CASE("a sun beyond half floats keeps its light and its color, and what finds no room is told") {
  ImageF map{64, 32, 3, std::vector<float>(64 * 32 * 3, 0.5f)};
  float* sun = &map.texels[static_cast<std::size_t>(9 * 64 * 3)];  // at the seam of the map
  sun[0] = 400000;
  sun[1] = 300000;
  sun[2] = 100000;
  const ImageF before = map;
  text::Diagnostics diagnostics;
  sanitizeRadiance(map, "sun", diagnostics);
  for (int c = 0; c < 3; ++c) CHECK(lightOf(map, c) == doctest::Approx(lightOf(before, c)).epsilon(1e-4));
  CHECK(*std::max_element(map.texels.begin(), map.texels.end()) <= kHalfMax);
  CHECK(map.texels[(9 * 64 + 5) * 3] == 0.5f);             // no further than it must
  CHECK(map.texels[(9 * 64 + 63) * 3] > 1000);             // across the seam
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());  // nothing is lost, and nothing told

  // No room: everything is too bright.
  ImageF white{8, 4, 3, std::vector<float>(8 * 4 * 3, 131008.0f)};
  diagnostics.clear();
  sanitizeRadiance(white, "white", diagnostics);
  for (const float value : white.texels) CHECK(value == kHalfMax);
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].found.find("50 % of the map's is lost") != std::string::npos);
}

TEST_CASE("an output that cannot be written is W180") {
  text::Diagnostics diagnostics;
  const std::vector<std::uint8_t> texels(3);
  CHECK_FALSE(savePng8("/no_such_folder/a.png", 1, 1, 3, texels, diagnostics));
  CHECK_FALSE(saveExr("/no_such_folder/a.exr", makeRamp(1, 1, 3), diagnostics));
  CHECK_FALSE(saveHdr("/no_such_folder/a.hdr", makeRamp(1, 1, 3), diagnostics));
  CHECK(diagnostics.errorCount() == 3);
  for (const text::Diagnostic& d : diagnostics.items()) CHECK(d.code == text::Code::outputNotWritten);
}

TEST_CASE("the real environment loads clean") {
  const std::string path = WEFT_SOURCE_DIR "/scenes/environments/spiaggia_di_mondello_1k.hdr";
  text::Diagnostics diagnostics;
  const auto environment = loadEnvironment(path, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(environment);
  CHECK_FALSE(diagnostics.hasErrors());
  CHECK(environment->width == 1024);
  CHECK(environment->height == 512);
  double top = 0, bottom = 0;  // sky over sea: the sky is the brighter half
  for (std::size_t i = 0; i < 1024 * 256; ++i) {
    top += environment->texels[i * 4 + 1];
    bottom += environment->texels[(1024 * 256 + i) * 4 + 1];
  }
  CHECK(top > bottom);
}
