// Which barrier bit each use needs, and the hazards of a plan whose frames follow each other for ever. Declared in steps.h.
//
// Two rules make every barrier of a plan:
//  (a) Between an image or buffer store of a shader and a later use of the same physical sub-resource there must be the
//      bit of that use. A write in between changes nothing: its cadence may skip it, and it need not cover every texel.
//  (b) Between any access and a later image or buffer store to the same physical storage there must be
//      SHADER_IMAGE_ACCESS or SHADER_STORAGE, also when two resources only share that storage.
//
// The barriers are safe whichever passes run, and have no redundant bits when all passes run, with two exceptions in
// which safety wins. One is a history none of whose writers is `always`, read after a first writer that does not store
// and before a later one that does: a frame without writers then needs a bit that a frame with all of them does not.
// The other is what a time-sliced group writes: its copies, which change places at unknown times, count as one.
#include <algorithm>
#include <bit>
#include <limits>
#include <map>

#include "engine/graph/compile/steps.h"

namespace weft::graph {

namespace {

using Scratch = CompileScratch;

// ---- which glMemoryBarrier bit each kind of use needs (OpenGL 4.5 core, 7.12.2). The oracle in the tests has a table of its own,
// written from the specification ----

// The bit a store itself waits behind, rule (b).
inline std::uint16_t storeBit(const FlatUse& use) {
  return use.kind == Kind::storage ? kBarrierStorage : kBarrierImage;
}

// The bits a use of a pass needs after an earlier store, rule (a). `copy` on a texture means framebuffer blits.
inline std::uint16_t useBits(const FlatUse& use, bool buffer) {
  switch (use.kind) {
    case Kind::sampled:
      return kBarrierTexture;
    case Kind::image:
      return kBarrierImage;
    case Kind::uniform:
      return kBarrierUniform;
    case Kind::storage:
      return kBarrierStorage;
    case Kind::indirect:
      return kBarrierCommand;
    case Kind::color:
    case Kind::depth:
      return use.feedback ? kBarrierFramebuffer | kBarrierTexture : kBarrierFramebuffer;
    case Kind::copy:
      return buffer ? kBarrierBufferUpdate : kBarrierFramebuffer;
  }
  return 0;
}

// glClearNamedFramebuffer of an attachment; glClearTexSubImage, glClearNamedBufferSubData
inline std::uint16_t clearBit(const ClearOp& clear, bool buffer) {
  return clear.attachment != kNone ? kBarrierFramebuffer
         : buffer                  ? kBarrierBufferUpdate
                                   : kBarrierTextureUpdate;
}

// What follows the last step: the present blit and glReadPixels, and a buffer is copied out.
inline std::uint16_t endBits(bool buffer) {
  return buffer ? kBarrierBufferUpdate : kBarrierFramebuffer;
}

// ---- the walk ----

// A stamp of an access is its position, and where causes are asked for an Access64, which takes a tenth more time.
template <class Stamp>
constexpr Stamp kNever = std::numeric_limits<Stamp>::min();
template <class Stamp>
constexpr unsigned kPositionShift = 8 * sizeof(Stamp) - 32;

template <class Stamp>
Stamp stampOf(std::int32_t position, std::uint32_t who) {
  const Stamp stamp = Stamp{position} << kPositionShift<Stamp>;
  return kPositionShift<Stamp> == 0 ? stamp : stamp | who;
}
template <class Stamp>
std::int32_t positionOf(Stamp stamp) {
  return static_cast<std::int32_t>(stamp >> kPositionShift<Stamp>);
}
template <class Stamp>
Stamp back(Stamp stamp, std::int32_t by) {
  return stamp == kNever<Stamp> ? stamp : stamp - stampOf<Stamp>(by, 0);
}

// A value per byte of the arena, as ranges of equal values.
template <class Stamp>
class RangeMap {
 public:
  RangeMap() { values_[0] = kNever<Stamp>; }
  void paint(std::uint64_t from, std::uint64_t to, Stamp value) {
    split(to);
    const auto first = split(from);
    values_.erase(std::next(first), values_.lower_bound(to));
    first->second = value;
  }
  Stamp latest(std::uint64_t from, std::uint64_t to) const {
    Stamp value = kNever<Stamp>;
    for (auto it = std::prev(values_.upper_bound(from)); it != values_.end() && it->first < to; ++it)
      value = std::max(value, it->second);
    return value;
  }
  void shift(std::int32_t by) {
    for (auto& [from, value] : values_) value = back(value, by);
  }

 private:
  std::map<std::uint64_t, Stamp>::iterator split(std::uint64_t at) {
    const auto it = std::prev(values_.upper_bound(at));
    return it->first == at ? it : values_.emplace_hint(std::next(it), at, it->second);
  }
  std::map<std::uint64_t, Stamp> values_;
};

// How a resource's accesses are followed.
enum class Mode : std::uint8_t {
  ignored,  // nothing ever stores to its storage: no hazard can touch it
  plain,    // one row of cells
  history,  // two rows of cells: the copy that is written, and the oldest one
  arena,    // one cell, which takes over what earlier owners of its bytes left
};

// Mode::history: `depth` is the number of copies behind the one that is written. What a time-sliced group writes has
// one more than its history, since everybody else's x is x@-1 of the group's passes; it rotates when the group
// publishes, so it may stand still from one frame to the next although all its writers run.
struct Track {
  std::uint32_t base = 0;
  std::uint32_t group = kNone;  // the time-sliced group that writes it
  std::uint16_t depth = 0;
  Mode mode = Mode::ignored;
  bool granular = false;  // a row has a cell per sub-resource, else one
};

template <class Stamp>
class Collector {
  // The last store, and the last access of any kind.
  struct Cell {
    Stamp store = kNever<Stamp>, access = kNever<Stamp>;
  };
  struct Cause {
    Stamp from = kNever<Stamp>;
    std::uint32_t to = 0;
  };

 public:
  Collector(const FlatGraph& graph, const Plan& plan, const Scratch& scratch, HazardIntervals& hazards,
            HazardCauses* causes)
      : graph_(graph),
        plan_(plan),
        scratch_(scratch),
        hazards_(hazards),
        causes_(causes),
        end_(static_cast<std::int32_t>(plan.steps.size())),
        circle_(2 * (end_ + 1)) {
    assignTracks();
  }

  void run() {
    walk<false>();  // where each cell stands at the end of a frame
    advanceFrame();
    walk<true>();  // a frame after such a frame
  }

 private:
  void assignTracks() {
    const std::size_t count = graph_.resources.size();
    tracks_.resize(count);
    std::vector<std::uint8_t> storageFlags(plan_.storages.size(), 0);
    std::vector<std::uint32_t> storageBase(plan_.storages.size(), kNone);
    bool arenaStored = false;
    for (const std::uint32_t r : scratch_.births) {
      if (plan_.storageOf[r] != kNone) storageFlags[plan_.storageOf[r]] |= scratch_.flags[r];
      if (plan_.bufferOffsetOf[r] != Plan::kNoOffset && (scratch_.flags[r] & Scratch::kStored) != 0)
        arenaStored = true;
    }
    std::uint32_t next = 0;
    for (const std::uint32_t r : scratch_.births) {
      Track& track = tracks_[r];
      const std::uint32_t storage = plan_.storageOf[r];
      const std::uint8_t flags = storage == kNone ? scratch_.flags[r] : storageFlags[storage];
      const bool arena = plan_.bufferOffsetOf[r] != Plan::kNoOffset;
      if (arena ? !arenaStored : (flags & Scratch::kStored) == 0) continue;
      track.group = plan_.groups.slicedWriterOf(r);
      track.depth = static_cast<std::uint16_t>(graph_.resources[r].history + (track.group != kNone ? 1 : 0));
      track.mode = arena ? Mode::arena : track.depth > 0 ? Mode::history : Mode::plain;
      track.granular = (flags & Scratch::kGranular) != 0;
      if (arena) anyArena_ = true;
      if (track.mode == Mode::history) histories_.push_back(r);
      if (storage != kNone && storageBase[storage] != kNone) {
        track.base = storageBase[storage];
        continue;
      }
      track.base = next;
      if (storage != kNone) storageBase[storage] = next;
      next += (track.mode == Mode::history ? 2 : 1) * cellsOf(r);
    }
    cells_.assign(next, {});
  }

  std::uint32_t cellsOf(std::uint32_t r) const {
    return tracks_[r].granular ? subresourceCount(graph_.resources[r]) : 1u;
  }

  // Calls f(number) for each cell of a row that `use` touches.
  template <class F>
  void eachCell(const FlatUse& use, const Track& track, F&& f) const {
    if (track.granular)
      forEachSubresource(use, graph_.resources[use.resource], f);
    else
      f(0u);
  }

  // From the end of one frame to the start of the next. A history resource has rotated by then: what is now
  // the current copy was the oldest, and was last stored to a whole rotation ago. What a time-sliced group writes may have, or may not.
  void advanceFrame() {
    std::vector<Cell> ended;
    if (!histories_.empty()) ended = cells_;
    for (Cell& cell : cells_) cell = {back(cell.store, circle_), back(cell.access, circle_)};
    for (const std::uint32_t r : histories_) {
      const std::int32_t rotation = tracks_[r].group == kNone ? (tracks_[r].depth + 1) * circle_ : circle_;
      const std::uint32_t count = cellsOf(r);
      for (std::uint32_t i = 0; i < count; ++i) {
        Cell& current = cells_[tracks_[r].base + i];
        Cell& oldest = cells_[tracks_[r].base + count + i];
        const Cell wasCurrent = ended[tracks_[r].base + i], wasOldest = ended[tracks_[r].base + count + i];
        current.store = back(wasCurrent.store, rotation);
        current.access = std::max(back(wasCurrent.access, rotation), back(wasOldest.access, circle_));
        oldest.store = wasCurrent.store;  // in its own frame: reads of x@-n subtract n frames
      }
    }
    storeMap_.shift(circle_);
    accessMap_.shift(circle_);
  }

  template <bool collecting>
  void walk() {
    birth_ = 0;
    for (std::int32_t t = 0; t < end_; ++t) {
      const Step& step = plan_.steps[static_cast<std::size_t>(t)];
      const FlatPass& pass = graph_.passes[step.pass];
      group_ = plan_.groups.groupOf(step.pass);
      if (anyArena_) takeArena(t);
      for (std::uint32_t c = step.firstClear; c < step.firstClear + step.clearCount; ++c) {
        const FlatUse& use = plan_.clears[c].use;
        if constexpr (collecting)
          need(use, kClearAccess | c, clearBit(plan_.clears[c], isBufferUse(use)), false);
        mark(use, kClearAccess | c, false, 2 * t + 1);
      }
      const std::uint32_t last = pass.firstUse + pass.useCount;
      if constexpr (collecting) {
        for (std::uint32_t u = pass.firstUse; u < last; ++u) {
          const FlatUse& use = graph_.uses[u];
          if (plan_.attached[u] == 0 || tracks_[use.resource].mode == Mode::ignored) continue;
          const bool store = isStore(use);
          need(use, u, store ? storeBit(use) : useBits(use, isBufferUse(use)), store);
          if (pass.touches != 0 && !isBufferUse(use)) need(use, u, pass.touches, false);
        }
        emitIntervals(t);
      }
      for (std::uint32_t u = pass.firstUse; u < last; ++u)
        if (plan_.attached[u] != 0) mark(graph_.uses[u], u, isStore(graph_.uses[u]), 2 * t + 2);
      if (anyArena_) releaseArena(t);
    }
    group_ = kNone;
    if (anyArena_) takeArena(end_);
    const auto atEnd = [&](auto&& f) {
      if (graph_.present.resource != kNone && plan_.firstStep[graph_.present.resource] != kNone)
        f(graph_.present, kEndAccess);
      for (std::uint32_t i = 0; i < graph_.outputs.size(); ++i)
        if (plan_.outputLive[i] != 0) f(graph_.outputs[i], kEndAccess | (i + 1));
    };
    if constexpr (collecting) {
      atEnd([&](const FlatUse& use, std::uint32_t who) { need(use, who, endBits(isBufferUse(use)), false); });
      emitIntervals(end_);
    }
    atEnd([&](const FlatUse& use, std::uint32_t who) { mark(use, who, false, 2 * end_ + 2); });
    if (anyArena_) releaseArena(end_);
  }

  bool isBufferUse(const FlatUse& use) const {
    return (scratch_.flags[use.resource] & Scratch::kBuffer) != 0;
  }

  // How far behind the copy that is written the current step looks.
  std::uint32_t ageOf(const FlatUse& use, const Track& track) const {
    return use.history + (track.group != group_ && track.group != kNone ? 1u : 0u);
  }

  // Notes that each of `bits` must come after the last store (any access, for a store).
  void need(const FlatUse& use, std::uint32_t who, std::uint16_t bits, bool store) {
    const Track track = tracks_[use.resource];
    if (track.mode == Mode::ignored) return;
    who_ = who;
    const auto from = [&](const Cell& cell) { require(bits, store ? cell.access : cell.store); };
    if (track.mode != Mode::history)
      return eachCell(use, track, [&](std::uint32_t s) { from(cells_[track.base + s]); });
    const auto age = static_cast<std::int32_t>(ageOf(use, track));
    // In a frame in which every writer is skipped nothing rotates, and the store was in the frame before.
    const bool mayStay = !store && track.group == kNone && use.access == Access::read &&
                         (scratch_.flags[use.resource] & Scratch::kWrittenAlways) == 0;
    const std::uint32_t oldest = track.base + cellsOf(use.resource);
    eachCell(use, track, [&](std::uint32_t s) {
      const Cell& cell = cells_[track.base + s];
      if (age > 0) return require(bits, back(cells_[oldest + s].store, age * circle_));
      from(cell);
      if (mayStay && cell.store < 0) require(bits, back(cells_[oldest + s].store, circle_));
    });
  }

  void require(std::uint16_t bits, Stamp from) {
    if (from == kNever<Stamp>) return;
    for (unsigned rest = bits; rest != 0; rest &= rest - 1) {
      Cause& latest = latest_[static_cast<std::size_t>(std::countr_zero(rest))];
      if (from > latest.from) latest = {from, who_};
    }
    due_ |= bits;
  }

  // What step t requires becomes intervals. Only a store after the step's own clear must wait for barriersAfterClears.
  void emitIntervals(std::int32_t t) {
    for (unsigned rest = due_; rest != 0; rest &= rest - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(rest));
      const std::int32_t lo = positionOf(latest_[bit].from), hi = lo > 2 * t ? 2 * t + 1 : 2 * t;
      hazards_[bit].push_back({std::max(lo, hi + 1 - circle_), hi});
      if (causes_) (*causes_)[bit].push_back({latest_[bit].from, latest_[bit].to});
      latest_[bit].from = kNever<Stamp>;
    }
    due_ = 0;
  }

  void mark(const FlatUse& use, std::uint32_t who, bool store, std::int32_t position) {
    const Track track = tracks_[use.resource];
    const Stamp access = stampOf<Stamp>(position, who);
    if (track.mode == Mode::ignored) return;
    std::uint32_t row = track.base;
    if (track.mode == Mode::history) {
      const std::uint32_t age = ageOf(use, track);
      if (age != 0 && age != track.depth) return;
      if (age != 0) row += cellsOf(use.resource);
      store = store && age == 0;
    }
    eachCell(use, track, [&](std::uint32_t s) {
      Cell& cell = cells_[row + s];
      cell.access = access;
      if (store) cell.store = access;
    });
  }

  // Transient buffers: a first step takes over what was done to its bytes, a last step leaves what it did.
  void takeArena(std::int32_t t) {
    for (; birth_ < scratch_.births.size(); ++birth_) {
      const std::uint32_t r = scratch_.births[birth_];
      if (plan_.firstStep[r] > static_cast<std::uint32_t>(t)) return;
      if (tracks_[r].mode != Mode::arena) continue;
      const std::uint64_t from = plan_.bufferOffsetOf[r],
                          to = from + std::max<std::uint64_t>(1, graph_.resources[r].bytes);
      cells_[tracks_[r].base] = {storeMap_.latest(from, to), accessMap_.latest(from, to)};
    }
  }
  void releaseArena(std::int32_t t) {
    for (std::uint32_t r = scratch_.deathHead[static_cast<std::size_t>(t)]; r != kNone;
         r = scratch_.deathNext[r]) {
      if (tracks_[r].mode != Mode::arena) continue;
      const std::uint64_t from = plan_.bufferOffsetOf[r],
                          to = from + std::max<std::uint64_t>(1, graph_.resources[r].bytes);
      const Cell& cell = cells_[tracks_[r].base];
      accessMap_.paint(from, to, cell.access);
      if (positionOf(cell.store) > 2 * static_cast<std::int32_t>(plan_.firstStep[r]))
        storeMap_.paint(from, to, cell.store);
    }
  }

  const FlatGraph& graph_;
  const Plan& plan_;
  const Scratch& scratch_;
  HazardIntervals& hazards_;
  HazardCauses* const causes_;
  const std::int32_t end_, circle_;
  std::vector<Track> tracks_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> histories_;
  RangeMap<Stamp> storeMap_, accessMap_;
  bool anyArena_ = false;
  std::size_t birth_ = 0;
  std::uint32_t group_ = kNone;                   // of the step that is walked over
  std::uint32_t who_ = 0;                         // of the use that is looked at
  std::uint16_t due_ = 0;                         // bits that the step requires
  std::array<Cause, kBarrierBitCount> latest_{};  // per bit, never where none is due
};

}  // namespace

void collectHazards(const FlatGraph& graph, const Plan& plan, const CompileScratch& scratch,
                    HazardIntervals& hazards, HazardCauses* causes) {
  if (causes)
    Collector<Access64>(graph, plan, scratch, hazards, causes).run();
  else
    Collector<std::int32_t>(graph, plan, scratch, hazards, nullptr).run();
}

}  // namespace weft::graph
