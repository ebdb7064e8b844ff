// Names to indices: open addressing over names that stand in a vector elsewhere. Made for many short names.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/flat_graph.h"

namespace weft::graph {

class NameTable {
 public:
  // `names` must outlive the table; its entries are added one by one with add().
  explicit NameTable(const std::vector<std::string>& names) : names_(names), slots_(64) {}

  void reserve(std::size_t count) {
    while (slots_.size() < count * 2) slots_.resize(slots_.size() * 2);
  }

  // The index of `name`, or kNone.
  std::uint32_t find(std::string_view name) const {
    const std::uint32_t hash = hashOf(name);
    for (std::uint32_t at = hash;; ++at) {
      const Slot& slot = slots_[at & (slots_.size() - 1)];
      if (slot.index == kNone || (slot.hash == hash && names_[slot.index] == name)) return slot.index;
    }
  }

  // Adds names[index]; false when an equal name is there already (which stays).
  bool add(std::uint32_t index) {
    if ((count_ + 1) * 2 > slots_.size()) grow();
    const std::string_view name = names_[index];
    const std::uint32_t hash = hashOf(name);
    for (std::uint32_t at = hash;; ++at) {
      Slot& slot = slots_[at & (slots_.size() - 1)];
      if (slot.index == kNone) {
        slot = {hash, index};
        ++count_;
        return true;
      }
      if (slot.hash == hash && names_[slot.index] == name) return false;
    }
  }

 private:
  struct Slot {
    std::uint32_t hash = 0, index = kNone;
  };

  static std::uint32_t hashOf(std::string_view name) {
    std::uint64_t h = name.size();
    while (name.size() >= 8) {
      h = mix(h, load(name.data(), 8));
      name.remove_prefix(8);
    }
    return static_cast<std::uint32_t>(mix(h, load(name.data(), name.size())) >> 32);
  }
  static std::uint64_t load(const char* data, std::size_t n) {
    std::uint64_t word = 0;
    std::memcpy(&word, data, n);
    return word;
  }
  static std::uint64_t mix(std::uint64_t h, std::uint64_t word) {
    h = (h ^ word) * 0x9e3779b97f4a7c15ull;
    return (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9ull;
  }

  void grow() {
    std::vector<Slot> old(slots_.size() * 2);
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.index == kNone) continue;
      std::uint32_t at = slot.hash;
      while (slots_[at & (slots_.size() - 1)].index != kNone) ++at;
      slots_[at & (slots_.size() - 1)] = slot;
    }
  }

  const std::vector<std::string>& names_;
  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace weft::graph
