#include "engine/imports/environment/environment.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/imports/builtin.h"

namespace weft::imports {

namespace {

// The share of a transfer that is sending the rows. The rest is the GPU, which makes the levels.
constexpr float kShareOfRows = 0.9f;

class Environment : public ImportOf<EnvironmentProvider> {
 public:
  std::string standInGraph() const override { return "graphs/daylight.json"; }
};

}  // namespace

std::optional<float> EnvironmentProvider::send(const Map& map, text::Diagnostics& diagnostics) {
  if (incoming_.map != map) {
    incoming_ = {};
    const gl::TextureDesc desc{.format = GL_RGBA16F,
                               .width = map->width,
                               .height = map->height,
                               .mips = gl::mipsOf(map->width, map->height)};
    if (!gl::remake(incoming_.texture, desc, "@environment", diagnostics)) return std::nullopt;
    incoming_.map = map;
  }
  // Row 0 of the map is its top row, and row 0 of the texture is +Y: the same order.
  if (incoming_.rows < map->height) {
    const std::size_t rowBytes = std::size_t{map->width} * 4 * sizeof(std::uint16_t);
    const auto rows = static_cast<std::uint32_t>(
        std::clamp<std::size_t>(kBytesPerFrame / rowBytes, 1, map->height - incoming_.rows));
    glTextureSubImage2D(incoming_.texture.id(), 0, 0, static_cast<GLint>(incoming_.rows),
                        static_cast<GLsizei>(map->width), static_cast<GLsizei>(rows), GL_RGBA, GL_HALF_FLOAT,
                        map->texels.data() + incoming_.rows * rowBytes / sizeof(std::uint16_t));
    incoming_.rows += rows;
    if (incoming_.rows < map->height)
      return kShareOfRows * static_cast<float>(incoming_.rows) / static_cast<float>(map->height);
    glGenerateTextureMipmap(incoming_.texture.id());
    incoming_.last = gl::Fence::insert();
  }
  return incoming_.last.isSignalled() ? 1.0f : kShareOfRows;
}

bool EnvironmentProvider::use(const Map& map, text::Diagnostics& diagnostics) {
  if (isNewest(*map)) return true;
  assert(!map->texels.empty() && "dropped before they were used here");
  do
    if (!send(map, diagnostics)) return false;
  while (incoming_.rows < map->height);
  current_ = std::make_shared<const gl::Texture>(std::move(incoming_.texture));
  incoming_ = {};
  currentId_ = map->id;
  return true;
}

graph::ImportType EnvironmentProvider::reflect() {
  return {.name = "environment",
          .kind = graph::ImportKind::texture,
          .doc = "The loaded environment, equirectangular RGBA16F with a full mip chain, row 0 at +Y.",
          .arguments = {}};
}

graph::ImportFacts EnvironmentProvider::facts(const graph::ImportRequest&, const WorldFacts& world, Files&) {
  return {.exists = world.environment,
          .fallback = true,
          .format = graph::Format::rgba16f,
          .width = world.environmentWidth,
          .height = world.environmentHeight,
          .mips = gl::mipsOf(world.environmentWidth, world.environmentHeight)};
}

std::unique_ptr<Import> makeEnvironment() {
  return std::make_unique<Environment>();
}

gl::TextureRef EnvironmentProvider::texture(const Frame& frame, text::Diagnostics& diagnostics) {
  if (!frame.world.environment()) return {};
  use(frame.world.environment(), diagnostics);
  return current_ ? current_->ref() : gl::TextureRef{};
}

void EnvironmentProvider::dropUploaded(World& world) const {
  const auto& map = world.environment();
  if (map && isNewest(*map)) world.dropEnvironmentTexels();
}

}  // namespace weft::imports
