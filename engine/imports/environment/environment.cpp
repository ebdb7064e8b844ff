#include "engine/imports/environment/environment.h"

namespace weft::imports {

graph::ImportType Environment::reflect() const {
  return {.name = "environment",
          .kind = graph::ImportKind::texture,
          .doc = "The loaded environment, equirectangular RGBA16F with a full mip chain, row 0 at +Y.",
          .arguments = {}};
}

graph::ImportFacts Environment::facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const {
  return {.exists = world.environment,
          .fallback = true,
          .format = graph::Format::rgba16f,
          .width = world.environmentWidth,
          .height = world.environmentHeight,
          .mips = fullMips(world.environmentWidth, world.environmentHeight)};
}

std::string Environment::standInGraph() const {
  return "graphs/daylight.json";
}

std::unique_ptr<Provider> Environment::provide(const graph::ImportRequest&) const {
  return std::make_unique<EnvironmentProvider>();
}

gl::TextureRef EnvironmentProvider::texture(const Frame& frame, base::Diagnostics& diagnostics) {
  if (!frame.world.environment()) return {};
  textures_.use(frame.world.environment(), diagnostics);
  return textures_.current() ? textures_.current()->ref() : gl::TextureRef{};
}

void EnvironmentProvider::dropUploaded(World& world) const {
  const auto& map = world.environment();
  if (map && textures_.isNewest(*map)) world.dropEnvironmentTexels();
}

}  // namespace weft::imports
