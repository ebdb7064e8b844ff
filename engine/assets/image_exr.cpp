// .exr through tinyexr: single-part scanline or tiled pictures in, 32-bit float ZIP scanlines out.
#include <array>
#include <cassert>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <tinyexr.h>

#include "engine/assets/image_codecs.h"
#include "engine/base/file.h"

namespace weft::assets {

using base::Diagnostics;

namespace {

// The library's message, freed.
std::string takeMessage(const char* message) {
  const std::string text = message ? message : "no reason given";
  if (message) FreeEXRErrorMessage(message);
  return text;
}

struct HeaderOwner {
  EXRHeader header;
  HeaderOwner() { InitEXRHeader(&header); }
  ~HeaderOwner() { FreeEXRHeader(&header); }
  HeaderOwner(const HeaderOwner&) = delete;
  HeaderOwner& operator=(const HeaderOwner&) = delete;
};

const unsigned char* dataOf(std::string_view bytes) { return reinterpret_cast<const unsigned char*>(bytes.data()); }

}  // namespace

std::optional<ImageF> decodeExr(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  EXRVersion version{};
  if (ParseEXRVersionFromMemory(&version, dataOf(bytes), bytes.size()) != TINYEXR_SUCCESS) {
    reportUnreadable(diagnostics, name, "it does not begin as an OpenEXR picture");
    return {};
  }
  if (version.multipart || version.non_image) {
    reportUnreadable(diagnostics, name, "it has several parts or deep data; save it as one flat picture");
    return {};
  }
  HeaderOwner owner;
  const char* message = nullptr;
  if (ParseEXRHeaderFromMemory(&owner.header, &version, dataOf(bytes), bytes.size(), &message) != TINYEXR_SUCCESS) {
    reportUnreadable(diagnostics, name, takeMessage(message));
    return {};
  }
  const EXRBox2i& box = owner.header.data_window;
  const long long width = static_cast<long long>(box.max_x) - box.min_x + 1;
  const long long height = static_cast<long long>(box.max_y) - box.min_y + 1;
  if (!checkSize(diagnostics, name, width, height)) return {};

  float* texels = nullptr;
  int loadedWidth = 0, loadedHeight = 0;
  const int result = LoadEXRFromMemory(&texels, &loadedWidth, &loadedHeight, dataOf(bytes), bytes.size(), &message);
  const std::unique_ptr<float, decltype(&std::free)> memory(texels, &std::free);
  if (result != TINYEXR_SUCCESS || !texels) {
    reportUnreadable(diagnostics, name, takeMessage(message));
    return {};
  }
  const std::size_t count = static_cast<std::size_t>(loadedWidth) * static_cast<std::size_t>(loadedHeight);
  ImageF image{loadedWidth, loadedHeight, 4, std::vector<float>(texels, texels + count * 4)};
  // A single channel is copied to all four; as a grey picture its alpha is 1.
  if (owner.header.num_channels == 1 && std::strcmp(owner.header.channels[0].name, "A") != 0)
    for (std::size_t i = 0; i < count; ++i) image.texels[i * 4 + 3] = 1;
  return image;
}

bool saveExr(const std::string& path, const ImageF& image, Diagnostics& diagnostics) {
  assert(image.width > 0 && image.height > 0);
  assert(image.channels == 1 || image.channels == 3 || image.channels == 4);
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  assert(image.texels.size() == count * channels);

  // Channels stand in alphabetical order in the file: A B G R, or Y alone.
  const std::string_view names = channels == 1 ? "Y" : channels == 3 ? "BGR" : "ABGR";
  std::vector<float> planes(count * channels);
  std::array<unsigned char*, 4> pointers{};
  std::array<EXRChannelInfo, 4> infos{};
  std::array<int, 4> types{};
  for (std::size_t c = 0; c < channels; ++c) {
    float* plane = planes.data() + c * count;
    for (std::size_t i = 0; i < count; ++i) plane[i] = image.texels[i * channels + (channels - 1 - c)];
    pointers[c] = reinterpret_cast<unsigned char*>(plane);
    infos[c].name[0] = names[c];
    types[c] = TINYEXR_PIXELTYPE_FLOAT;
  }
  EXRHeader header;
  InitEXRHeader(&header);
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  header.num_channels = image.channels;
  header.channels = infos.data();
  header.pixel_types = types.data();
  header.requested_pixel_types = types.data();
  EXRImage picture;
  InitEXRImage(&picture);
  picture.images = pointers.data();
  picture.width = image.width;
  picture.height = image.height;
  picture.num_channels = image.channels;

  unsigned char* bytes = nullptr;
  const char* message = nullptr;
  const std::size_t size = SaveEXRImageToMemory(&picture, &header, &bytes, &message);
  const std::unique_ptr<unsigned char, decltype(&std::free)> memory(bytes, &std::free);
  if (size > 0) return base::writeFile(path, {reinterpret_cast<const char*>(bytes), size}, diagnostics);
  diagnostics.error(base::Code::W180, {std::make_shared<const std::string>(path)},
                    fmt::format("cannot encode '{}' as OpenEXR: {}", path, takeMessage(message)));
  return false;
}

}  // namespace weft::assets
