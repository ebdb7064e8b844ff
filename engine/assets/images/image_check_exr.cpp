// The header of an .exr file, checked before it is decoded.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>

#include "engine/assets/images/image_check.h"

namespace weft::assets {

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
  std::optional<std::uint8_t> byte() {
    const auto taken = take(1);
    if (!taken) return {};
    return static_cast<std::uint8_t>((*taken)[0]);
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

}  // namespace

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

}  // namespace weft::assets
