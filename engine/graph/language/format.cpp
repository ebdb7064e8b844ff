#include "engine/graph/language/format.h"

#include <array>

namespace weft::graph {

namespace {

using K = TexelKind;

constexpr std::uint16_t kDepthClass = 256;
constexpr FormatInfo color(const char* name, int bytes, int channels, K kind, bool renderable = true,
                           bool storable = true) {
  return {name,    static_cast<std::uint8_t>(bytes),      static_cast<std::uint8_t>(channels),
          kind,    static_cast<std::uint16_t>(bytes * 8), renderable,
          storable};
}
constexpr FormatInfo depth(Format format, const char* name, int bytes, K kind) {
  return {name,
          static_cast<std::uint8_t>(bytes),
          1,
          kind,
          static_cast<std::uint16_t>(kDepthClass + static_cast<int>(format)),
          false,
          false};
}

constexpr std::array<FormatInfo, static_cast<std::size_t>(Format::count_)> kFormats = {{
    {"none", 0, 0, K::none, 0, false, false},
    color("r8", 1, 1, K::normalized),
    color("rg8", 2, 2, K::normalized),
    color("rgba8", 4, 4, K::normalized),
    color("srgb8_a8", 4, 4, K::normalized, true, false),
    color("r8_snorm", 1, 1, K::normalized, false),
    color("rg8_snorm", 2, 2, K::normalized, false),
    color("rgba8_snorm", 4, 4, K::normalized, false),
    color("r16", 2, 1, K::normalized),
    color("rg16", 4, 2, K::normalized),
    color("rgba16", 8, 4, K::normalized),
    color("r16f", 2, 1, K::floating),
    color("rg16f", 4, 2, K::floating),
    color("rgba16f", 8, 4, K::floating),
    color("r32f", 4, 1, K::floating),
    color("rg32f", 8, 2, K::floating),
    color("rgba32f", 16, 4, K::floating),
    color("r11f_g11f_b10f", 4, 3, K::floating),
    color("rgb10_a2", 4, 4, K::normalized),
    color("rgb9_e5", 4, 3, K::floating, false, false),
    color("r8ui", 1, 1, K::unsigned_integer),
    color("r16ui", 2, 1, K::unsigned_integer),
    color("r32ui", 4, 1, K::unsigned_integer),
    color("rg16ui", 4, 2, K::unsigned_integer),
    color("rg32ui", 8, 2, K::unsigned_integer),
    color("rgba8ui", 4, 4, K::unsigned_integer),
    color("rgba16ui", 8, 4, K::unsigned_integer),
    color("rgba32ui", 16, 4, K::unsigned_integer),
    color("r32i", 4, 1, K::signed_integer),
    color("rg32i", 8, 2, K::signed_integer),
    color("rgba32i", 16, 4, K::signed_integer),
    depth(Format::depth16, "depth16", 2, K::depth),
    depth(Format::depth24, "depth24", 4, K::depth),
    depth(Format::depth32f, "depth32f", 4, K::depth),
    depth(Format::depth24_stencil8, "depth24_stencil8", 4, K::depth_stencil),
    depth(Format::depth32f_stencil8, "depth32f_stencil8", 8, K::depth_stencil),
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
