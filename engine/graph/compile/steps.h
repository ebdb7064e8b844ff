// The steps of one compile(), in the order in which they run, and what they hand on: flat vectors indexed by pass,
// resource or cell. A cell is one sub-resource where some use touches a part of a resource, else the whole resource.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/graph/compile/compile.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

struct CompileScratch {
  // What is known of a resource, in one byte.
  enum Flag : std::uint8_t {
    kBuffer = 1,
    kImported = 2,
    kClear = 4,
    kGranular = 8,        // more than one cell
    kPersistent = 16,     // history, or a live writer that is not always
    kStored = 32,         // a live pass stores to it by image or buffer
    kWrittenAlways = 64,  // a live writer is `always`, so that a history rotates in every frame
  };
  std::vector<std::uint8_t> flags;      // per resource
  std::vector<std::uint32_t> cellBase;  // per resource: its first cell
  std::uint32_t cellCount = 0;
  std::vector<std::uint8_t> livePass;    // per pass
  std::vector<std::uint32_t> births;     // live resources by first step
  std::vector<std::uint32_t> deathHead;  // per step: first resource of a list by last step
  std::vector<std::uint32_t> deathNext;  // per resource
  bool anyClear = false, anyStore = false;
  std::vector<std::uint8_t> cleared;  // per cell
};

namespace steps {

// Plan::steps, stepOf: the declared order of the live passes, or a random legal one
void orderPasses(const FlatGraph& graph, const CompileOptions& options, Plan& plan,
                 const CompileScratch& scratch);
// firstStep, lastStep, persistent, clears, outputLive, bytesBound, and births
void findLifetimes(const FlatGraph& graph, Plan& plan, CompileScratch& scratch);
// storages, storageOf, bufferOffsetOf, arenaBytes, bytes
void placeStorage(const FlatGraph& graph, bool share, Plan& plan, CompileScratch& scratch);
// The barrier masks. With `reasons`, also why each bit is there.
void placeBarriers(const FlatGraph& graph, Plan& plan, const CompileScratch& scratch,
                   std::vector<BarrierReason>* reasons);

}  // namespace steps

// Positions of barriers: 2t is Step::barriers of step t, 2t + 1 its barriersAfterClears; step S = steps.size() is the end
// of the frame (finalBarriers). The positions of a frame form a circle of 2 (S + 1), because the next frame follows.
//
// A hazard is an interval of positions, of which one must have a barrier with a given bit. `lo` is negative when the first
// access is in an earlier frame. It is at most one circle before `hi`: a longer interval has every barrier of the bit in it.
struct HazardInterval {
  std::int32_t lo = 0, hi = 0;  // inclusive; a barrier at any position from lo to hi serves
};
// Per bit, in order of hi; of several intervals with one hi only the shortest, which implies the others.
using HazardIntervals = std::array<std::vector<HazardInterval>, kBarrierBitCount>;

// An access: the position behind it in the upper half, so that a later one is greater; in the lower half the index of its
// use, or of a clear or a read at the end of the frame, with kClearAccess or kEndAccess.
using Access64 = std::int64_t;
constexpr std::uint32_t kClearAccess = 0x80000000u, kEndAccess = 0xC0000000u;

// The two accesses of an interval.
struct HazardCause {
  Access64 from = 0;
  std::uint32_t to = 0;  // as the lower half of an access
};
using HazardCauses = std::array<std::vector<HazardCause>, kBarrierBitCount>;

// Reads steps, clears, attached, storage and lifetimes of `plan`; `scratch` must be that of its compile(). `causes`, unless
// null, become parallel to `hazards`.
void collectHazards(const FlatGraph& graph, const Plan& plan, const CompileScratch& scratch,
                    HazardIntervals& hazards, HazardCauses* causes);

// Positions for one bit, ascending and as late as possible. Every interval has one, and none can be left out. `circle` is 2 (S + 1).
std::vector<std::int32_t> chooseBarrierPositions(const std::vector<HazardInterval>& hazards,
                                                 std::int32_t circle);

}  // namespace weft::graph
