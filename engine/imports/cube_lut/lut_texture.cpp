#include "engine/imports/cube_lut/lut_texture.h"

#include <algorithm>
#include <span>
#include <vector>

namespace weft::imports {

namespace {

constexpr std::uint32_t kRow = 1024, kLeast = 8;  // entries; what the alpha of a 1D table needs

}  // namespace

std::shared_ptr<const assets::CubeLut> tableOf(Files& files, const std::string& path,
                                               base::Diagnostics& diagnostics) {
  return files.get<assets::CubeLut>(path, assets::loadCubeLut, diagnostics);
}

gl::Extent lutExtent(const assets::CubeLut& lut) {
  const auto n = static_cast<std::uint32_t>(lut.size);
  if (lut.dimensions == 3) return {n, n, n};
  return {std::clamp(n, kLeast, kRow), (n + kRow - 1) / kRow, 2};
}

std::optional<gl::Texture> makeLutTexture(const assets::CubeLut& lut, const std::string& label,
                                          base::Diagnostics& diagnostics) {
  const gl::Extent extent = lutExtent(lut);
  const gl::TextureDesc desc{.target = GL_TEXTURE_3D,
                             .format = GL_RGBA16F,
                             .width = extent.width,
                             .height = extent.height,
                             .depth = extent.layers,
                             .layers = 1};
  auto texture = gl::Texture::create(desc, label, diagnostics);
  if (!texture) return std::nullopt;
  const std::size_t n = extent.width, area = n * extent.height, entries = lut.texels.size() / 3;
  std::vector<float> slice(area * 4);
  for (std::uint32_t z = 0; z < extent.layers; ++z) {
    const std::size_t first = lut.dimensions == 3 ? z * area : 0;
    for (std::size_t i = 0; i < area; ++i) {
      const std::size_t entry = std::min(first + i, entries - 1);
      std::copy_n(lut.texels.begin() + static_cast<std::ptrdiff_t>(entry * 3), 3,
                  slice.begin() + static_cast<std::ptrdiff_t>(i * 4));
      slice[i * 4 + 3] = 1;
    }
    const auto alpha = [&](std::size_t texel) -> float& { return slice[texel * 4 + 3]; };
    const auto domain = [&](std::size_t texel, std::size_t channel) {
      alpha(texel) = lut.domainMin[channel];
      alpha(texel + 1) = lut.domainMax[channel];
    };
    if (lut.dimensions == 1) {
      for (std::size_t channel = 0; channel < 3; ++channel) domain(channel * 2, channel);
      alpha(6) = static_cast<float>(lut.size / static_cast<int>(kRow));
      alpha(7) = static_cast<float>(lut.size % static_cast<int>(kRow));
    } else if (z == 0) {
      domain(0, 0);
      domain(n, 1);
    } else if (z == 1) {
      domain(0, 2);
    }
    gl::uploadTexture(texture->ref(), 0, z, GL_RGBA, GL_FLOAT, std::as_bytes(std::span(slice)));
  }
  return texture;
}

}  // namespace weft::imports
