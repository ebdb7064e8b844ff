// Pictures as CPU data: decoding, saving, cleaning an environment map. Row 0 is the top row, as in the files.
// Every failure is a Diagnostic: W150 (cannot be read), W151 (unknown kind of file), W152 (empty or too
// large; a warning where an .exr has nothing in its display window), W153 (warning, or note when none was worse than too bright:
// texels were replaced), W180 (cannot be written). Nothing throws, corrupt bytes never crash. Thread safe: no state is shared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::assets {

template <class T>
struct ImageOf {
  int width = 0, height = 0, channels = 0;
  std::vector<T> texels{};  // width * height * channels, interleaved
  T* texel(int x, int y) {
    return &texels[static_cast<std::size_t>((std::int64_t{y} * width + x) * channels)];
  }
};
using ImageF = ImageOf<float>;         // linear light
using Image8 = ImageOf<std::uint8_t>;  // as stored: sRGB encoded for pictures

constexpr int kMaxImageSide = 32768;
constexpr std::uint64_t kMaxImageBytes = 512ull << 20;  // as a texture holds it: 8192 x 4096 floats

// .hdr (RGB), .exr (RGBA; RGB and gray are widened), .png .jpg .jpeg .webp .tga (channels as stored, 8 or 16 bit;
// color is decoded from sRGB, alpha is not). The kind comes from the extension of `name`, case-insensitive.
std::optional<ImageF> decodeImage(std::string_view bytes, const std::string& name,
                                  text::Diagnostics& diagnostics);

// .png .jpg .jpeg .webp .tga; `channels` 1 to 4, or 0 for what the file has. 16-bit files are reduced.
std::optional<Image8> loadImage8(const std::string& path, int channels, text::Diagnostics& diagnostics);

// decodeImage, made RGBA (alpha 1) and fit for rgba16f: NaN and negative become 0, infinite becomes 65504, and light beyond
// 65504 moves to the texels around. Adds one W153 with the counts, and with the share of the light that found no room.
std::optional<ImageF> decodeEnvironment(std::string_view bytes, const std::string& name,
                                        text::Diagnostics& diagnostics);
// The cleaning step alone: the color channels of `image`, RGB or RGBA and equirectangular, in place.
void sanitizeRadiance(ImageF& image, const std::string& name, text::Diagnostics& diagnostics);

// An environment as the GPU takes it: equirectangular RGBA halves. Row 0 is +Y; alpha is 1; every value is finite and not negative.
struct EnvironmentMap {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint16_t> texels{};  // width * height * 4 binary16
};

// Empty after errors, and without any when `stop` ended it.
std::optional<EnvironmentMap> loadEnvironmentMap(const std::string& path, text::Diagnostics& diagnostics,
                                                 const std::stop_token& stop = {});

// Whether a name is that of an environment, by its end: .hdr or .exr.
bool isEnvironmentName(const std::string& name);

// A picture that decodeEnvironment gives, 3 or 4 channels, rounded to halves.
EnvironmentMap toEnvironmentMap(ImageF image);

// What a channel is in the file: .png .jpg .webp .tga of 8 bits, .png of 16 bits, .hdr and .exr.
enum class StoredType : std::uint8_t { byte, word, real };

struct ImageHeader {
  int width = 0, height = 0, channels = 0;
  StoredType type = StoredType::byte;
  friend bool operator==(const ImageHeader&, const ImageHeader&) = default;
};

// Walks the file but decodes no texels.
std::optional<ImageHeader> loadHeader(const std::string& path, text::Diagnostics& diagnostics);

// A picture file as a texture can hold it: the numbers of the file, four channels, bottom row first as OpenGL counts rows. Gray
// becomes equal red, green and blue; a missing alpha is 1.
struct StoredImage {
  ImageHeader header;
  std::vector<std::byte> texels{};  // of 1, 2 or 4 bytes a channel
};
// `srgb`: red, green and blue of 16 bits are decoded from sRGB and become real numbers; alpha stays linear.
std::optional<StoredImage> loadStored(const std::string& path, bool srgb, text::Diagnostics& diagnostics);

// A picture as the bytes of a PNG file. Empty when it cannot be encoded.
std::string encodePng8(int width, int height, int channels, std::span<const std::uint8_t> texels);
bool savePng8(const std::string& path, int width, int height, int channels,
              std::span<const std::uint8_t> texels, text::Diagnostics& diagnostics);
// 32-bit float, ZIP scanlines; 1, 3 or 4 channels.
bool saveExr(const std::string& path, const ImageF& image, text::Diagnostics& diagnostics);

// `image` of 4 channels with `width` x `height` texels, over 0; it repeats at its edges. `srgb`: color is averaged as light.
Image8 resize(const Image8& image, int width, int height, bool srgb);

float decodeSrgb(float encoded);  // IEC 61966-2-1; input and output 0..1

constexpr float kHalfMax = 65504.0f;  // the largest half

}  // namespace weft::assets
