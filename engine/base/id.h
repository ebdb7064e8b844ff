// Typed ids: an index with a generation, so that an id of a removed row is recognised instead of naming its successor.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace weft::base {

template <class Tag>
struct Id {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t index = kNone;
  std::uint32_t generation = 0;
  constexpr bool valid() const { return index != kNone; }
  friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

}  // namespace weft::base
