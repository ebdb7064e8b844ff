#include "engine/text/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace weft::text {

std::string hintToRaise(std::uint64_t bound, std::uint64_t needed) {
  const std::uint64_t times = std::max(2 * limitsRaised, needed / bound + (needed % bound != 0 ? 1 : 0));
  if (times > kMaxRaise) return {};
  return fmt::format("raise the limits with --limit {}, if that is meant", times);
}

Diagnostic& reportLimit(Diagnostics& diagnostics, Where place, std::string message, std::uint64_t bound,
                        std::string_view counts, std::uint64_t needed) {
  return diagnostics.error(
      Code::limitExceeded, std::move(place), std::move(message),
      {.expected = fmt::format("at most {} {}", raised(bound), counts),
       .found = needed > 0 ? fmt::format("{} {}", needed, counts.substr(0, counts.find(' '))) : "",
       .hint = hintToRaise(bound, needed)});
}

}  // namespace weft::text
