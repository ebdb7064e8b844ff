#include "engine/assets/cube_lut.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/imports/builtin.h"
#include "engine/imports/files.h"

namespace weft::imports {

namespace {

constexpr std::uint32_t kRow = 1024, kLeast = 8;  // entries; what the alpha of a 1D table needs

// The size of the texture: 3D, size^3, or for three curves rows of 1024 entries. Those have two slices,
// because a 3D texture of one would be taken for a 2D one; the second is as the first.
gl::Extent lutExtent(const assets::CubeLut& lut) {
  const auto n = static_cast<std::uint32_t>(lut.size);
  if (lut.dimensions == 3) return {n, n, n};
  return {std::clamp(n, kLeast, kRow), (n + kRow - 1) / kRow, 2};
}

// RGBA16F, red along x. Alpha carries the domain. 3D: in the eight corners that every size has, the minimum
// of red, green and blue in texels (0,0,0), (0,1,0), (0,0,1), the maximum one step along x from each. 1D:
// minimum and maximum in the first six texels, then how often 1024 goes into the number of entries, then the
// rest.
std::optional<gl::Texture> makeLutTexture(const assets::CubeLut& lut, const std::string& label,
                                          text::Diagnostics& diagnostics) {
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

class CubeLutProvider : public Provider {
 public:
  explicit CubeLutProvider(const graph::ImportRequest& request) : file_(request.at("file").symbol) {}

  gl::TextureRef texture(const Frame& frame, text::Diagnostics& diagnostics) override {
    if (file_.empty()) return {};
    if (stale_) {
      stale_ = false;
      const auto table = frame.files.get<assets::CubeLut>(file_, assets::loadCubeLut, diagnostics);
      auto texture = table && table != table_ ? makeLutTexture(*table, file_, diagnostics) : std::nullopt;
      if (texture) {
        table_ = table;
        texture_ = std::move(*texture);
        generation_ = frame.newGeneration();
      }
    }
    return texture_ ? texture_.ref() : gl::TextureRef{};
  }
  std::uint64_t generation(const Frame&) override { return generation_; }
  bool isStill(const World&) const override { return true; }
  bool renew(bool used) override {
    stale_ = true;
    return used;
  }

 private:
  std::string file_;
  std::shared_ptr<const assets::CubeLut> table_;  // what the texture holds
  gl::Texture texture_;
  std::uint64_t generation_ = 0;
  bool stale_ = true;
};

class CubeLut : public ImportOf<CubeLutProvider> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "cube_lut",
            .kind = graph::ImportKind::texture,
            .doc =
                "A .cube table, 3D or 1D, as an RGBA16F 3D texture for composite/lut.glsl; not there when "
                "`file` is empty.",
            .arguments = {argument("file", graph::Value::text(""), "path of the .cube file")}};
  }

  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts&,
                           Files& files) const override {
    graph::ImportFacts result;
    const std::string& file = request.at("file").symbol;
    if (file.empty()) return result;
    text::Diagnostics said;
    if (const auto lut = files.get<assets::CubeLut>(file, assets::loadCubeLut, said)) {
      const gl::Extent extent = lutExtent(*lut);
      result.exists = true;
      result.format = graph::Format::rgba16f;
      result.width = extent.width;
      result.height = extent.height;
      result.depth = extent.layers;
    }
    result.problems = said.items();
    return result;
  }
};

}  // namespace

std::unique_ptr<Import> makeCubeLut() {
  return std::make_unique<CubeLut>();
}

}  // namespace weft::imports
