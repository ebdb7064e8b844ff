#include "engine/assets/cube_lut.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/imports/builtin.h"
#include "engine/text/files/file_cache.h"

namespace weft::imports {

namespace {

constexpr std::uint32_t kRow = 1024, kLeast = 8;  // entries; what the alpha of a 1D table needs

// The size of the texture: 3D, size^3, and slices for the curves of a shaper behind them; of three curves alone rows of 1024
// entries. Those have two slices, because a 3D texture of one would be taken for a 2D one.
gl::Extent lutExtent(const assets::CubeLut& lut) {
  const auto n = static_cast<std::uint32_t>(lut.size);
  if (lut.dimensions == 1) return {std::clamp(n, kLeast, kRow), (n + kRow - 1) / kRow, 2};
  const std::uint32_t curves =
      lut.shaper ? std::max(static_cast<std::uint32_t>(lut.shaper->size), kLeast) : 0;
  return {n, n, n + (curves + n * n - 1) / (n * n)};
}

// One slice of curves, from entry `first` on. The alpha of the first six entries has the minimum and the maximum of red, green
// and blue, then comes how often 1024 goes into the number of entries, then the rest.
void fillCurves(std::span<float> slice, const assets::CubeLut& lut, std::size_t first) {
  std::vector<float> numbers;
  for (std::size_t c = 0; c < 3; ++c) numbers.insert(numbers.end(), {lut.domainMin[c], lut.domainMax[c]});
  for (const int part : {lut.size / static_cast<int>(kRow), lut.size % static_cast<int>(kRow)})
    numbers.push_back(static_cast<float>(part));
  for (std::size_t i = 0; i * 4 < slice.size(); ++i) {
    const std::size_t entry = std::min(first + i, static_cast<std::size_t>(lut.size) - 1);
    for (std::size_t c = 0; c < 3; ++c) slice[i * 4 + c] = lut.texels[entry * 3 + c];
    slice[i * 4 + 3] = first + i < numbers.size() ? numbers[first + i] : 1;
  }
}

// One slice of a cube. In the eight corners that every size has, alpha has the minimum of red, green and blue in texels (0,0,0),
// (0,1,0), (0,0,1), the maximum one step along x from each.
void fillCube(std::span<float> slice, const assets::CubeLut& lut, std::size_t z) {
  const auto n = static_cast<std::size_t>(lut.size);
  for (std::size_t i = 0; i < n * n; ++i) {
    for (std::size_t c = 0; c < 3; ++c) slice[i * 4 + c] = lut.texels[(z * n * n + i) * 3 + c];
    slice[i * 4 + 3] = 1;
  }
  const auto domain = [&](std::size_t texel, std::size_t channel) {
    slice[texel * 4 + 3] = lut.domainMin[channel];
    slice[texel * 4 + 7] = lut.domainMax[channel];
  };
  if (z == 0) domain(0, 0), domain(n, 1);
  if (z == 1) domain(0, 2);
}

// RGBA16F, red along x.
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
  const std::size_t area = std::size_t{extent.width} * extent.height;
  const std::uint32_t cubes = lut.dimensions == 3 ? static_cast<std::uint32_t>(lut.size) : 0;
  std::vector<float> slice(area * 4);
  for (std::uint32_t z = 0; z < extent.layers; ++z) {
    if (z < cubes)
      fillCube(slice, lut, z);
    else
      fillCurves(slice, lut.shaper ? *lut.shaper : lut, (z - cubes) * area);
    gl::uploadTexture(texture->ref(), 0, z, GL_RGBA, GL_FLOAT, std::as_bytes(std::span(slice)));
  }
  return texture;
}

class CubeLutProvider : public Provider {
 public:
  static graph::ImportType reflect() {
    return {.name = "cube_lut",
            .kind = graph::ImportKind::texture,
            .doc =
                "A .cube table, 3D or 1D, as an RGBA16F 3D texture for composite/lut.glsl; not there when "
                "`file` is empty.",
            .arguments = {argument("file", graph::Value::text(""), "path of the .cube file")}};
  }

  static graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts&, Files& files) {
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

  explicit CubeLutProvider(const graph::ImportRequest& request) : file_(request.at("file").symbol) {}

  gl::TextureRef texture(const Frame& frame, text::Diagnostics& diagnostics) override {
    if (file_.empty()) return {};
    if (std::exchange(stale_, false)) {
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

}  // namespace

std::unique_ptr<Import> makeCubeLut() {
  return std::make_unique<ImportOf<CubeLutProvider>>();
}

}  // namespace weft::imports
