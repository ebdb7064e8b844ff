// The kinds of .exr that others write: half floats, every compression, subsets of channels.
#include <doctest/doctest.h>
#include <tinyexr.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>

#include "engine/assets/images/half.h"
#include "engine/assets/images/image.h"

using namespace weft;
using namespace weft::assets;

namespace {

constexpr int kWidth = 70, kHeight = 41;

float valueAt(int x, int y, int c) {
  return static_cast<float>(x + 100 * c) + static_cast<float>(y) / 64.0f;
}

// A picture whose channel `names[c]` holds valueAt(x, y, c), as half floats.
std::string encode(const std::vector<std::string>& names, int compression, bool tiled) {
  const int count = static_cast<int>(names.size());
  std::vector<std::vector<std::uint16_t>> planes(static_cast<std::size_t>(count));
  std::vector<EXRChannelInfo> infos(static_cast<std::size_t>(count));
  std::vector<int> types(static_cast<std::size_t>(count), TINYEXR_PIXELTYPE_HALF);
  std::vector<unsigned char*> pointers;
  const int step = 32;
  std::vector<std::vector<std::uint16_t>> tilePlanes;
  for (int c = 0; c < count; ++c) {
    infos[static_cast<std::size_t>(c)] = {};
    const std::string& name = names[static_cast<std::size_t>(c)];
    std::copy(name.begin(), name.end(), infos[static_cast<std::size_t>(c)].name);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        planes[static_cast<std::size_t>(c)].push_back(floatToHalf(valueAt(x, y, c)));
    pointers.push_back(reinterpret_cast<unsigned char*>(planes[static_cast<std::size_t>(c)].data()));
  }
  EXRHeader header;
  InitEXRHeader(&header);
  header.compression_type = compression;
  header.num_channels = count;
  header.channels = infos.data();
  header.pixel_types = types.data();
  header.requested_pixel_types = types.data();
  header.data_window = {0, 0, kWidth - 1, kHeight - 1};
  EXRImage image;
  InitEXRImage(&image);
  image.images = pointers.data();
  image.width = kWidth;
  image.height = kHeight;
  image.num_channels = count;
  std::vector<EXRTile> tiles;
  std::vector<std::vector<unsigned char*>> tilePointers;
  if (tiled) {
    header.tiled = 1;
    header.tile_size_x = header.tile_size_y = step;
    const int across = (kWidth + step - 1) / step, down = (kHeight + step - 1) / step;
    tilePlanes.reserve(static_cast<std::size_t>(across * down * count));
    tilePointers.resize(static_cast<std::size_t>(across * down));
    for (int ty = 0; ty < down; ++ty)
      for (int tx = 0; tx < across; ++tx) {
        EXRTile tile{};
        tile.offset_x = tx;
        tile.offset_y = ty;
        tile.width = std::min(step, kWidth - tx * step);
        tile.height = std::min(step, kHeight - ty * step);
        std::vector<unsigned char*>& here = tilePointers[tiles.size()];
        for (int c = 0; c < count; ++c) {
          std::vector<std::uint16_t>& plane = tilePlanes.emplace_back(static_cast<std::size_t>(step * step));
          for (int y = 0; y < tile.height; ++y)
            for (int x = 0; x < tile.width; ++x)
              plane[static_cast<std::size_t>(y * step + x)] =
                  floatToHalf(valueAt(tx * step + x, ty * step + y, c));
          here.push_back(reinterpret_cast<unsigned char*>(plane.data()));
        }
        tile.images = here.data();
        tiles.push_back(tile);
      }
    image.images = nullptr;
    image.tiles = tiles.data();
    image.num_tiles = static_cast<int>(tiles.size());
  }
  unsigned char* bytes = nullptr;
  const char* message = nullptr;
  const std::size_t size = SaveEXRImageToMemory(&image, &header, &bytes, &message);
  REQUIRE_MESSAGE(size > 0, (message ? message : ""));
  std::string result(reinterpret_cast<char*>(bytes), size);
  std::free(bytes);
  return result;
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
        const float expected = channels[c] < 0 ? 1.0f : halfToFloat(floatToHalf(valueAt(x, y, channels[c])));
        wrong += image.texels[static_cast<std::size_t>(y * kWidth + x) * 4 + c] != expected;
      }
  return wrong;
}

}  // namespace

TEST_CASE("half floats in every lossless compression") {
  for (int compression = TINYEXR_COMPRESSIONTYPE_NONE; compression <= TINYEXR_COMPRESSIONTYPE_PIZ;
       ++compression) {
    CAPTURE(compression);
    text::Diagnostics diagnostics;
    const auto image = decodeImage(encode("ABGR", compression, false), "a.exr", diagnostics);
    REQUIRE_MESSAGE(image, diagnostics.text());
    REQUIRE(image->width == kWidth);
    REQUIRE(image->height == kHeight);
    CHECK(countWrong(*image, {3, 2, 1, 0}) == 0);
  }
}

TEST_CASE("tiles are refused with what to do") {
  text::Diagnostics diagnostics;
  CHECK_FALSE(decodeImage(encode("ABGR", TINYEXR_COMPRESSIONTYPE_ZIP, true), "a.exr", diagnostics));
  REQUIRE(diagnostics.errorCount() == 1);
  CHECK(diagnostics.items()[0].message.find("scan lines") != std::string::npos);
}

TEST_CASE("files with random bytes changed, in every compression") {
  const char* seed = std::getenv("WEFT_FUZZ_SEED");
  std::mt19937 random(seed ? static_cast<std::uint32_t>(std::atoi(seed)) : 9u);
  int images = 0, refused = 0;
  for (int compression = TINYEXR_COMPRESSIONTYPE_NONE; compression <= TINYEXR_COMPRESSIONTYPE_PIZ;
       ++compression) {
    const std::string sound = encode("ABGR", compression, false);
    for (int i = 0; i < 600; ++i) {
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
  CHECK(countWrong(*decodeImage(encode("BGR", TINYEXR_COMPRESSIONTYPE_ZIP, false), "a.exr", diagnostics),
                   {2, 1, 0, -1}) == 0);
  CHECK(countWrong(*decodeImage(encode("Z", TINYEXR_COMPRESSIONTYPE_ZIP, false), "a.exr", diagnostics),
                   {0, 0, 0, -1}) == 0);
  CHECK(diagnostics.empty());
  CHECK_FALSE(decodeImage(encode("XZ", TINYEXR_COMPRESSIONTYPE_ZIP, false), "a.exr", diagnostics));
  CHECK_FALSE(decodeImage(encode("A", TINYEXR_COMPRESSIONTYPE_ZIP, false), "a.exr", diagnostics));
  CHECK(diagnostics.errorCount() == 2);
}

TEST_CASE(
    "the picture itself is read, whatever layers stand beside it, and no choice is made between layers") {
  text::Diagnostics diagnostics;
  const auto wrong = [&](const std::vector<std::string>& names, const std::array<int, 4>& channels) {
    CAPTURE(names.size());
    const auto image = decodeImage(encode(names, TINYEXR_COMPRESSIONTYPE_ZIP, false), "a.exr", diagnostics);
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
  CHECK(wrong({"BY", "RY", "Y"}, {}) == -1);
  CHECK(diagnostics.errorCount() == 4);
}
