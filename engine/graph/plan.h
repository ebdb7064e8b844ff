// Plan: what will happen in a frame. Immutable; equal inputs give equal plans, byte for byte.
// Does not: know GL enums (barrier bits are the graph's own), own GL objects, or read the clock.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/graph/flat_graph.h"
#include "engine/graph/language/barrier_bit.h"

namespace weft::graph {

// In this order: `barriers`, the clears, `barriersAfterClears`, the pass. Both masks are issued also in frames in which
// the pass is skipped by its cadence, so that any subset of cadences is free of hazards; the clears run with the pass
// and are skipped with it. `barriersAfterClears` is not 0 only when the pass stores by image or buffer what it clears
// (7.12.2: a store waits for earlier accesses only behind its own bit).
// A history resource rotates (x becomes x@-1) at the start of every frame in which one of its writers runs; what a time-sliced group
// writes rotates when the group publishes.
struct Step {
  std::uint32_t pass = 0;  // index into FlatGraph::passes
  std::uint16_t barriers = 0;
  std::uint16_t barriersAfterClears = 0;
  std::uint32_t firstClear = 0,
                clearCount = 0;  // into Plan::clears: version zero of what this step touches first
};

struct ClearOp {
  FlatUse use;  // range to clear; kind copy, access write
  // The use of the pass that attaches exactly this range (an index into FlatGraph::uses): the clear goes through the
  // pass's framebuffer. kNone: it is a texture update.
  std::uint32_t attachment = kNone;
};

// A physical texture (history: `copies` of them in a row count as one Storage).
struct Storage {
  Target target = Target::texture_2d;
  std::uint8_t samples = 1;
  std::uint16_t layers = 1, mips = 1;
  std::uint32_t width = 1, height = 1, depth = 1;
  std::uint16_t viewClass = 0;
  Format format = Format::none;  // of its first resource; others are views
  std::uint8_t copies = 1;
  bool shared = false;      // used by more than one resource
  bool persistent = false;  // history, or written by a pass that is not always
  std::uint64_t bytes = 0;  // of all copies
};

// Passes that run all or none and publish together (expand/groups.cpp says which). A time-sliced group runs
// one slice of one pass per frame and writes a copy that nobody else sees; once all of it is there, its
// resources publish at the start of the next frame. Its passes read what the group writes from that copy, all
// others from the latest publication, and none of them writes it.
struct Groups {
  std::vector<std::uint32_t> ofPass;  // per pass; kNone: alone, always or culled. Empty: there are no groups
  std::vector<std::uint8_t> sliced;   // per group
  std::vector<std::uint32_t>
      ofResource;  // per resource: the time-sliced group that writes it, kNone. Empty: none is time-sliced
  std::uint32_t groupOf(std::uint32_t pass) const { return ofPass.empty() ? kNone : ofPass[pass]; }
  std::uint32_t slicedWriterOf(std::uint32_t resource) const {
    return ofResource.empty() ? kNone : ofResource[resource];
  }
};
enum class CullReason : std::uint8_t { live, no_reader };

struct Plan {
  std::shared_ptr<const FlatGraph> graph;
  std::vector<Step> steps;  // execution order
  std::vector<ClearOp> clears;
  std::vector<std::uint32_t> stepOf;   // per pass: index into steps, kNone when culled
  std::vector<std::uint8_t> attached;  // per use: 1 when the use is live (a dead output is not attached)
  std::vector<std::uint8_t>
      outputLive;  // per output: 1 when its final version is made; 0: nothing to read back
  std::vector<std::uint32_t>
      storageOf;  // per resource: index into storages, kNone for buffers, imports, dead
  std::vector<std::uint64_t>
      bufferOffsetOf;  // per resource: offset in the transient arena; kNoOffset otherwise
  // Per resource: the steps that touch it first (write, clear) and last; steps.size() means present or read-back after
  // the last step; kNone when dead. A transient's storage holds nothing before firstStep: invalidate it there.
  std::vector<std::uint32_t> firstStep, lastStep;
  std::vector<std::uint8_t> persistent;  // per resource: own storage kept across frames
  std::vector<Storage> storages;
  Groups groups;
  std::uint64_t arenaBytes = 0;     // transient buffers, packed by offset (alignment 256)
  std::uint16_t finalBarriers = 0;  // before present blit and read-back of outputs
  std::uint64_t bytesDeclared =
      0;  // all transient and persistent resources of live passes, each with storage of its own
  std::uint64_t bytesAllocated = 0;
  std::uint64_t bytesLowerBound = 0;  // sum over classes of the greatest number alive at once
  std::uint64_t bytesBound = 0;       // sum over steps of the bytes a pass touches
  static constexpr std::uint64_t kNoOffset = ~0ull;

  // Physical copies of a resource: itself, its history, and the one a time-sliced group is writing.
  std::uint32_t copiesOf(std::uint32_t resource) const {
    return graph->resources[resource].history + 1u + (groups.slicedWriterOf(resource) != kNone ? 1u : 0u);
  }
};

}  // namespace weft::graph
