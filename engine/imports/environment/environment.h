// The environment on the GPU: the newest map, uploaded with all its levels when a frame first asks for it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/assets/images/image.h"
#include "engine/gl/objects/objects.h"
#include "engine/imports/import.h"
#include "engine/text/diagnostic.h"

namespace weft::imports {

class EnvironmentProvider : public Provider {
 public:
  static graph::ImportType reflect();
  static graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&);

  // A texture for `map`, without texels yet. Empty when the GPU has no room: W116.
  static std::optional<gl::Texture> create(const assets::EnvironmentMap& map, text::Diagnostics& diagnostics);

  gl::TextureRef texture(const Frame& frame, text::Diagnostics& diagnostics) override;
  std::uint64_t generation(const Frame& frame) override { return frame.world.environmentGeneration(); }
  bool isStill(const World&) const override { return true; }
  std::shared_ptr<const gl::Texture> hold() const override { return current_; }
  bool isPending(const World& world) const override { return world.environmentPending(); }

 private:
  std::shared_ptr<const assets::EnvironmentMap> map_;  // that `current_` has
  std::shared_ptr<const gl::Texture> current_;         // null: none was used yet
};

}  // namespace weft::imports
