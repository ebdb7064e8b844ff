// .exr through tinyexr: single-part scanline pictures in, 32-bit float ZIP scanlines out.
// Built on the library's low-level calls: its one-call LoadEXRFromMemory leaks whenever it fails.
// Declared in image_codecs.h and image.h.
#include <fmt/format.h>
#include <tinyexr.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "engine/assets/images/image_codecs.h"
#include "engine/text/files/file.h"

namespace weft::assets {

using text::Diagnostics;

namespace {

// A forward reader over little-endian bytes; after the end it only yields nothing.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}
  std::size_t size() const { return rest_.size(); }
  std::optional<std::string_view> take(std::size_t count) {
    if (count > rest_.size()) return {};
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  std::optional<std::uint32_t> word() {
    const auto taken = take(4);
    if (!taken) return {};
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<std::uint8_t>((*taken)[i]);
    return value;
  }
  // Up to a zero byte, at most 255 characters.
  std::optional<std::string_view> text() {
    const std::size_t end = rest_.find('\0');
    if (end == std::string_view::npos || end > 255) return {};
    const auto taken = take(end);
    rest_.remove_prefix(1);
    return taken;
  }

 private:
  std::string_view rest_;
};

constexpr std::uint32_t kTiled = 0x200, kLongNames = 0x400;  // of the version word

std::string checkChannels(std::string_view value) {
  Bytes bytes(value);
  for (int count = 0;; ++count) {
    const auto name = bytes.text();
    if (!name) return "its channel list is cut off";
    if (name->empty())
      return count == 0 ? "it has no channels" : bytes.size() > 0 ? "its channel list has no end" : "";
    const auto type = bytes.word(), linear = bytes.word(), x = bytes.word(), y = bytes.word();
    if (!type || !linear || !x || !y) return "its channel list is cut off";
    if (*type > 2) return fmt::format("channel '{}' has pixel type {}, none of 0 to 2", *name, *type);
    if (*x != 1 || *y != 1) return fmt::format("channel '{}' is subsampled", *name);
  }
}

// The fixed size of an attribute's value in bytes, 0 for any but empty.
std::size_t sizeOf(std::string_view name) {
  if (name == "compression" || name == "lineOrder") return 1;
  if (name == "pixelAspectRatio" || name == "screenWindowWidth" || name == "chunkCount") return 4;
  if (name == "screenWindowCenter") return 8;
  if (name == "dataWindow" || name == "displayWindow") return 16;
  return 0;
}

std::string checkAttribute(std::string_view name, std::string_view value) {
  const std::size_t size = sizeOf(name);
  if (size == 0 ? value.empty() : value.size() != size)
    return fmt::format("its attribute '{}' has {} bytes", name, value.size());
  if (name == "channels") return checkChannels(value);
  if (name == "compression" && static_cast<std::uint8_t>(value[0]) > 4)
    return fmt::format("compression {} is not read; none, RLE, ZIP and PIZ are",
                       static_cast<std::uint8_t>(value[0]));
  if (name == "type" && value.substr(0, value.find('\0')) != "scanlineimage")
    return "its type does not fit its version";
  return "";
}

// tinyexr asserts attributes of a wrong size or value. Also refuses what is legal and not read: several parts, deep data, tiles
// (tinyexr leaks and strays in damaged ones), subsampled channels, compressions beyond PIZ. "" for a sound header.
// "OpenEXR File Layout" (openexr.com): magic, version and flags, then attributes (name, type, size, value) up
// to an empty name.
std::string checkExr(std::string_view file) {
  Bytes bytes(file);
  if (bytes.word() != 20000630u) return "it does not begin as an OpenEXR picture";
  const std::uint32_t version = bytes.word().value_or(0);
  if ((version & 0xff) != 2) return fmt::format("its version is {}, not 2", version & 0xff);
  if ((version & kTiled) != 0) return "it is stored in tiles; save it as scan lines";
  if ((version & ~(0xffu | kLongNames)) != 0)
    return "it has several parts or deep data; save it as one flat picture";
  std::set<std::string_view> seen;
  for (;;) {
    const auto name = bytes.text();
    if (!name) return "the file ends in its header";
    if (name->empty()) break;
    const auto type = bytes.text();
    const auto size = bytes.word();
    const auto value = size ? bytes.take(*size) : std::nullopt;
    if (!type || type->empty() || !value) return fmt::format("its attribute '{}' is cut off", *name);
    if (!seen.insert(*name).second) return fmt::format("its attribute '{}' stands twice", *name);
    if (const std::string problem = checkAttribute(*name, *value); !problem.empty()) return problem;
  }
  for (const char* needed : {"channels", "compression", "dataWindow", "displayWindow", "lineOrder",
                             "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth"})
    if (!seen.contains(needed)) return fmt::format("its header has no '{}'", needed);
  return "";
}

// The library's message, freed.
std::string takeMessage(const char* message) {
  const std::string text = message ? message : "no reason given";
  if (message) FreeEXRErrorMessage(message);
  return text;
}

template <class T, void (*init)(T*), int (*release)(T*)>
struct Owner {
  T value;
  Owner() { init(&value); }
  ~Owner() { release(&value); }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
};

const unsigned char* dataOf(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

// Header fields that the library multiplies and allocates by without a look at the file's length.
bool areCountsSound(const EXRHeader& header, long long width, long long height, std::size_t fileSize) {
  const long long most = 2 * static_cast<long long>(kMaxImageTexels);
  if (header.num_channels < 1 || width * height * header.num_channels > 2 * most) return false;
  return header.chunk_count >= 0 && static_cast<std::size_t>(header.chunk_count) <= fileSize / 8;
}

// Which channel of the file each of R, G, B, A is, -1 for none, and the layer ("diffuse" of "diffuse.R") that they belong to.
struct Layer {
  std::string_view name;  // empty for the picture itself
  std::array<int, 4> channels = {-1, -1, -1, -1};
  bool isWhole() const { return channels[0] >= 0 && channels[1] >= 0 && channels[2] >= 0; }
};

// Those with channels R, G and B, in the order of the file. A file with one channel, or with Y where that
// is no part of a color, is gray.
std::vector<Layer> findLayers(const EXRHeader& header) {
  std::vector<Layer> layers;
  std::unordered_map<std::string_view, std::size_t> places;  // of layers in `layers`
  int gray = header.num_channels == 1 ? 0 : -1;
  bool hasColors = false;  // as X, Y, Z or as Y, RY, BY
  for (int c = 0; c < header.num_channels; ++c) {
    const std::string_view name = header.channels[c].name;
    const std::size_t dot = name.rfind('.');
    const std::string_view of = dot == name.npos ? "" : name.substr(0, dot);
    const std::string_view last = dot == name.npos ? name : name.substr(dot + 1);
    if (name == "Y") gray = c;
    hasColors |= name == "X" || name == "RY" || name == "BY";
    const std::size_t index = last.size() == 1 ? std::string_view("RGBA").find(last[0]) : last.npos;
    if (index == last.npos) continue;
    const auto [known, fresh] = places.try_emplace(of, layers.size());
    if (fresh) layers.push_back(Layer{of});
    layers[known->second].channels[index] = c;
  }
  const auto own = std::ranges::find(layers, std::string_view(), &Layer::name);
  const int alpha = own == layers.end() ? -1 : own->channels[3];
  const bool hasPicture = own != layers.end() && own->isWhole();
  if (hasPicture) return {*own};
  std::erase_if(layers, [](const Layer& layer) { return !layer.isWhole(); });
  if (layers.empty() && gray >= 0 && gray != alpha && (!hasColors || header.num_channels == 1))
    layers = {{"", {gray, gray, gray, alpha}}};
  return layers;
}

// Why no picture can be chosen.
std::string reasonOf(const std::vector<Layer>& layers) {
  if (layers.empty()) return "it has no channels R, G and B";
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(layers.size(), 8); ++i)
    names += fmt::format("{}'{}'", i == 0 ? "" : ", ", layers[i].name);
  return fmt::format("it has several layers ({}{}) and no picture of its own; save one of them as a file",
                     names, layers.size() > 8 ? ", …" : "");
}

// What the header says of the picture, and which channels are wanted as floats. Nothing after errors.
struct Opening {
  Owner<EXRHeader, InitEXRHeader, FreeEXRHeader> owner;
  long long width = 0, height = 0;
  std::array<int, 4> channels{};
};

std::unique_ptr<Opening> openExr(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  if (const std::string problem = checkExr(bytes); !problem.empty()) {
    reportUnreadable(diagnostics, name, problem);
    return {};
  }
  EXRVersion version{};
  if (ParseEXRVersionFromMemory(&version, dataOf(bytes), bytes.size()) != TINYEXR_SUCCESS) {
    reportUnreadable(diagnostics, name, "its version is not valid");
    return {};
  }
  auto opening = std::make_unique<Opening>();
  EXRHeader& header = opening->owner.value;
  const char* message = nullptr;
  if (ParseEXRHeaderFromMemory(&header, &version, dataOf(bytes), bytes.size(), &message) != TINYEXR_SUCCESS) {
    reportUnreadable(diagnostics, name, takeMessage(message));
    return {};
  }
  const EXRBox2i& box = header.data_window;
  opening->width = static_cast<long long>(box.max_x) - box.min_x + 1;
  opening->height = static_cast<long long>(box.max_y) - box.min_y + 1;
  if (!checkSize(diagnostics, name, opening->width, opening->height)) return {};
  if (!areCountsSound(header, opening->width, opening->height, bytes.size())) {
    reportUnreadable(diagnostics, name, "its header has impossible channel or chunk counts");
    return {};
  }
  const std::vector<Layer> layers = findLayers(header);
  if (layers.size() != 1) {
    reportUnreadable(diagnostics, name, reasonOf(layers));
    return {};
  }
  opening->channels = layers[0].channels;
  const std::array<int, 4>& channels = opening->channels;
  for (const int channel : channels) {
    if (channel < 0) continue;
    int& type = header.requested_pixel_types[channel];
    if (type == TINYEXR_PIXELTYPE_HALF) type = TINYEXR_PIXELTYPE_FLOAT;
    if (type == TINYEXR_PIXELTYPE_FLOAT) continue;
    reportUnreadable(diagnostics, name, "a color channel holds whole numbers");
    return {};
  }
  return opening;
}

// The library's own containers throw.
template <class Result, class Work>
std::optional<Result> guarded(const std::string& name, Diagnostics& diagnostics, const Work& work) try {
  return work();
} catch (const std::exception& error) {
  reportUnreadable(diagnostics, name, fmt::format("decoding failed ({})", error.what()));
  return {};
}

}  // namespace

std::optional<ImageF> decodeExr(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  return guarded<ImageF>(name, diagnostics, [&]() -> std::optional<ImageF> {
    const std::unique_ptr<Opening> opening = openExr(bytes, name, diagnostics);
    if (!opening) return {};
    EXRHeader& header = opening->owner.value;
    const char* message = nullptr;
    Owner<EXRImage, InitEXRImage, FreeEXRImage> picture;
    picture.value.num_channels =
        header.num_channels;  // on failure the library frees so many planes, else it leaks them
    if (LoadEXRImageFromMemory(&picture.value, &header, dataOf(bytes), bytes.size(), &message) !=
        TINYEXR_SUCCESS) {
      InitEXRImage(&picture.value);  // on failure the library has freed what it points to
      reportUnreadable(diagnostics, name, takeMessage(message));
      return {};
    }
    ImageF image{static_cast<int>(opening->width), static_cast<int>(opening->height), 4, {}};
    image.texels.assign(static_cast<std::size_t>(opening->width * opening->height) * 4, 1.0f);
    for (std::size_t c = 0; c < 4; ++c) {
      if (opening->channels[c] < 0) continue;
      const float* plane = reinterpret_cast<const float*>(picture.value.images[opening->channels[c]]);
      for (std::size_t i = 0; i * 4 < image.texels.size(); ++i) image.texels[i * 4 + c] = plane[i];
    }
    return image;
  });
}

std::optional<ImageHeader> readExrHeader(std::string_view bytes, const std::string& name,
                                         Diagnostics& diagnostics) {
  return guarded<ImageHeader>(name, diagnostics, [&]() -> std::optional<ImageHeader> {
    const std::unique_ptr<Opening> opening = openExr(bytes, name, diagnostics);
    if (!opening) return {};
    return ImageHeader{static_cast<int>(opening->width), static_cast<int>(opening->height), 4,
                       StoredType::real};
  });
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
  if (size > 0) return text::writeFile(path, {reinterpret_cast<const char*>(bytes), size}, diagnostics);
  diagnostics.error(text::Code::outputNotWritten, {path},
                    fmt::format("cannot encode '{}' as OpenEXR: {}", path, takeMessage(message)));
  return false;
}

}  // namespace weft::assets
