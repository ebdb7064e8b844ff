// Sub-resources of a FlatResource as numbers: (layer * mips + mip) * planes + plane. Buffers and 3D depth are
// one. Does not: know plans or storage.
#pragma once

#include <cstdint>

#include "engine/graph/flat_graph.h"

namespace weft::graph {

inline bool isBuffer(const FlatResource& r) {
  return r.kind == ResourceKind::buffer || r.kind == ResourceKind::imported_buffer;
}
inline bool isImported(const FlatResource& r) {
  return r.kind == ResourceKind::imported_texture || r.kind == ResourceKind::imported_buffer;
}

// 2 for depth-stencil formats, else 1.
inline std::uint32_t planesOf(const FlatResource& r) {
  return r.format == Format::depth24_stencil8 || r.format == Format::depth32f_stencil8 ? 2u : 1u;
}

inline std::uint32_t subresourceCount(const FlatResource& r) {
  return isBuffer(r) ? 1u : static_cast<std::uint32_t>(r.mips) * r.layers * planesOf(r);
}

// True when `use` covers every sub-resource of `r`.
inline bool isWhole(const FlatUse& use, const FlatResource& r) {
  if (subresourceCount(r) == 1) return true;
  const std::uint8_t all = planesOf(r) == 2 ? 3 : 1;
  return use.mips >= r.mips && use.layers >= r.layers && (use.planes & all) == all;
}

// Calls f(sub-resource) for each one that `use` covers, ascending.
template <class F>
void forEachSubresource(const FlatUse& use, const FlatResource& r, F&& f) {
  if (isBuffer(r)) {
    f(0u);
    return;
  }
  const std::uint32_t planes = planesOf(r);
  for (std::uint32_t layer = use.layer; layer < std::uint32_t{use.layer} + use.layers; ++layer)
    for (std::uint32_t mip = use.mip; mip < std::uint32_t{use.mip} + use.mips; ++mip)
      for (std::uint32_t plane = 0; plane < planes; ++plane)
        if (planes == 1 || (use.planes >> plane & 1) != 0) f((layer * r.mips + mip) * planes + plane);
}

// Bytes of the part of `r` that `use` covers (one copy). Planes of a depth-stencil texel count half the texel
// each.
std::uint64_t bytesOf(const FlatUse& use, const FlatResource& r);

// What an output brings to the CPU: a buffer's bytes; of textures as many 32-bit numbers per texel as their
// format has channels (depth-stencil: one). And the most that one may bring.
constexpr std::uint64_t kMaxOutputBytes = 64 * 1024;
std::uint32_t outputChannelsOf(const FlatResource& r);
std::uint64_t outputBytesOf(const FlatUse& use, const FlatResource& r);

// A use of all of `r`.
inline FlatUse wholeUse(std::uint32_t index, const FlatResource& r, Kind kind, Access access) {
  FlatUse use;
  use.resource = index;
  use.mips = r.mips;
  use.layers = r.layers;
  use.planes = planesOf(r) == 2 ? 3 : 1;
  use.kind = kind;
  use.access = access;
  return use;
}

}  // namespace weft::graph
