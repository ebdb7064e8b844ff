// Trials of `weft fuzz`: one graph in other legal orders, with shared storage or without, with poisoned transients; and how a
// trial that differs is made smaller. The caller renders.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "engine/graph/compile/compile.h"
#include "engine/runtime/inspection/poison.h"

namespace weft::app {

struct FuzzTrial {
  std::uint32_t seed = 0;               // of the order; 0: the declared one
  std::uint32_t first = 0, last = ~0u;  // places in the plan that are reordered; the others stay
  bool share = true;
  std::optional<runtime::PoisonPattern> poison{};

  graph::CompileOptions compileOptions() const;
  // "--seed 7 --order 3:5 --share off --poison nan": repeats this one.
  std::string arguments() const;
  friend bool operator==(const FuzzTrial&, const FuzzTrial&) = default;
};

// The smallest trial that still differs, found by leaving out one thing after another: the poison, the storage, the order, then
// the passes that are reordered at its ends. `passes`: of the plan.
FuzzTrial shrinkTrial(FuzzTrial trial, std::uint32_t passes,
                      const std::function<bool(const FuzzTrial&)>& differs);

}  // namespace weft::app
