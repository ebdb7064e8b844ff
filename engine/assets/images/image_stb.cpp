// .png, .jpg and .tga through stb_image and stb_image_write, .webp through libwebp. Declared in image_codecs.h and image.h.
#include <fmt/format.h>
#include <stb/stb_image.h>
#include <stb/stb_image_resize.h>
#include <stb/stb_image_write.h>
#include <webp/decode.h>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "assets_sentences.h"
#include "engine/assets/images/image_codecs.h"
#include "engine/text/files/file.h"

namespace weft::assets {

using text::Diagnostics;

namespace {

// What stb_image does not survive or lets pass. Files that end early: it fills what is missing with zeros (.jpg) or leaves it uninitialized (.tga). Huffman tables of more than 256 codes in a .jpg: it writes beyond its arrays
// (the packaged version of 2022-09 does; found by the fuzz test). So the structure of a file is walked before it is decoded.
// Each check returns "" for a complete file, else what is wrong, to stand after "path: ".

std::uint8_t byteAt(std::string_view bytes, std::size_t i) {
  return static_cast<std::uint8_t>(bytes[i]);
}

std::string endsEarly(std::size_t line, std::size_t lines) {
  return fmt::format("the file ends in line {} of {}", line + 1, lines);
}

// A file that stb_image takes for a JPEG; checkJpeg() comes before any call to stb_image with it.
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

// Truevision TGA 2.0: 18 bytes of header, id, color map, then texels or run-length packets.
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

const stbi_uc* stbData(std::string_view bytes) {
  return reinterpret_cast<const stbi_uc*>(bytes.data());
}
int stbSize(std::string_view bytes) {
  return static_cast<int>(bytes.size());
}

bool isWebp(std::string_view bytes) {
  return bytes.size() >= 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP";
}

std::string readWebpHeader(std::string_view bytes, ImageHeader& header) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(stbData(bytes), bytes.size(), &features) != VP8_STATUS_OK) return "it is damaged";
  header = {features.width, features.height, features.has_alpha ? 4 : 3};
  return features.has_animation ? "it moves; save one picture of it" : "";
}

// Gray is what stb_image makes of colors.
std::optional<Image8> decodeWebp(std::string_view bytes, int channels) {
  Image8 image{.channels = channels};
  const bool clear = channels % 2 == 0;
  const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> texels(
      (clear ? WebPDecodeRGBA : WebPDecodeRGB)(stbData(bytes), bytes.size(), &image.width, &image.height),
      &WebPFree);
  if (!texels) return {};
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                    from = clear ? 4 : 3, to = static_cast<std::size_t>(channels);
  image.texels.assign(texels.get(), texels.get() + count * from);
  for (std::size_t i = 0; to < 3 && i < count; ++i) {
    const std::uint8_t* const t = texels.get() + i * from;
    image.texels[i * to] = static_cast<std::uint8_t>((77 * t[0] + 150 * t[1] + 29 * t[2]) >> 8);
    if (clear) image.texels[i * to + 1] = t[3];
  }
  image.texels.resize(count * to);
  return image;
}

void appendBytes(void* out, void* bytes, int count) {
  static_cast<std::string*>(out)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
}

}  // namespace

std::optional<ImageHeader> readPictureHeader(std::string_view bytes, const std::string& name,
                                             Diagnostics& diagnostics) {
  ImageHeader header;
  const bool jpeg = isJpeg(bytes), png = bytes.starts_with("\x89PNG"), webp = isWebp(bytes);
  std::string problem = jpeg ? checkJpeg(bytes) : webp ? readWebpHeader(bytes, header) : "";
  if (bytes.starts_with("#?")) problem = "it holds a Radiance picture; rename it to .hdr";
  if (bytes.size() > 0x7fffffffu) problem = "the file is larger than 2 GiB";  // stb_image counts bytes in int
  if (problem.empty() && !webp &&
      !stbi_info_from_memory(stbData(bytes), stbSize(bytes), &header.width, &header.height, &header.channels))
    problem = fmt::format("its header is not valid ({})", stbi_failure_reason());
  const bool word = problem.empty() && stbi_is_16_bit_from_memory(stbData(bytes), stbSize(bytes));
  if (word) header.type = StoredType::word;
  if (problem.empty() && !checkSize(diagnostics, name, header.width, header.height, word ? 8 : 4)) return {};
  if (problem.empty() && !jpeg && !png && !webp) problem = checkTga(bytes);
  if (!problem.empty()) {
    reportUnreadable(diagnostics, name, problem);
    return {};
  }
  return header;
}

// In a .jpg it is in the segment APP1, in a .png in the chunk eXIf, in a .webp in EXIF; there a list of entries of 12 bytes.
int orientationOf(std::string_view bytes) {
  std::string_view exif;
  const bool webp = isWebp(bytes);
  if (webp || bytes.starts_with("\x89PNG")) {
    for (std::size_t at = webp ? 12 : 8; at + 8 <= bytes.size() && exif.empty();) {
      std::size_t size = 0;  // of a .webp the lowest byte first, behind the name
      for (std::size_t i = 0; i < 4; ++i) size = size << 8 | byteAt(bytes, webp ? at + 7 - i : at + i);
      if (bytes.substr(webp ? at : at + 4, 4) == (webp ? "EXIF" : "eXIf")) exif = bytes.substr(at + 8, size);
      at += webp ? 8 + size + size % 2 : 12 + size;
    }
    if (exif.starts_with("Exif")) exif = exif.substr(std::min<std::size_t>(6, exif.size()));
  } else if (bytes.starts_with("\xff\xd8")) {
    for (std::size_t at = 2; at + 4 <= bytes.size() && bytes[at] == '\xff' && bytes[at + 1] != '\xda';) {
      const std::string_view segment =
          bytes.substr(at + 4, (std::size_t{byteAt(bytes, at + 2)} << 8 | byteAt(bytes, at + 3)) - 2);
      if (bytes[at + 1] == '\xe1' && segment.starts_with("Exif"))
        exif = segment.substr(std::min<std::size_t>(6, segment.size()));
      at += segment.size() + 4;
    }
  }
  const bool little = exif.starts_with("II");
  const auto number = [&](std::size_t at, std::size_t count) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < count && at + count <= exif.size(); ++i)
      value |= std::size_t{byteAt(exif, at + i)} << 8 * (little ? i : count - 1 - i);
    return value;
  };
  const std::size_t list = number(4, 4);
  for (std::size_t entry = 0; entry < number(list, 2); ++entry)
    if (const std::size_t at = list + 2 + 12 * entry; number(at, 2) == 0x0112) {
      const std::size_t value = number(at + 8, 2);
      return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
    }
  return 1;
}

template <class T>
std::optional<ImageOf<T>> decodePicture(std::string_view bytes, int channels, const std::string& name,
                                        Diagnostics& diagnostics) {
  int width = 0, height = 0, stored = 0;
  const auto load = [&](auto* function) {
    return function(stbData(bytes), stbSize(bytes), &width, &height, &stored, channels);
  };
  T* read = nullptr;
  if constexpr (sizeof(T) == 1) {
    if (ImageHeader header; isWebp(bytes)) {
      readWebpHeader(bytes, header);
      auto image = decodeWebp(bytes, channels == 0 ? header.channels : channels);
      if (!image) reportUnreadable(diagnostics, name, "its texels are not valid");
      return image;
    }
    read = load(stbi_load_from_memory);
  } else {
    read = load(stbi_load_16_from_memory);
  }
  const std::unique_ptr<T, decltype(&stbi_image_free)> texels(read, &stbi_image_free);
  if (!texels) {
    reportUnreadable(diagnostics, name, fmt::format("its texels are not valid ({})", stbi_failure_reason()));
    return {};
  }
  if (channels == 0) channels = stored;
  const auto count =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
  return ImageOf<T>{width, height, channels, std::vector<T>(texels.get(), texels.get() + count)};
}

template std::optional<Image8> decodePicture(std::string_view, int, const std::string&, Diagnostics&);
template std::optional<ImageOf<std::uint16_t>> decodePicture(std::string_view, int, const std::string&,
                                                             Diagnostics&);

std::string encodePng8(int width, int height, int channels, std::span<const std::uint8_t> texels) {
  assert(width > 0 && height > 0 && channels >= 1 && channels <= 4);
  assert(texels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(channels));
  // Each row as differences to the texel at the left; stb would try all five filters for each.
  [[maybe_unused]] static const int filter = stbi_write_force_png_filter = 1;
  std::string bytes;
  const int done =
      stbi_write_png_to_func(appendBytes, &bytes, width, height, channels, texels.data(), width * channels);
  return done ? bytes : std::string();
}

bool savePng8(const std::string& path, int width, int height, int channels,
              std::span<const std::uint8_t> texels, Diagnostics& diagnostics) {
  const std::string bytes = encodePng8(width, height, channels, texels);
  if (!bytes.empty()) return text::writeFile(path, bytes, diagnostics);
  diagnostics.error(say::pngNotEncoded, {path}, path);
  return false;
}

Image8 resize(const Image8& image, int width, int height, bool srgb) {
  assert(image.channels == 4);
  Image8 out{width, height, 4, {}};
  out.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  // Alpha is a mask or nothing: color is not weighted by it.
  [[maybe_unused]] const int good = stbir_resize_uint8_generic(
      image.texels.data(), image.width, image.height, 0, out.texels.data(), width, height, 0, 4, 3,
      STBIR_FLAG_ALPHA_PREMULTIPLIED, STBIR_EDGE_WRAP, STBIR_FILTER_DEFAULT,
      srgb ? STBIR_COLORSPACE_SRGB : STBIR_COLORSPACE_LINEAR, nullptr);
  assert(good);
  return out;
}

}  // namespace weft::assets
