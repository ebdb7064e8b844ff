#include "engine/imports/environment/environment.h"

#include "engine/imports/builtin.h"

namespace weft::imports {

namespace {

class Environment : public Import {
 public:
  graph::ImportType reflect() const override {
    return {.name = "environment",
            .kind = graph::ImportKind::texture,
            .doc = "The loaded environment, equirectangular RGBA16F with a full mip chain, row 0 at +Y.",
            .arguments = {}};
  }

  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    return {.exists = world.environment,
            .fallback = true,
            .format = graph::Format::rgba16f,
            .width = world.environmentWidth,
            .height = world.environmentHeight,
            .mips = fullMips(world.environmentWidth, world.environmentHeight)};
  }

  std::string standInGraph() const override { return "graphs/daylight.json"; }

  std::unique_ptr<Provider> provide(const graph::ImportRequest&) const override {
    return std::make_unique<EnvironmentProvider>();
  }
};

}  // namespace

std::unique_ptr<Import> makeEnvironment() {
  return std::make_unique<Environment>();
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
