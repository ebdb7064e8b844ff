#include "engine/text/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "text_sentences.h"

namespace weft::text {

std::string hintToRaise(std::uint64_t bound, std::uint64_t needed) {
  const std::uint64_t times = std::max(2 * limitsRaised, needed / bound + (needed % bound != 0 ? 1 : 0));
  if (times > kMaxRaise) return {};
  return fmt::format("raise the limits with --limit {}, if that is meant", times);
}

Diagnostic& reportLimit(Diagnostics& diagnostics, Where place, std::string message, std::uint64_t bound,
                        std::string_view counts, std::uint64_t needed) {
  return diagnostics.error(say::limitExceeded, std::move(place), message, raised(bound), counts,
                           needed > 0 ? fmt::format("{} {}", needed, counts.substr(0, counts.find(' '))) : "",
                           hintToRaise(bound, needed));
}

}  // namespace weft::text
