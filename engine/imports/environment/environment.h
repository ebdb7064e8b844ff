// The environment on the GPU, and one being sent beside it. A new one is sent in portions, one per frame, and taken into use
// whole: with all its levels, and when the GPU has them. When to switch is decided from outside (app/live/live_loads.h).
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
  using Map = std::shared_ptr<const assets::EnvironmentMap>;
  static graph::ImportType reflect();
  static graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&);

  // One frame's portion. Copying 4 MiB takes about a millisecond, little beside a frame of 16; a 1k map is
  // there in one frame, an 8k map (256 MiB) in 64 frames, about a second at 60 Hz.
  static constexpr std::size_t kBytesPerFrame = std::size_t{4} << 20;
  // Call once per frame with the same map: sends the next portion beside the texture in use. 1 when use()
  // will take it without another upload. Another map drops what was sent of the one before. Empty when the
  // GPU has no room: W116.
  std::optional<float> send(const Map& map, text::Diagnostics& diagnostics);
  void stopSending() { incoming_ = {}; }
  // Makes `map` the newest: the texture that was sent, or one uploaded here and now. False after errors, and
  // the newest stays. Cheap when it is the newest already; then `map` needs no texels any more.
  bool use(const Map& map, text::Diagnostics& diagnostics);

  gl::TextureRef texture(const Frame& frame, text::Diagnostics& diagnostics) override;
  std::uint64_t generation(const Frame& frame) override { return frame.world.environmentGeneration(); }
  bool isStill(const World&) const override { return true; }
  std::shared_ptr<const gl::Texture> hold() const override { return current_; }
  bool isPending(const World& world) const override { return world.environmentPending(); }
  // Always kept, because what the world has dropped cannot be uploaded again.
  bool renew(bool) override { return true; }
  void dropUploaded(World& world) const override;

 private:
  struct Incoming {
    Map map;
    gl::Texture texture;
    std::uint32_t rows = 0;  // that are sent
    gl::Fence last;          // behind the levels, which are made when all rows are sent
  };
  bool isNewest(const assets::EnvironmentMap& map) const { return current_ && currentId_ == map.id; }

  Incoming incoming_;
  std::uint64_t currentId_ = 0;
  std::shared_ptr<const gl::Texture> current_;  // null: none was used yet
};

}  // namespace weft::imports
