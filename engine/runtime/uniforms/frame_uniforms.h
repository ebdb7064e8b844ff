// The uniforms of a running plan: the values of parameters, the View block and the slices of each pass. The blocks of all
// passes are one after the other in one buffer, whose bytes are kept on the CPU and sent when one has changed. A frame
// allocates nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/runtime/cadence/cadence.h"
#include "engine/runtime/imports/imports.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

class FrameUniforms {
 public:
  // `plan` and `imports` must outlive this. `alignment` of blocks in bytes, as the device wants it.
  FrameUniforms(const graph::Plan& plan, Imports& imports, std::uint32_t alignment);

  // Gives the blocks of all prepared passes their offsets, and writes the values that do not change with time. To be called
  // once. False when the buffer cannot be made.
  bool layOut(std::span<PreparedPass> passes, text::Diagnostics& diagnostics);

  // Writes what changes from frame to frame, the values of age(), the View block and how often draws draw, of all passes or
  // of `always` ones only. `passes` per step; `ageOf(resource)` in seconds.
  void refresh(std::span<PreparedPass> passes, const std::function<double(std::uint32_t)>& ageOf,
               bool alwaysOnly);
  // Tells pass type and shader which part of its work the pass does in this frame.
  void setSlices(PreparedPass& pass, const SliceRange& range);
  // Sends the bytes when one has changed since the last call.
  void upload();

  // The values of the plan's parameters, parallel to FlatGraph::parameters: those of the plan, or those set since.
  std::span<const graph::Value> parameters() const {
    return std::span(parameters_).first(plan_.graph->parameters.size());
  }
  // Sets a live parameter for the next frame: evaluates the expressions that read it and writes their bytes. False, and
  // nothing has changed, when that takes another plan: the parameter is structural or unknown, it does not take the value,
  // or an expression has no result with that value. Allocates nothing for numbers, booleans and lists.
  bool set(std::string_view path, const graph::Value& value);

  // The hash of `seed` and the bytes of a block at an offset; `seed` itself when `layout` is null.
  std::uint64_t hash(std::uint32_t block, const gl::Block* layout, std::uint64_t seed) const;
  std::span<const std::byte> bytes() const { return bytes_; }
  GLuint buffer() const { return buffer_.id(); }

 private:
  // A uniform that reads live parameters.
  struct Reader {
    Field field;
    const graph::Expr* expr = nullptr;
    std::uint32_t block = 0;  // offset of its block
  };
  void fill(PreparedPass& pass);
  void followImports();
  void write(std::uint32_t block, const Field& field, const graph::Value& value);

  const graph::Plan& plan_;
  Imports& imports_;
  std::uint32_t alignment_;
  std::vector<std::byte> bytes_;
  gl::Buffer buffer_;
  bool changed_ = true;
  std::vector<graph::Value> parameters_;                       // and the values of imports behind them
  std::unordered_map<std::string_view, std::size_t> indexOf_;  // of a parameter, by its path in the plan
  std::vector<std::vector<Reader>> readersOf_;                 // of each of these
  std::vector<std::uint64_t> generations_;  // of the imports of FlatGraph::watched, when they were read
  std::vector<graph::Value> results_;       // scratch of set()
};

}  // namespace weft::runtime
