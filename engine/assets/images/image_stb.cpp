// .hdr, .png, .jpg and .tga through stb_image and stb_image_write. Declared in image_codecs.h and image.h.
#include <fmt/format.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <array>
#include <cassert>
#include <memory>

#include "engine/assets/images/encode_png.h"
#include "engine/assets/images/image_check.h"
#include "engine/assets/images/image_codecs.h"
#include "engine/base/files/file.h"

namespace weft::assets {

using base::Diagnostics;

namespace {

template <class T>
using StbMemory = std::unique_ptr<T, decltype(&stbi_image_free)>;

const stbi_uc* stbData(std::string_view bytes) {
  return reinterpret_cast<const stbi_uc*>(bytes.data());
}
int stbSize(std::string_view bytes) {
  return static_cast<int>(bytes.size());
}

struct Header {
  int width = 0, height = 0, channels = 0;
};

// stb_image counts bytes in int.
std::optional<Header> readHeader(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  if (bytes.size() > 0x7fffffffu) {
    reportUnreadable(diagnostics, name, "the file is larger than 2 GiB");
    return {};
  }
  Header header;
  if (!stbi_info_from_memory(stbData(bytes), stbSize(bytes), &header.width, &header.height,
                             &header.channels)) {
    reportUnreadable(diagnostics, name, fmt::format("its header is not valid ({})", stbi_failure_reason()));
    return {};
  }
  if (!checkSize(diagnostics, name, header.width, header.height)) return {};
  return header;
}

// A header for the kinds that decodeLinear and decodeBytes take, of a file that is complete.
std::optional<Header> readPictureHeader(std::string_view bytes, const std::string& name,
                                        Diagnostics& diagnostics) {
  if (stbi_is_hdr_from_memory(stbData(bytes), stbSize(bytes))) {
    reportUnreadable(diagnostics, name, "it holds a Radiance picture; rename it to .hdr");
    return {};
  }
  const bool jpeg = isJpeg(bytes), png = bytes.starts_with("\x89PNG");
  if (const std::string problem = jpeg ? checkJpeg(bytes) : ""; !problem.empty()) {
    reportUnreadable(diagnostics, name, problem);
    return {};
  }
  const std::optional<Header> header = readHeader(bytes, name, diagnostics);
  if (!header || jpeg || png) return header;
  if (const std::string problem = checkTga(bytes); !problem.empty()) {
    reportUnreadable(diagnostics, name, problem);
    return {};
  }
  return header;
}

std::size_t componentCount(int width, int height, int channels) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
         static_cast<std::size_t>(channels);
}

template <class T>
std::optional<std::vector<T>> take(T* texels, std::size_t count, const std::string& name,
                                   Diagnostics& diagnostics) {
  const StbMemory<T> owner(texels, &stbi_image_free);
  if (!texels) {
    reportUnreadable(diagnostics, name, fmt::format("its texels are not valid ({})", stbi_failure_reason()));
    return {};
  }
  return std::vector<T>(texels, texels + count);
}

// All code values of `Bits`-bit sRGB, decoded.
template <int Bits>
const std::vector<float>& srgbTable() {
  static const std::vector<float> table = [] {
    constexpr std::size_t kCount = std::size_t{1} << Bits;
    std::vector<float> values(kCount);
    for (std::size_t i = 0; i < kCount; ++i)
      values[i] = decodeSrgb(static_cast<float>(i) / static_cast<float>(kCount - 1));
    return values;
  }();
  return table;
}

template <int Bits, class T>
ImageF linearize(const Header& header, const std::vector<T>& encoded) {
  ImageF image{header.width, header.height, header.channels, std::vector<float>(encoded.size())};
  const std::vector<float>& table = srgbTable<Bits>();
  const std::size_t channels = static_cast<std::size_t>(header.channels);
  const bool hasAlpha = channels % 2 == 0;
  for (std::size_t i = 0; i < encoded.size(); ++i) {
    const bool alpha = hasAlpha && i % channels == channels - 1;
    image.texels[i] =
        alpha ? static_cast<float>(encoded[i]) / static_cast<float>(table.size() - 1) : table[encoded[i]];
  }
  return image;
}

void appendBytes(void* out, void* bytes, int count) {
  static_cast<std::string*>(out)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
}

}  // namespace

std::optional<std::pair<int, int>> readHdrSize(std::string_view bytes, const std::string& name,
                                               Diagnostics& diagnostics) {
  if (bytes.size() <= 0x7fffffffu && !stbi_is_hdr_from_memory(stbData(bytes), stbSize(bytes))) {
    reportUnreadable(diagnostics, name, "it does not begin as a Radiance picture (#?RADIANCE)");
    return {};
  }
  const std::optional<Header> header = readHeader(bytes, name, diagnostics);
  if (!header) return {};
  if (const std::string problem = checkHdr(bytes); !problem.empty()) {
    reportUnreadable(diagnostics, name, problem);
    return {};
  }
  return std::pair{header->width, header->height};
}

std::optional<ImageF> decodeHdr(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  const auto size = readHdrSize(bytes, name, diagnostics);
  if (!size) return {};
  int width = 0, height = 0, channels = 0;
  float* texels = stbi_loadf_from_memory(stbData(bytes), stbSize(bytes), &width, &height, &channels, 3);
  auto values = take(texels, componentCount(size->first, size->second, 3), name, diagnostics);
  if (!values) return {};
  return ImageF{size->first, size->second, 3, std::move(*values)};
}

std::optional<ImageF> decodeLinear(std::string_view bytes, const std::string& name,
                                   Diagnostics& diagnostics) {
  const std::optional<Header> header = readPictureHeader(bytes, name, diagnostics);
  if (!header) return {};
  const std::size_t count = componentCount(header->width, header->height, header->channels);
  int width = 0, height = 0, channels = 0;
  if (stbi_is_16_bit_from_memory(stbData(bytes), stbSize(bytes))) {
    stbi_us* texels = stbi_load_16_from_memory(stbData(bytes), stbSize(bytes), &width, &height, &channels,
                                               header->channels);
    const auto values = take(texels, count, name, diagnostics);
    if (!values) return {};
    return linearize<16>(*header, *values);
  }
  stbi_uc* texels =
      stbi_load_from_memory(stbData(bytes), stbSize(bytes), &width, &height, &channels, header->channels);
  const auto values = take(texels, count, name, diagnostics);
  if (!values) return {};
  return linearize<8>(*header, *values);
}

std::optional<std::pair<int, int>> readImageSize(std::string_view bytes, const std::string& name,
                                                 Diagnostics& diagnostics) {
  const std::optional<Header> header = readPictureHeader(bytes, name, diagnostics);
  if (!header) return {};
  return std::pair{header->width, header->height};
}

std::optional<Image8> decodeBytes(std::string_view bytes, int channels, const std::string& name,
                                  Diagnostics& diagnostics) {
  assert(channels >= 0 && channels <= 4);
  const std::optional<Header> header = readPictureHeader(bytes, name, diagnostics);
  if (!header) return {};
  const int wanted = channels == 0 ? header->channels : channels;
  int width = 0, height = 0, stored = 0;
  stbi_uc* texels = stbi_load_from_memory(stbData(bytes), stbSize(bytes), &width, &height, &stored, wanted);
  auto values = take(texels, componentCount(header->width, header->height, wanted), name, diagnostics);
  if (!values) return {};
  return Image8{header->width, header->height, wanted, std::move(*values)};
}

bool hasShorts(std::string_view bytes) {
  return bytes.size() <= 0x7fffffffu && stbi_is_16_bit_from_memory(stbData(bytes), stbSize(bytes));
}

std::optional<std::vector<std::uint16_t>> decodeShorts(std::string_view bytes, const std::string& name,
                                                       Diagnostics& diagnostics) {
  const std::optional<Header> header = readPictureHeader(bytes, name, diagnostics);
  if (!header) return {};
  int width = 0, height = 0, stored = 0;
  stbi_us* texels = stbi_load_16_from_memory(stbData(bytes), stbSize(bytes), &width, &height, &stored, 4);
  return take(texels, componentCount(header->width, header->height, 4), name, diagnostics);
}

bool savePng8(const std::string& path, int width, int height, int channels,
              std::span<const std::uint8_t> texels, Diagnostics& diagnostics) {
  const std::string bytes = encodePng8(width, height, channels, texels);
  if (!bytes.empty()) return base::writeFile(path, bytes, diagnostics);
  diagnostics.error(base::Code::outputNotWritten, {std::make_shared<const std::string>(path)},
                    fmt::format("cannot encode '{}' as PNG", path));
  return false;
}

bool saveHdr(const std::string& path, const ImageF& image, Diagnostics& diagnostics) {
  assert(image.width > 0 && image.height > 0 && image.channels == 3);
  assert(image.texels.size() == componentCount(image.width, image.height, 3));
  std::string bytes;
  const int done =
      stbi_write_hdr_to_func(appendBytes, &bytes, image.width, image.height, 3, image.texels.data());
  if (done) return base::writeFile(path, bytes, diagnostics);
  diagnostics.error(base::Code::outputNotWritten, {std::make_shared<const std::string>(path)},
                    fmt::format("cannot encode '{}' as .hdr", path));
  return false;
}

}  // namespace weft::assets
