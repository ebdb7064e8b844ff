// The uniforms of a running plan: the values of parameters, the View block and the slices of each pass, in one buffer.
// UniformValues knows the values, UniformArena the bytes; this brings both up to date in a frame. Does not: decide which
// passes run, or bind the buffer. A frame allocates nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "engine/base/diagnostic.h"
#include "engine/graph/plan.h"
#include "engine/runtime/cadence/cadence.h"
#include "engine/runtime/imports/imports.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/uniforms/uniform_arena.h"
#include "engine/runtime/uniforms/uniform_values.h"

namespace weft::runtime {

class FrameUniforms {
 public:
  // `plan` and `imports` must outlive this. `alignment` of blocks in bytes, as the device wants it.
  FrameUniforms(const graph::Plan& plan, Imports& imports, std::uint32_t alignment)
      : plan_(plan), imports_(imports), arena_(alignment), values_(*plan.graph) {}

  // Gives the blocks of all prepared passes their places, and writes the values that do not change with time. False when the
  // buffer cannot be made; see UniformArena::layOut().
  bool layOut(std::span<PreparedPass> passes, base::Diagnostics& diagnostics);

  // Writes what changes from frame to frame, the values of age(), the View block and how often draws draw, of all passes or of `always` ones only.
  // `passes` per step; `ageOf(resource)` in seconds.
  void refresh(std::span<PreparedPass> passes, const std::function<double(std::uint32_t)>& ageOf,
               bool alwaysOnly);
  // Tells pass type and shader which part of its work the pass does in this frame.
  void setSlices(PreparedPass& pass, const SliceRange& range);
  // Sends the bytes when one has changed since the last call.
  void upload() { arena_.upload(); }

  // The values of the plan's parameters, parallel to FlatGraph::parameters: those of the plan, or those set since.
  std::span<const graph::Value> parameters() const { return values_.parameters(); }
  // Sets a live parameter for the next frame. False when that takes another plan; then nothing has changed, and making
  // that plan says what is wrong with the value, if anything. See UniformValues::set().
  bool set(std::string_view path, const graph::Value& value) { return values_.set(path, value, arena_); }

  // The bytes, with the changes that set() made since the last frame.
  const UniformArena& arena() const { return arena_; }

 private:
  const graph::Plan& plan_;
  Imports& imports_;
  UniformArena arena_;
  UniformValues values_;
};

}  // namespace weft::runtime
