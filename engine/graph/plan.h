// Plan: what will happen in a frame. It is immutable; equal inputs give equal plans, byte for byte.
// Barrier bits are the graph's own, not OpenGL's.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/graph/flat_graph.h"

namespace weft::graph {

// A step runs in this order: `barriers`, the clears, `barriersAfterClears`, the pass. Both masks are issued also in frames
// in which the pass is skipped by its cadence, so that there is no hazard whichever passes run; the clears are skipped
// with the pass. `barriersAfterClears` is 0 unless the pass stores by image or buffer into what it clears (OpenGL 4.5
// core, 7.12.2: a store waits for earlier accesses only behind its own bit).
// A resource with history rotates (x becomes x@-1) at the start of every frame in which one of its writers runs. What a
// time-sliced group writes rotates when the group publishes.
struct Step {
  std::uint32_t pass = 0;  // index into FlatGraph::passes
  std::uint16_t barriers = 0;
  std::uint16_t barriersAfterClears = 0;
  std::uint32_t firstClear = 0, clearCount = 0;  // into Plan::clears: version zero of what it touches first
};

struct ClearOp {
  FlatUse use;  // range to clear; kind copy, access write
  // The use of the pass that attaches exactly this range (an index into FlatGraph::uses): the clear goes through the
  // pass's framebuffer. kNone: it is a texture update.
  std::uint32_t attachment = kNone;
};

// A physical texture, in the format of one of its resources; others are views. All copies that a history needs are one Storage.
struct Storage : TextureShape {
  std::uint8_t copies = 1;
  bool shared = false;      // used by more than one resource
  bool persistent = false;  // history, or written by a pass that is not always
  std::uint64_t bytes = 0;  // of all copies
};

// Groups: of the passes of a group all run or none, and they publish together (versions/versions.cpp forms groups). A
// time-sliced group runs one slice of one pass per frame and writes a copy that only its own passes see. All other
// passes read the latest publication; none of them writes it. When the last slice has run, the group publishes at the
// start of the next frame.
struct Groups {
  std::vector<std::uint32_t> ofPass;  // per pass; kNone: alone, always or culled. Empty: there are no groups
  std::vector<std::uint8_t> sliced;   // per group: 1 when it is time-sliced
  std::vector<std::uint32_t> ofResource;  // per resource: the time-sliced group that writes it. May be empty
  std::uint32_t groupOf(std::uint32_t pass) const { return ofPass.empty() ? kNone : ofPass[pass]; }
  std::uint32_t slicedWriterOf(std::uint32_t resource) const {
    return ofResource.empty() ? kNone : ofResource[resource];
  }
};

struct CompileOptions {
  bool share = true;            // false: every resource its own storage (fuzz)
  std::uint64_t orderSeed = 0;  // not 0: a random legal order instead of the declared one (fuzz)
};

struct Plan {
  std::shared_ptr<const FlatGraph> graph;
  CompileOptions options;
  std::vector<Step> steps;  // execution order
  std::vector<ClearOp> clears;
  std::vector<std::uint32_t> stepOf;     // per pass: index into steps, kNone when culled
  std::vector<std::uint8_t> attached;    // per use: 1 when the use is live (a dead output is not attached)
  std::vector<std::uint8_t> outputLive;  // per output: 1 when its final version is made, to be read back
  std::vector<std::uint32_t> storageOf;  // per resource: into storages, kNone for buffers, imports, dead
  std::vector<std::uint64_t> bufferOffsetOf;  // per resource: in the transient arena, else kNoOffset
  // Per resource: the first step that touches it (writes or clears it) and the last. steps.size() stands for present or
  // read-back after the last step, kNone for a dead resource. The storage of a transient holds nothing before firstStep
  // and is invalidated there.
  std::vector<std::uint32_t> firstStep, lastStep;
  std::vector<std::uint8_t> persistent;  // per resource: own storage kept across frames
  std::vector<Storage> storages;
  Groups groups;
  std::uint64_t arenaBytes = 0;     // transient buffers, packed by offset (alignment 256)
  std::uint16_t finalBarriers = 0;  // before the picture is presented and outputs are read back
  std::uint64_t bytesDeclared = 0;  // all resources of live passes, each with storage of its own
  std::uint64_t bytesAllocated = 0;
  std::uint64_t bytesLowerBound = 0;  // sum over classes of the greatest number alive at once
  std::uint64_t bytesBound = 0;       // sum over steps of the bytes a pass touches
  static constexpr std::uint64_t kNoOffset = ~0ull;

  const FlatPass& passOf(std::size_t step) const { return graph->passes[steps[step].pass]; }
  std::span<const FlatUse> usesOf(std::size_t step) const {
    return std::span(graph->uses).subspan(passOf(step).firstUse, passOf(step).useCount);
  }
  // f(use), for each use through which a step writes.
  template <class F>
  void forEachWrite(std::size_t step, const F& f) const {
    const FlatPass& pass = passOf(step);
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
      if (graph->uses[u].access != Access::read && attached[u] != 0) f(graph->uses[u]);
  }
  bool writes(std::size_t step, std::uint32_t resource) const {
    bool any = false;
    forEachWrite(step, [&](const FlatUse& use) { any |= use.resource == resource; });
    return any;
  }

  // Physical copies of a resource: itself, its history, and the one a time-sliced group is writing.
  std::uint32_t copiesOf(std::uint32_t resource) const {
    return graph->resources[resource].history + 1u + (groups.slicedWriterOf(resource) != kNone ? 1u : 0u);
  }
};

}  // namespace weft::graph
