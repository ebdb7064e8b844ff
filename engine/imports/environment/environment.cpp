#include "engine/imports/environment/environment.h"

#include <utility>

#include "engine/imports/builtin.h"

namespace weft::imports {

std::optional<gl::Texture> EnvironmentProvider::create(const assets::EnvironmentMap& map,
                                                       text::Diagnostics& diagnostics) {
  return gl::Texture::create({.format = GL_RGBA16F,
                              .width = map.width,
                              .height = map.height,
                              .mips = gl::mipsOf(map.width, map.height)},
                             "@environment", diagnostics);
}

graph::ImportType EnvironmentProvider::reflect() {
  return {.name = "environment",
          .kind = graph::ImportKind::texture,
          .doc = "The loaded environment, equirectangular RGBA16F with a full mip chain, row 0 at +Y.",
          .arguments = {}};
}

graph::ImportFacts EnvironmentProvider::facts(const graph::ImportRequest&, const WorldFacts& world, Files&) {
  return {.exists = world.environment,
          .fallback = "graphs/daylight.json",
          .format = graph::Format::rgba16f,
          .width = world.environmentWidth,
          .height = world.environmentHeight,
          .mips = gl::mipsOf(world.environmentWidth, world.environmentHeight)};
}

std::unique_ptr<Import> makeEnvironment() {
  return std::make_unique<ImportOf<EnvironmentProvider>>();
}

gl::TextureRef EnvironmentProvider::texture(const Frame& frame, text::Diagnostics& diagnostics) {
  const auto& map = frame.world.environment();
  if (!map) return {};
  if (map_ != map)
    if (auto made = create(*map, diagnostics)) {
      // Row 0 of the map is its top row, and row 0 of the texture is +Y: the same order.
      glTextureSubImage2D(made->id(), 0, 0, 0, static_cast<GLsizei>(map->width),
                          static_cast<GLsizei>(map->height), GL_RGBA, GL_HALF_FLOAT, map->texels.data());
      glGenerateTextureMipmap(made->id());
      current_ = std::make_shared<const gl::Texture>(std::move(*made));
      map_ = map;
    }
  return current_ ? current_->ref() : gl::TextureRef{};
}

}  // namespace weft::imports
