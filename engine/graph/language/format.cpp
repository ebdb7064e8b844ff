#include "engine/graph/language/format.h"

#include <array>

namespace weft::graph {

namespace {

constexpr std::uint16_t kOwnClass = 0;  // depth and stencil formats are compatible with themselves only

constexpr FormatInfo infoOfRow(FormatInfo row, Format format) {
  if (row.viewClass == kOwnClass) row.viewClass = static_cast<std::uint16_t>(256 + static_cast<int>(format));
  return row;
}

constexpr std::array<FormatInfo, static_cast<std::size_t>(Format::count_)> kFormats = {
    {{"none", 0, 0, TexelKind::none, 0, false, false},
#define WEFT_FORMAT(name, bytes, channels, kind, viewClass, renderable, storable) \
  infoOfRow({#name, bytes, channels, TexelKind::kind, viewClass, renderable, storable}, Format::name),
     WEFT_FORMATS(WEFT_FORMAT)
#undef WEFT_FORMAT
    }};

}  // namespace

const FormatInfo& infoOf(Format format) {
  return kFormats[static_cast<std::size_t>(format)];
}

std::optional<Format> findFormat(std::string_view name) {
  for (std::size_t i = 1; i < kFormats.size(); ++i)
    if (name == kFormats[i].name) return static_cast<Format>(i);
  return std::nullopt;
}

std::vector<std::string> formatNames() {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < kFormats.size(); ++i) names.emplace_back(kFormats[i].name);
  return names;
}

}  // namespace weft::graph
