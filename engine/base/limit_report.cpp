#include "engine/base/limit_report.h"

#include <fmt/format.h>

#include <utility>

namespace weft::base {

Diagnostic& reportLimit(Diagnostics& diagnostics, Limit limit, Where place, std::string message,
                        std::uint64_t needed) {
  const LimitInfo& info = allLimits()[static_cast<std::size_t>(limit)];
  Diagnostic& d = diagnostics.error(Code::limitExceeded, std::move(place), std::move(message));
  d.expected = fmt::format("at most {} {} (limit {})", limitOf(limit), info.counts, info.name);
  d.hint = hintToRaise(limit, needed);
  return d;
}

Diagnostic& reportLimit(Diagnostics& diagnostics, Where place, std::string message, std::uint64_t bound,
                        std::string_view counts, std::uint64_t needed) {
  Diagnostic& d = diagnostics.error(Code::limitExceeded, std::move(place), std::move(message));
  d.expected = fmt::format("at most {} {}", raised(bound), counts);
  d.hint = hintToRaise(bound, needed);
  return d;
}

}  // namespace weft::base
