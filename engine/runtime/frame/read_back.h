// Brings to the CPU what a graph's "outputs" held at the end of a frame. After the last step each live output is copied
// into the next of a ring of persistently mapped buffers, followed by a fence; later frames take the copies that have
// arrived. Only finish() waits, and a frame of an unchanged plan allocates nothing. A copy that would have to wait for its
// buffer is left out. A buffer arrives as it is, a texture as 32-bit numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/graph/plan.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/caches.h"
#include "engine/runtime/storage/resource_pool.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

enum class NumberKind : std::uint8_t { floating, unsigned_integer, signed_integer };

// An output and the latest that has arrived of it.
struct Output {
  std::string name;                        // with the include's prefix: "post.exposure"
  NumberKind kind = NumberKind::floating;  // of a buffer: of the shaders' block when all its members agree
  std::uint32_t channels = 0;              // numbers per texel, of a format's channels; 0: a buffer
  std::uint32_t width = 0, height = 0;     // of the first level; rows are bottom first, tightly packed
  std::vector<std::byte> bytes;  // 4 per number; of a texture level by level, in them layer by layer
  bool arrived = false;          // nothing yet: `bytes` are zeros
  std::uint32_t frame = 0;       // FrameInput::frame it is of

  std::size_t count() const { return bytes.size() / 4; }
  double number(std::size_t index) const;  // index < count(); as `kind` says
};

class ReadBack {
 public:
  // The copies of so many frames can be on their way. Outputs arrive fewer frames later than that, unless the GPU is further behind.
  static constexpr std::size_t kRing = 4;

  // Finds the outputs of a plan, and makes buffers for them. When they are those of `before` (which may be null), shares its
  // buffers with the copies that are on their way; else has the values that have arrived of outputs of the same name and
  // shape. False after W117.
  bool prepare(const graph::Plan& plan, std::span<const PreparedPass> passes, ReadBack* before,
               text::Diagnostics& diagnostics);
  // Starts the copies of a frame. To be called at its end, after the plan's last barriers.
  void copy(const graph::Plan& plan, ResourcePool& pool, FramebufferCache& framebuffers, std::uint32_t frame,
            text::Diagnostics& diagnostics);
  // Takes what has arrived; never waits.
  void collect();
  // The same, after waiting for all copies that are on their way.
  void finish();

  // In the order of the graph; live ones only.
  std::span<const Output> outputs() const { return outputs_; }
  // Null when there is none of that name.
  const Output* find(std::string_view name) const;

 private:
  struct Source {
    std::uint32_t use = 0;     // into FlatGraph::outputs
    std::uint64_t offset = 0;  // in a slot's buffer
  };
  struct Slot {
    gl::Buffer buffer;
    const std::byte* mapped = nullptr;
    gl::Fence fence;  // behind the copies of `frame`; none: the slot is free
    std::uint32_t frame = 0;
  };
  struct Ring {
    std::array<Slot, kRing> slots;
    std::size_t next = 0;  // the oldest
    Slot& at(std::size_t i) { return slots[(next + i) % kRing]; }
  };
  bool createRing(std::uint64_t bytes, text::Diagnostics& diagnostics);
  void copyTexture(const graph::Plan& plan, const graph::FlatUse& use, ResourcePool& pool,
                   FramebufferCache& framebuffers, const Slot& slot, std::uint64_t offset,
                   text::Diagnostics& diagnostics);
  void take(const Slot& slot);

  std::vector<Output> outputs_;
  std::vector<Source> sources_;  // parallel
  std::shared_ptr<Ring> ring_;   // null: there is no output
};

}  // namespace weft::runtime
