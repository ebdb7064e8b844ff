// A table of plain rows with stable ids (a dense slot map): rows lie contiguously in insertion order, ids
// survive the growth of the table and are recognised as stale after their row is removed. Removal is O(rows)
// and keeps the order. Does not: notify anyone; readers compare revision().
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/id.h"

namespace weft::scene {

template <class Row>
class Table {
 public:
  using Id = base::Id<Row>;

  Id add(Row row) {
    std::uint32_t slot;
    if (free_.empty()) {
      slot = static_cast<std::uint32_t>(slots_.size());
      slots_.push_back({});
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    slots_[slot].row = static_cast<std::uint32_t>(rows_.size());
    rows_.push_back(std::move(row));
    slotOfRow_.push_back(slot);
    ++revision_;
    return {slot, slots_[slot].generation};
  }

  // Null for an id that was never given out or whose row is gone.
  const Row* find(Id id) const {
    if (id.index >= slots_.size() || slots_[id.index].generation != id.generation) return nullptr;
    return &rows_[slots_[id.index].row];
  }
  // For changing a row: counts as a new revision. The id must be live.
  Row& edit(Id id) {
    assert(find(id));
    ++revision_;
    return rows_[slots_[id.index].row];
  }
  bool remove(Id id) {
    if (!find(id)) return false;
    const std::uint32_t row = slots_[id.index].row;
    rows_.erase(rows_.begin() + row);
    slotOfRow_.erase(slotOfRow_.begin() + row);
    for (std::size_t i = row; i < slotOfRow_.size(); ++i)
      slots_[slotOfRow_[i]].row = static_cast<std::uint32_t>(i);
    ++slots_[id.index].generation;
    free_.push_back(id.index);
    ++revision_;
    return true;
  }

  std::span<const Row> rows() const { return rows_; }
  Id idOf(std::size_t row) const { return {slotOfRow_[row], slots_[slotOfRow_[row]].generation}; }
  std::size_t size() const { return rows_.size(); }
  void reserve(std::size_t count) {
    rows_.reserve(count);
    slotOfRow_.reserve(count);
    slots_.reserve(count);
  }
  // Grows with every change.
  std::uint64_t revision() const { return revision_; }

 private:
  struct Slot {
    std::uint32_t row = 0, generation = 0;
  };
  std::vector<Row> rows_;
  std::vector<std::uint32_t> slotOfRow_;  // parallel to rows_
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_;
  std::uint64_t revision_ = 0;
};

}  // namespace weft::scene
