#pragma once

#include "engine/imports/environment/environment_texture.h"
#include "engine/imports/import.h"

namespace weft::imports {

class Environment : public Import {
 public:
  graph::ImportType reflect() const override;
  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files& files) const override;
  std::string standInGraph() const override;
  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override;
};

class EnvironmentProvider : public Provider {
 public:
  // For sending the next environment beside the one in use.
  EnvironmentTextures& textures() { return textures_; }

  gl::TextureRef texture(const Frame& frame, base::Diagnostics& diagnostics) override;
  std::uint64_t generation(const Frame& frame) override;
  bool isStill(const World&) const override { return true; }
  gl::TextureRef shown(const Frame& frame, base::Diagnostics& diagnostics) override;
  void publish(const Frame& frame) override;
  bool isPublished(const Frame& frame) const override;
  std::uint64_t publications(const Frame& frame) const override;
  void adopt(gl::Texture shown) override;
  bool isPending(const World& world) const override { return world.environmentPending(); }
  bool needsStandIn(const World& world) const override;
  void setStandIn(gl::TextureRef texture) override { standIn_ = texture; }
  // Always kept, because what the world has dropped cannot be uploaded again.
  bool renew(bool) override { return true; }
  void dropUploaded(World& world) const override;

 private:
  EnvironmentTextures textures_;
  gl::TextureRef standIn_;
};

}  // namespace weft::imports
