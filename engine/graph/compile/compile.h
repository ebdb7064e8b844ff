// Compiles a FlatGraph to a Plan. The time is linear in passes and uses; only the flat arrays of FlatGraph are read, and
// nothing can fail any more.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

// The graph must be valid and linked (by expandGraph, or by linkVersions): every read has a version, some
// pass writes what is presented (version zero is not enough), and imports are not written. The order of the plan is the
// declared order of the live passes. It is always legal, because a use refers to the latest version before it, and it is
// the order that a person reads in the file.
Plan compile(std::shared_ptr<const FlatGraph> graph, const CompileOptions& options = {});

// One of the two accesses that a barrier separates.
struct BarrierAccess {
  std::uint32_t pass = kNone;  // kNone: present or read-back at the end of the frame
  FlatUse use;
  bool clear = false;  // the clear before the pass
};

// Why a step has a barrier bit: of the accesses that the bit separates, two that no other barrier separates.
struct BarrierReason {
  std::uint32_t step = 0;  // steps.size(): at the end of the frame
  bool afterClears = false;
  BarrierBit bit{};
  BarrierAccess before, after;
  std::uint32_t framesAgo = 0;  // of `before`; 0: in the frame of the barrier
};

// The reason of every bit of a plan, in order of bits and steps. Compiles the plan's graph again.
std::vector<BarrierReason> explainBarriers(const Plan& plan);

// An edge between passes, for random orders and for people; the declared order needs none. One edge per pair and resource, per
// kind, per sub-resource of one FlatResource. History orders nothing; resources that only share storage order nothing.
struct Dependency {
  enum class Type : std::uint8_t { read_after_write, write_after_read, write_after_write };
  std::uint32_t from = 0, to = 0;  // passes; `from` runs first
  std::uint32_t resource = 0;
  Type type = Type::read_after_write;
  friend auto operator<=>(const Dependency&, const Dependency&) = default;
};

// In declared order of `to`, then of `from`: between live passes, by the uses that are `attached`; over every pass and use,
// culled ones too, without it.
std::vector<Dependency> dependencies(const FlatGraph& graph,
                                     const std::vector<std::uint8_t>* attached = nullptr);

constexpr std::uint64_t kMaxTextureBytes = 4ull << 30;  // of all textures and buffers of one plan

// Holds what a plan would allocate against that limit, before anything is. What a device has is not known here. False after Code::texturesTooLarge, at the declaration of the largest texture or buffer.
bool checkMemory(const Plan& plan, text::Diagnostics& diagnostics);

}  // namespace weft::graph
