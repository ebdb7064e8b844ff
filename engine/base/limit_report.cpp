#include "engine/base/limit_report.h"

#include <fmt/format.h>

namespace weft::base {

Diagnostic& reportLimit(Diagnostics& diagnostics, Limit limit, const Place& place, std::string message,
                        std::uint64_t needed) {
  const LimitInfo& info = allLimits()[static_cast<std::size_t>(limit)];
  Diagnostic& d = diagnostics.error(Code::limitExceeded, place, std::move(message));
  d.expected = fmt::format("at most {} {} (limit {})", limitOf(limit), info.counts, info.name);
  d.hint = hintToRaise(limit, needed);
  return d;
}

}  // namespace weft::base
