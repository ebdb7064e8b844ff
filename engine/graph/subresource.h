// Sub-resources, for all of the graph core: how a resource is divided, the number of each part, rectangles of parts
// (FlatUse) and whether they overlap, bytes, and the words for kinds and parts in files and messages.
// A sub-resource is one plane of one level of one layer; its number is (plane * layers + layer) * mips + mip, as
// D3D12CalcSubresource counts. A buffer is one sub-resource; a 3D texture is not divided in depth.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <type_traits>

#include "engine/graph/flat_graph.h"

namespace weft::graph {

// ---- how a resource is divided ----

inline bool isBuffer(const FlatResource& r) {
  return r.kind == ResourceKind::buffer || r.kind == ResourceKind::imported_buffer;
}
inline bool isImported(const FlatResource& r) {
  return r.kind == ResourceKind::imported_texture || r.kind == ResourceKind::imported_buffer;
}
// Width, height and depth of a level, in texels.
inline std::array<std::uint32_t, 3> sizeAt(const FlatResource& r, std::uint32_t mip) {
  const std::uint32_t by = std::min(mip, 31u);
  return {std::max(1u, r.width >> by), std::max(1u, r.height >> by), std::max(1u, r.depth >> by)};
}
// Layers of one level, faces included; of a 3D texture its slices there.
inline std::uint32_t slicesOf(const FlatResource& r, std::uint32_t mip) {
  return r.target == Target::texture_3d ? sizeAt(r, mip)[2] : r.layers;
}
inline bool isCube(const FlatResource& r) {
  return r.target == Target::texture_cube || r.target == Target::texture_cube_array;
}

// 2 for depth-stencil formats, else 1.
inline std::uint32_t planesOf(const FlatResource& r) {
  return r.format == Format::depth24_stencil8 || r.format == Format::depth32f_stencil8 ? 2u : 1u;
}
// All planes, as in FlatUse::planes.
inline std::uint8_t planeMask(const FlatResource& r) {
  return planesOf(r) == 2 ? 3 : 1;
}

inline std::uint32_t subresourceCount(const FlatResource& r) {
  return isBuffer(r) ? 1u : static_cast<std::uint32_t>(r.mips) * r.layers * planesOf(r);
}

struct Subresource {
  std::uint32_t mip = 0, layer = 0, plane = 0;
};
inline std::uint32_t indexOf(const Subresource& part, const FlatResource& r) {
  return (part.plane * r.layers + part.layer) * r.mips + part.mip;
}
inline Subresource subresourceAt(std::uint32_t index, const FlatResource& r) {
  return {index % r.mips, index / r.mips % r.layers, index / r.mips / r.layers};
}

// A shader stores to an image or a storage block.
inline bool isStore(const FlatUse& use) {
  const auto kind = 1u << static_cast<unsigned>(use.kind);
  return use.access != Access::read && (kind & (1u << static_cast<unsigned>(Kind::image) |
                                                1u << static_cast<unsigned>(Kind::storage))) != 0;
}

// ---- rectangles ----

// A use of all of `r`.
inline FlatUse wholeUse(std::uint32_t index, const FlatResource& r, Kind kind, Access access) {
  FlatUse use;
  use.resource = index;
  use.mips = r.mips;
  use.layers = r.layers;
  use.planes = planeMask(r);
  use.kind = kind;
  use.access = access;
  return use;
}

// True when `use` covers every sub-resource of `r`.
inline bool isWhole(const FlatUse& use, const FlatResource& r) {
  if (subresourceCount(r) == 1) return true;
  const std::uint8_t all = planeMask(r);
  return use.mips >= r.mips && use.layers >= r.layers && (use.planes & all) == all;
}

inline bool holds(const FlatUse& use, const Subresource& part) {
  return part.mip >= use.mip && part.mip < std::uint32_t{use.mip} + use.mips && part.layer >= use.layer &&
         part.layer < std::uint32_t{use.layer} + use.layers && (use.planes >> part.plane & 1) != 0;
}
// True when two rectangles have a sub-resource in common. They are of one resource, or of two of the same shape.
inline bool overlap(const FlatUse& a, const FlatUse& b) {
  return (a.planes & b.planes) != 0 && a.mip < b.mip + b.mips && b.mip < a.mip + a.mips &&
         a.layer < b.layer + b.layers && b.layer < a.layer + a.layers;
}

// How many sub-resources `use` covers.
inline std::uint32_t subresourceCount(const FlatUse& use, const FlatResource& r) {
  if (isBuffer(r)) return 1;
  const unsigned planes = planesOf(r) == 1 ? 1u : use.planes & 3u;
  return std::uint32_t{use.mips} * use.layers * static_cast<std::uint32_t>(std::popcount(planes));
}

// Calls f(number) for each sub-resource that `use` covers, ascending. An f that returns a bool ends the walk with false.
template <class F>
void forEachSubresource(const FlatUse& use, const FlatResource& r, F&& f) {
  const auto goesOn = [&](std::uint32_t index) {
    if constexpr (std::is_same_v<decltype(f(index)), bool>) return f(index);
    f(index);
    return true;
  };
  if (isBuffer(r)) {
    goesOn(0u);
    return;
  }
  const std::uint32_t planes = planesOf(r);
  for (std::uint32_t plane = 0; plane < planes; ++plane) {
    if (planes == 2 && (use.planes >> plane & 1) == 0) continue;
    for (std::uint32_t layer = use.layer; layer < std::uint32_t{use.layer} + use.layers; ++layer)
      for (std::uint32_t mip = use.mip; mip < std::uint32_t{use.mip} + use.mips; ++mip)
        if (!goesOn(indexOf({mip, layer, plane}, r))) return;
  }
}

// Calls f(number, writer) for each sub-resource that `use` covers; writer is the use that wrote what `use` sees of it.
template <class F>
void forEachVersion(const VersionLinks& links, std::uint32_t link, const FlatUse& use, const FlatResource& r,
                    F&& f) {
  const bool several = VersionLinks::hasRuns(link);
  std::uint32_t at = link & ~VersionLinks::kRuns, left = several ? links.runs[at].count : 0;
  forEachSubresource(use, r, [&](std::uint32_t s) {
    if (several && left == 0) left = links.runs[++at].count;
    f(s, several ? links.runs[at].writer : link);
    --left;
  });
}

// ---- bytes ----

// Bytes of the part of `r` that `use` covers (one copy). Planes of a depth-stencil texel count half the texel each.
std::uint64_t bytesOf(const FlatUse& use, const FlatResource& r);

// An output brings to the CPU the bytes of a buffer, or, of a texture, as many 32-bit numbers per texel as its format has
// channels (one for depth-stencil); at most kMaxOutputBytes.
constexpr std::uint64_t kMaxOutputBytes = 64 * 1024;
std::uint32_t outputChannelsOf(const FlatResource& r);
std::uint64_t outputBytesOf(const FlatUse& use, const FlatResource& r);

// ---- words ----

// The words for Kind and Access, in their order, as files have them behind `as`, and as messages and dumps do.
constexpr std::array<const char*, 8> kKindNames = {"sampled",  "image", "uniform", "storage",
                                                   "indirect", "color", "depth",   "copy"};
constexpr std::array<const char*, 3> kAccessNames = {"read", "write", "modify"};
constexpr const char* nameOf(Kind kind) {
  return kKindNames[static_cast<std::size_t>(kind)];
}
constexpr const char* nameOf(Access access) {
  return kAccessNames[static_cast<std::size_t>(access)];
}

// "reads", "writes", "modifies".
constexpr const char* verbOf(Access access) {
  constexpr const char* kVerbs[] = {"reads", "writes", "modifies"};
  return kVerbs[static_cast<std::size_t>(access)];
}

// "mip 2, layer 1" of a sub-resource of `r`; "" when it has only one.
std::string subresourceText(const FlatResource& r, std::uint32_t index);

}  // namespace weft::graph
