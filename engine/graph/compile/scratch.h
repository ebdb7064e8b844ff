// What the steps of one compile() hand on: flat vectors indexed by pass, resource or cell. A cell is one sub-resource
// where some use touches a part of a resource, else the whole resource.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/flat_graph.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

struct CompileScratch {
  // What is known of a resource, in one byte.
  enum Flag : std::uint8_t {
    kBuffer = 1,
    kImported = 2,
    kClear = 4,
    kHistory = 8,
    kGranular = 16,        // more than one cell
    kPersistent = 32,      // history, or a live writer that is not always
    kStored = 64,          // a live pass stores to it by image or buffer
    kWrittenAlways = 128,  // a live writer is `always`, so that a history rotates in every frame
  };
  std::vector<std::uint8_t> flags;      // per resource
  std::vector<std::uint32_t> cellBase;  // per resource: its first cell
  std::uint32_t cellCount = 0;

  // liveness
  std::vector<std::uint8_t> livePass;  // per pass

  // lifetimes
  std::vector<std::uint32_t> births;     // live resources by first step
  std::vector<std::uint32_t> deathHead;  // per step: first resource of a list by last step
  std::vector<std::uint32_t> deathNext;  // per resource
  bool anyClear = false, anyGranular = false, anyStore = false, anyBuffer = false;
  std::vector<std::uint8_t> cleared;  // per cell
};

}  // namespace weft::graph
