#pragma once

#include "engine/imports/environment/environment_texture.h"
#include "engine/imports/import.h"

namespace weft::imports {

class EnvironmentProvider : public Provider {
 public:
  // For sending the next environment beside the one in use.
  EnvironmentTextures& textures() { return textures_; }

  gl::TextureRef texture(const Frame& frame, base::Diagnostics& diagnostics) override;
  std::uint64_t generation(const Frame& frame) override { return frame.world.environmentGeneration(); }
  bool isStill(const World&) const override { return true; }
  std::shared_ptr<const gl::Texture> hold() const override { return textures_.current(); }
  bool isPending(const World& world) const override { return world.environmentPending(); }
  // Always kept, because what the world has dropped cannot be uploaded again.
  bool renew(bool) override { return true; }
  void dropUploaded(World& world) const override;

 private:
  EnvironmentTextures textures_;
};

}  // namespace weft::imports
