// Texel formats a graph may name, and the facts the compiler needs of them. The runtime maps them to GL enums.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft::graph {

enum class Format : std::uint8_t {
  none,
  r8,
  rg8,
  rgba8,
  srgb8_a8,
  r8_snorm,
  rg8_snorm,
  rgba8_snorm,
  r16,
  rg16,
  rgba16,
  r16f,
  rg16f,
  rgba16f,
  r32f,
  rg32f,
  rgba32f,
  r11f_g11f_b10f,
  rgb10_a2,
  rgb9_e5,
  r8ui,
  r16ui,
  r32ui,
  rg16ui,
  rg32ui,
  rgba8ui,
  rgba16ui,
  rgba32ui,
  r32i,
  rg32i,
  rgba32i,
  depth16,
  depth24,
  depth32f,
  depth24_stencil8,
  depth32f_stencil8,
  count_
};

// How a shader or a poison pattern sees the texels.
enum class TexelKind : std::uint8_t {
  none,
  normalized,
  floating,
  unsigned_integer,
  signed_integer,
  depth,
  depth_stencil
};

struct FormatInfo {
  const char* name;    // spelling in a graph file: "rgba16f"
  std::uint8_t bytes;  // per texel; 0 for none
  std::uint8_t channels;
  TexelKind kind;
  // ARB_texture_view compatibility class (OpenGL 4.5 core, table 8.22): the texel size in bits; depth and stencil
  // formats are compatible with themselves only and carry 256 + the enum's value.
  std::uint16_t viewClass;
  bool colorRenderable;
  bool imageStorable;  // usable with image load/store (table 8.26)
};

const FormatInfo& infoOf(Format format);
inline bool isDepth(Format f) {
  return infoOf(f).kind == TexelKind::depth || infoOf(f).kind == TexelKind::depth_stencil;
}
inline bool hasStencil(Format f) {
  return infoOf(f).kind == TexelKind::depth_stencil;
}

std::optional<Format> findFormat(std::string_view name);
std::vector<std::string> formatNames();

}  // namespace weft::graph
