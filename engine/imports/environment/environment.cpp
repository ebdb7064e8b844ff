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
  if (!frame.world.environment()) return standIn_;
  textures_.use(frame.world.environment(), diagnostics);
  return textures_.current();
}

// A stand-in is shown at once: nothing is ever published instead of it.
gl::TextureRef EnvironmentProvider::shown(const Frame& frame, base::Diagnostics& diagnostics) {
  return frame.world.environment() ? textures_.shown() : texture(frame, diagnostics);
}

void EnvironmentProvider::publish(const Frame& frame) {
  if (frame.world.environment()) textures_.publish();
}

bool EnvironmentProvider::isPublished(const Frame& frame) const {
  return !frame.world.environment() || textures_.isPublished();
}

std::uint64_t EnvironmentProvider::publications(const Frame& frame) const {
  return frame.world.environment() ? textures_.publications() : 0;
}

void EnvironmentProvider::adopt(gl::Texture shown) {
  textures_.adopt(std::move(shown));
}

std::uint64_t EnvironmentProvider::generation(const Frame& frame) {
  if (frame.world.environment()) return frame.world.environmentGeneration();
  return standIn_.id ? std::uint64_t{1} << 32 : 0;
}

bool EnvironmentProvider::needsStandIn(const World& world) const {
  return !world.environment() && !world.environmentPending() && !standIn_.id;
}

void EnvironmentProvider::dropUploaded(World& world) const {
  const auto& map = world.environment();
  if (map && textures_.isNewest(*map)) world.dropEnvironmentTexels();
}

}  // namespace weft::imports
