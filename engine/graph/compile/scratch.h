// Working memory of compile(), kept between calls so that a recompile allocates only the Plan. Not
// thread-safe. Flat vectors indexed by pass, use, resource or cell; nothing in here outlives a call in
// meaning. A cell is a sub-resource of a resource that some use touches in part, or else the whole resource.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/flat_graph.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

struct CompileScratch {
  // What the steps ask of a resource, in one byte.
  enum Flag : std::uint8_t {
    kBuffer = 1,
    kImported = 2,
    kClear = 4,
    kHistory = 8,
    kGranular = 16,        // more than one cell
    kPersistent = 32,      // history, or a live writer that is not always
    kStored = 64,          // a live pass stores to it by image or buffer
    kWrittenAlways = 128,  // a live writer is always: a history rotates in every frame
  };
  std::vector<std::uint8_t> flags;      // per resource
  std::vector<std::uint32_t> cellBase;  // per resource: its first cell
  std::uint32_t cellCount = 0;

  // versions
  std::vector<std::uint32_t> lastWriter;  // per cell: use that made the final version, kNone
  std::vector<std::uint32_t>
      previous;  // per use: the use that made the version it sees; kNone; or kList | index
  std::vector<std::uint32_t> lists;   // count, uses...: for a use that sees versions of several writers
  std::vector<std::uint32_t> passOf;  // per use
  std::vector<std::uint8_t> stays;    // per use: attached whenever its pass lives (a read, a kept write)
  static constexpr std::uint32_t kList = 0x80000000u;

  // liveness
  std::vector<std::uint8_t> livePass;  // per pass
  std::vector<std::uint32_t> stack;    // uses that a history demands of passes behind the sweep

  // lifetimes
  std::vector<std::uint32_t> births;     // live resources by first step
  std::vector<std::uint32_t> deathHead;  // per step: first resource of a list by last step
  std::vector<std::uint32_t> deathNext;  // per resource
  bool anyClear = false, anyGranular = false, anyHistory = false, anyStore = false, anyBuffer = false;
  std::vector<std::uint8_t> cleared;  // per cell

  template <class F>
  void forEachCell(const FlatUse& use, const FlatResource& r, F&& f) const {
    const std::uint32_t base = cellBase[use.resource];
    if ((flags[use.resource] & kGranular) == 0)
      f(base);
    else
      forEachSubresource(use, r, [&](std::uint32_t s) { f(base + s); });
  }

  // The writers of what `use` sees, one call each; a writer may come more than once.
  template <class F>
  void forEachPrevious(std::uint32_t use, F&& f) const {
    const std::uint32_t p = previous[use];
    if (p == kNone) return;
    if ((p & kList) == 0) {
      f(p);
      return;
    }
    const std::uint32_t at = p & ~kList;
    for (std::uint32_t i = 1; i <= lists[at]; ++i) f(lists[at + i]);
  }
};

}  // namespace weft::graph
