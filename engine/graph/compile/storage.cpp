// Physical textures by class, transient buffers by offset. Births come in order of first step; a resource
// that dies in step t frees its storage for step t + 1. Within a class a freed texture is taken before a new
// one is made, so their number is the greatest number alive at once (interval graphs are perfect; greedy
// coloring by start is optimal). Declared in steps.h.
#include <algorithm>
#include <array>
#include <compare>
#include <map>

#include "engine/graph/compile/steps.h"

namespace weft::graph::steps {

namespace {

using Scratch = CompileScratch;
constexpr std::uint64_t kAlignment = 256;

// Two textures share a class when each can be a view of the other: ARB_texture_view compatible formats, equal
// sizes, and targets of one family (2D, arrays and cubes are; 3D and multisample stand alone).
struct ClassKey {
  std::uint64_t area = 0;   // width, height
  std::uint64_t parts = 0;  // depth, layers, mips
  std::uint64_t kind = 0;   // samples, family, view class
  friend auto operator<=>(const ClassKey&, const ClassKey&) = default;
};

ClassKey keyOf(const FlatResource& r) {
  const std::uint64_t family = r.target == Target::texture_3d               ? 1
                               : r.target == Target::texture_2d_multisample ? 2
                                                                            : 0;
  return {std::uint64_t{r.width} << 32 | r.height,
          std::uint64_t{r.depth} << 32 | std::uint64_t{r.layers} << 16 | r.mips,
          std::uint64_t{r.samples} << 32 | family << 16 | infoOf(r.format).viewClass};
}

// Free ranges by offset; best fit, lowest offset among equals; the arena grows at its end.
class Arena {
 public:
  std::uint64_t take(std::uint64_t size) {
    auto best = free_.end();
    for (auto range = free_.begin(); range != free_.end(); ++range)
      if (range->second >= size && (best == free_.end() || range->second < best->second)) best = range;
    if (best == free_.end() && !free_.empty()) {
      const auto last = std::prev(best);
      if (last->first + last->second == end_) best = last;
    }
    const auto [offset, length] =
        best == free_.end() ? std::pair<const std::uint64_t, std::uint64_t>(end_, 0) : *best;
    if (best != free_.end()) free_.erase(best);
    if (length > size) free_[offset + size] = length - size;
    end_ = std::max(end_, offset + size);
    return offset;
  }

  void give(std::uint64_t offset, std::uint64_t size) {
    auto after = free_.lower_bound(offset);
    if (after != free_.end() && offset + size == after->first) {
      size += after->second;
      after = free_.erase(after);
    }
    if (after != free_.begin())
      if (const auto before = std::prev(after); before->first + before->second == offset) {
        before->second += size;
        return;
      }
    free_[offset] = size;
  }

  std::uint64_t end() const { return end_; }

 private:
  std::map<std::uint64_t, std::uint64_t> free_;
  std::uint64_t end_ = 0;
};

std::uint64_t alignedBytes(const FlatResource& r) {
  return (std::max<std::uint64_t>(r.bytes, 1) + kAlignment - 1) / kAlignment * kAlignment;
}

struct ClassState {
  ClassKey key;
  std::uint32_t freeHead = kNone;
  std::uint32_t alive = 0, peak = 0;
  std::uint64_t bytes = 0;
};

// The resources and free storages of one run of placeStorage.
class Placer {
 public:
  Placer(const FlatGraph& graph, bool share, Plan& plan, Scratch& scratch)
      : graph_(graph), share_(share), plan_(plan), scratch_(scratch) {}

  void run() {
    const std::size_t count = graph_.resources.size();
    plan_.storageOf.assign(count, kNone);
    plan_.bufferOffsetOf.assign(count, Plan::kNoOffset);
    scratch_.deathHead.assign(plan_.steps.size() + 1, kNone);
    scratch_.deathNext.resize(count);
    for (const std::uint32_t r : scratch_.births) {
      scratch_.deathNext[r] = scratch_.deathHead[plan_.lastStep[r]];
      scratch_.deathHead[plan_.lastStep[r]] = r;
    }
    std::uint32_t now = 0;
    for (const std::uint32_t r : scratch_.births) {
      for (; now < plan_.firstStep[r]; ++now) endLifetimes(now);
      beginLifetime(r);
    }
    plan_.arenaBytes = arena_.end();
    plan_.bytesAllocated += plan_.arenaBytes;
    for (const ClassState& state : classes_) plan_.bytesLowerBound += state.bytes * state.peak;
    plan_.bytesLowerBound += bufferPeak_;
  }

 private:
  void beginLifetime(std::uint32_t index) {
    const std::uint8_t flags = scratch_.flags[index];
    if ((flags & Scratch::kImported) != 0) return;
    const FlatResource& r = graph_.resources[index];
    const std::uint64_t bytes = r.bytes * std::uint64_t{plan_.copiesOf(index)};
    plan_.bytesDeclared += bytes;
    if ((flags & Scratch::kPersistent) != 0) {
      plan_.bytesAllocated += bytes;
      plan_.bytesLowerBound += bytes;
      if ((flags & Scratch::kBuffer) == 0) addStorage(index, r, bytes).persistent = true;
    } else if ((flags & Scratch::kBuffer) != 0) {
      const std::uint64_t size = alignedBytes(r);
      plan_.bufferOffsetOf[index] = arena_.take(size);
      bufferAlive_ += size;
      bufferPeak_ = std::max(bufferPeak_, bufferAlive_);
    } else {
      takeTexture(index, r);
    }
  }

  // The map has all classes, `recent_` by a hash the last ones: most textures of a graph are of a few.
  std::uint32_t findClass(const FlatResource& r) {
    const ClassKey key = keyOf(r);
    std::uint32_t& recent = recent_[((key.area ^ key.parts << 7 ^ key.kind) * 0x9e3779b97f4a7c15u) >> 58];
    if (recent < classes_.size() && classes_[recent].key == key) return recent;
    recent = table_.try_emplace(key, static_cast<std::uint32_t>(classes_.size())).first->second;
    if (recent == classes_.size()) classes_.push_back({.key = key, .bytes = r.bytes});
    return recent;
  }

  void takeTexture(std::uint32_t index, const FlatResource& r) {
    const std::uint32_t found = findClass(r);
    ClassState& state = classes_[found];
    if (++state.alive > state.peak) state.peak = state.alive;
    if (state.freeHead == kNone) {
      addStorage(index, r, r.bytes);
      plan_.bytesAllocated += r.bytes;
      nextFree_.resize(plan_.storages.size(), kNone);
      classOf_.resize(plan_.storages.size(), found);
      return;
    }
    const std::uint32_t taken = state.freeHead;
    state.freeHead = nextFree_[taken];
    plan_.storages[taken].shared = true;
    plan_.storageOf[index] = taken;
  }

  Storage& addStorage(std::uint32_t index, const FlatResource& r, std::uint64_t bytes) {
    plan_.storageOf[index] = static_cast<std::uint32_t>(plan_.storages.size());
    Storage& storage = plan_.storages.emplace_back(Storage{r});
    storage.copies = static_cast<std::uint8_t>(plan_.copiesOf(index));
    storage.bytes = bytes;
    return storage;
  }

  void endLifetimes(std::uint32_t step) {
    for (std::uint32_t r = scratch_.deathHead[step]; r != kNone; r = scratch_.deathNext[r]) {
      const std::uint8_t flags = scratch_.flags[r];
      if ((flags & (Scratch::kImported | Scratch::kPersistent)) != 0) continue;
      if ((flags & Scratch::kBuffer) != 0) {
        const std::uint64_t size = alignedBytes(graph_.resources[r]);
        bufferAlive_ -= size;
        if (share_) arena_.give(plan_.bufferOffsetOf[r], size);
        continue;
      }
      const std::uint32_t storage = plan_.storageOf[r];
      ClassState& state = classes_[classOf_[storage]];
      --state.alive;
      if (!share_) continue;
      nextFree_[storage] = state.freeHead;
      state.freeHead = storage;
    }
  }

  const FlatGraph& graph_;
  const bool share_;
  Plan& plan_;
  Scratch& scratch_;
  std::map<ClassKey, std::uint32_t> table_;  // into classes_
  std::array<std::uint32_t, 64> recent_{};
  Arena arena_;
  std::vector<ClassState> classes_;
  std::vector<std::uint32_t> nextFree_, classOf_;  // per storage
  std::uint64_t bufferAlive_ = 0, bufferPeak_ = 0;
};

}  // namespace

void placeStorage(const FlatGraph& graph, bool share, Plan& plan, CompileScratch& scratch) {
  Placer(graph, share, plan, scratch).run();
}

}  // namespace weft::graph::steps
