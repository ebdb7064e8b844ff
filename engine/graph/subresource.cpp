#include "engine/graph/subresource.h"

namespace weft::graph {

namespace {

// Texels of all levels and layers of the part that `use` covers.
std::uint64_t texelsOf(const FlatUse& use, const FlatResource& r) {
  std::uint64_t total = 0;
  for (std::uint32_t mip = use.mip; mip < std::uint32_t{use.mip} + use.mips; ++mip) {
    const auto [width, height, depth] = sizeAt(r, mip);
    total += std::uint64_t{width} * height * depth;
  }
  return total * use.layers;
}

}  // namespace

std::uint64_t bytesOf(const FlatUse& use, const FlatResource& r) {
  if (isWhole(use, r)) return r.bytes;
  const std::uint64_t total = texelsOf(use, r) * infoOf(r.format).bytes * r.samples;
  return planesOf(r) == 2 && (use.planes & 3) != 3 ? total / 2 : total;
}

std::uint32_t outputChannelsOf(const FlatResource& r) {
  return isDepth(r.format) ? 1u : infoOf(r.format).channels;
}

std::uint64_t outputBytesOf(const FlatUse& use, const FlatResource& r) {
  return isBuffer(r) ? r.bytes : texelsOf(use, r) * outputChannelsOf(r) * 4;
}

std::string subresourceText(const FlatResource& r, std::uint32_t index) {
  const Subresource part = subresourceAt(index, r);
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
  if (r.mips > 1) add("mip " + std::to_string(part.mip));
  const bool cube = isCube(r);
  if (r.target == Target::texture_2d_array || r.target == Target::texture_cube_array)
    add("layer " + std::to_string(cube ? part.layer / 6 : part.layer));
  if (cube) add("face " + std::to_string(part.layer % 6));
  if (planesOf(r) == 2 && part.plane == 1) add("stencil");
  return text;
}

}  // namespace weft::graph
