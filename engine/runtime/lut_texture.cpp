#include "engine/runtime/lut_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace weft::runtime {

std::optional<assets::CubeLut> loadLut(const std::string& path, base::Diagnostics& diagnostics) {
  auto lut = assets::loadCubeLut(path, diagnostics);
  if (!lut || lut->dimensions == 3) return lut;
  base::Diagnostic& d = diagnostics.error(base::Code::W154, {std::make_shared<const std::string>(path), 0, 0},
                                          fmt::format("'{}' is a 1D table; cube_lut takes 3D ones", path));
  d.expected = "LUT_3D_SIZE";
  d.found = "LUT_1D_SIZE";
  return std::nullopt;
}

std::optional<gl::Texture> makeLutTexture(const assets::CubeLut& lut, const std::string& label,
                                          base::Diagnostics& diagnostics) {
  const auto n = static_cast<std::uint32_t>(lut.size);
  const gl::TextureDesc desc{
      .target = GL_TEXTURE_3D, .format = GL_RGBA16F, .width = n, .height = n, .depth = n, .layers = 1};
  auto texture = gl::Texture::create(desc, label, diagnostics);
  if (!texture) return std::nullopt;
  const std::size_t area = std::size_t{n} * n;
  std::vector<float> slice(area * 4);
  for (std::uint32_t z = 0; z < n; ++z) {
    for (std::size_t i = 0; i < area; ++i) {
      std::copy_n(lut.texels.begin() + static_cast<std::ptrdiff_t>((z * area + i) * 3), 3,
                  slice.begin() + static_cast<std::ptrdiff_t>(i * 4));
      slice[i * 4 + 3] = 1;
    }
    const auto domain = [&](std::size_t y, std::size_t channel) {
      slice[y * n * 4 + 3] = lut.domainMin[channel];
      slice[(y * n + 1) * 4 + 3] = lut.domainMax[channel];
    };
    if (z == 0) {
      domain(0, 0);
      domain(1, 1);
    } else if (z == 1) {
      domain(0, 2);
    }
    gl::uploadTexture(texture->ref(), 0, z, GL_RGBA, GL_FLOAT, std::as_bytes(std::span(slice)));
  }
  return texture;
}

}  // namespace weft::runtime
