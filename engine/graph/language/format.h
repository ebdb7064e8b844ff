// Texel formats a graph may name, and the facts the compiler needs of them. The runtime maps them to GL enums.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft::graph {

// Name, bytes, channels, kind, view class, renderable, storable: as FormatInfo has them.
#define WEFT_FORMATS(F)                                             \
  F(r8, 1, 1, normalized, 8, true, true)                            \
  F(rg8, 2, 2, normalized, 16, true, true)                          \
  F(rgba8, 4, 4, normalized, 32, true, true)                        \
  F(srgb8_a8, 4, 4, normalized, 32, true, false)                    \
  F(r8_snorm, 1, 1, normalized, 8, false, true)                     \
  F(rg8_snorm, 2, 2, normalized, 16, false, true)                   \
  F(rgba8_snorm, 4, 4, normalized, 32, false, true)                 \
  F(r16, 2, 1, normalized, 16, true, true)                          \
  F(rg16, 4, 2, normalized, 32, true, true)                         \
  F(rgba16, 8, 4, normalized, 64, true, true)                       \
  F(r16f, 2, 1, floating, 16, true, true)                           \
  F(rg16f, 4, 2, floating, 32, true, true)                          \
  F(rgba16f, 8, 4, floating, 64, true, true)                        \
  F(r32f, 4, 1, floating, 32, true, true)                           \
  F(rg32f, 8, 2, floating, 64, true, true)                          \
  F(rgba32f, 16, 4, floating, 128, true, true)                      \
  F(r11f_g11f_b10f, 4, 3, floating, 32, true, true)                 \
  F(rgb10_a2, 4, 4, normalized, 32, true, true)                     \
  F(rgb9_e5, 4, 3, floating, 32, false, false)                      \
  F(r8ui, 1, 1, unsigned_integer, 8, true, true)                    \
  F(r16ui, 2, 1, unsigned_integer, 16, true, true)                  \
  F(r32ui, 4, 1, unsigned_integer, 32, true, true)                  \
  F(rg16ui, 4, 2, unsigned_integer, 32, true, true)                 \
  F(rg32ui, 8, 2, unsigned_integer, 64, true, true)                 \
  F(rgba8ui, 4, 4, unsigned_integer, 32, true, true)                \
  F(rgba16ui, 8, 4, unsigned_integer, 64, true, true)               \
  F(rgba32ui, 16, 4, unsigned_integer, 128, true, true)             \
  F(r32i, 4, 1, signed_integer, 32, true, true)                     \
  F(rg32i, 8, 2, signed_integer, 64, true, true)                    \
  F(rgba32i, 16, 4, signed_integer, 128, true, true)                \
  F(depth16, 2, 1, depth, kOwnClass, false, false)                  \
  F(depth24, 4, 1, depth, kOwnClass, false, false)                  \
  F(depth32f, 4, 1, depth, kOwnClass, false, false)                 \
  F(depth24_stencil8, 4, 1, depth_stencil, kOwnClass, false, false) \
  F(depth32f_stencil8, 8, 1, depth_stencil, kOwnClass, false, false)

enum class Format : std::uint8_t {
  none,
#define WEFT_FORMAT(name, ...) name,
  WEFT_FORMATS(WEFT_FORMAT)
#undef WEFT_FORMAT
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
