#include "engine/base/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "engine/base/nearest.h"

namespace weft::base {

namespace {

// The values, in the order of the table.
std::array kValues{
#define WEFT_LIMIT_VALUE(name, value, what) std::uint64_t{value},
    WEFT_LIMITS(WEFT_LIMIT_VALUE)
#undef WEFT_LIMIT_VALUE
};

// "2G" is 2 << 30; nothing when it is no number or too large.
std::optional<std::uint64_t> parseCount(std::string_view text) {
  int shift = 0;
  if (!text.empty()) {
    const std::size_t unit = std::string_view("KMG").find(text.back());
    if (unit != std::string_view::npos) {
      shift = 10 * (static_cast<int>(unit) + 1);
      text.remove_suffix(1);
    }
  }
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (count == 0 || count > (~std::uint64_t{0} >> 1) >> shift) return std::nullopt;
  return count << shift;
}

std::uint64_t raisedTimes = 1;

}  // namespace

const std::vector<LimitInfo>& allLimits() {
  static const std::vector<LimitInfo> kAll{
#define WEFT_LIMIT_INFO(name, value, what) {Limit::name, #name, value, what},
      WEFT_LIMITS(WEFT_LIMIT_INFO)
#undef WEFT_LIMIT_INFO
  };
  return kAll;
}

std::uint64_t limitOf(Limit limit) {
  return kValues[static_cast<std::size_t>(limit)];
}

std::string_view nameOf(Limit limit) {
  return allLimits()[static_cast<std::size_t>(limit)].name;
}

std::uint64_t mostOf(Limit limit) {
  switch (limit) {
    case Limit::include_depth:
    case Limit::extends_depth:
      return 256;
    default:
      return ~std::uint64_t{0} >> 1;
  }
}

std::optional<std::string> setLimit(std::string_view name, std::string_view value) {
  std::vector<std::string> names;
  for (const LimitInfo& info : allLimits()) {
    names.emplace_back(info.name);
    if (info.name != name) continue;
    const auto count = parseCount(value);
    if (!count)
      return fmt::format("expected a whole number from 1, which may end in K, M or G, found '{}'", value);
    if (const std::uint64_t most = mostOf(info.limit); *count > most)
      return fmt::format("expected at most {}, found {}: deeper walks would overflow the stack", most,
                         *count);
    kValues[static_cast<std::size_t>(info.limit)] = *count;
    return std::nullopt;
  }
  const std::string hint = nearestHint(std::string(name), names);
  return fmt::format("there is no limit '{}'; {}", name, hint.empty() ? "docs/limits.md lists them" : hint);
}

std::string hintToRaise(Limit limit, std::uint64_t needed) {
  const std::uint64_t now = limitOf(limit), most = mostOf(limit);
  if (now >= most)
    return fmt::format("{} cannot be raised further: deeper walks would overflow the stack", nameOf(limit));
  return fmt::format("raise it with --limit {}={}, if that is meant", nameOf(limit),
                     std::min(std::max(2 * now, needed), most));
}

std::uint64_t raised(std::uint64_t bound) {
  return bound * raisedTimes;
}

void raiseLimits(std::uint64_t times) {
  raisedTimes = times;
}

std::string hintToRaise(std::uint64_t bound, std::uint64_t needed) {
  const std::uint64_t times = std::max(2 * raisedTimes, (needed + bound - 1) / bound);
  if (times > kMostRaise) return {};
  return fmt::format("raise the limits with --limit {}, if that is meant", times);
}

}  // namespace weft::base
