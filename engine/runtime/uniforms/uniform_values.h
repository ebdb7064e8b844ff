// The value of each uniform while a plan runs. Some never change, some change with time (age), and some read live
// parameters, which can be set between two frames. Does not: know where the bytes lie (uniform_arena.h).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/graph/flat_graph.h"
#include "engine/runtime/uniforms/uniform_arena.h"

namespace weft::runtime {

class UniformValues {
 public:
  // Parameters have the values that `graph` was made with. It must outlive this.
  explicit UniformValues(const graph::FlatGraph& graph);

  // Parallel to FlatGraph::parameters.
  std::span<const graph::Value> parameters() const { return parameters_; }

  // Writes all values that do not change with time, and lists in each pass those that do. `passes` must have been laid out
  // in `arena`.
  void fill(std::span<PreparedPass> passes, UniformArena& arena);
  // Writes what changes with time. `ageOf(resource)` in seconds.
  void refresh(const PreparedPass& pass, const std::function<double(std::uint32_t)>& ageOf,
               UniformArena& arena) const;
  // Sets a live parameter: evaluates the expressions that read it and writes their bytes. False, and nothing has changed,
  // when that takes another plan: the parameter is structural or unknown, it does not take the value, or an expression
  // has no result with that value. Allocates nothing for numbers, booleans and lists.
  bool set(std::string_view path, const graph::Value& value, UniformArena& arena);

 private:
  // A uniform that reads live parameters.
  struct Reader {
    const gl::BlockMember* member = nullptr;
    const graph::Expr* expr = nullptr;
    std::uint32_t block = 0;  // offset of its block
  };
  graph::Value valueOf(const graph::UniformSpec& uniform) const;
  void fillPass(PreparedPass& pass, UniformArena& arena) const;
  void listReaders(const PreparedPass& pass);

  const graph::FlatGraph& graph_;
  std::vector<graph::Value> parameters_;
  std::unordered_map<std::string_view, std::uint32_t> parameterOf_;  // by path, which the graph holds
  std::vector<Reader> readers_;
  std::vector<std::vector<std::uint32_t>> readersOf_;  // per parameter: into readers_
  std::vector<graph::Value> results_;                  // scratch of set()
};

}  // namespace weft::runtime
