// The environment on the GPU: the one in use, the one being sent beside it, and on request the one in use
// before. A new one is sent in portions, one per frame, and taken into use whole: with all its levels, and
// when the GPU has them. At most three textures exist at once. Does not: decode files (assets::Loader does),
// or decide when to switch.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/assets/environment_map.h"
#include "engine/base/diagnostic.h"
#include "engine/gl/objects.h"
#include "engine/gl/pixel_stream.h"

namespace weft::runtime {

class EnvironmentTextures {
 public:
  using Map = std::shared_ptr<const assets::EnvironmentMap>;
  // One frame's portion. Copying 4 MiB takes about a millisecond, little beside a frame of 16; a 1k map is
  // there in one frame, an 8k map (256 MiB) in 64 frames, about a second at 60 Hz.
  static constexpr std::size_t kBytesPerFrame = std::size_t{4} << 20;

  // Call once per frame with the same map: sends the next portion beside the texture in use. 1 when use()
  // will take it without another upload. Another map drops what was sent of the one before. Empty when the
  // GPU has no room: W116, W117.
  std::optional<float> send(const Map& map, base::Diagnostics& diagnostics);
  void stopSending() { incoming_ = {}; }

  // Makes `map` the one in use: the texture that was sent, or one uploaded here and now. False after errors,
  // and the one in use stays. Cheap when it is in use already.
  bool use(const Map& map, base::Diagnostics& diagnostics);
  gl::TextureRef current() const { return current_ ? current_.ref() : gl::TextureRef{}; }

  // Whether use() keeps the texture it replaces, until the next one or keepBefore(false). Off at first.
  void keepBefore(bool keep);
  gl::TextureRef before() const { return before_ ? before_.ref() : gl::TextureRef{}; }

 private:
  struct Incoming {
    Map map;
    gl::Texture texture;
    std::optional<gl::PixelStream> stream;
    gl::Fence levels;  // behind the making of the levels, once all rows are sent
  };
  Incoming incoming_;
  Map currentMap_;
  gl::Texture current_, before_;
  bool keep_ = false;
};

}  // namespace weft::runtime
