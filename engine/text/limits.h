// Bounds on what is read, so that a hostile or mistaken file fills neither memory, stack nor time. Each bound is a constant
// beside what it bounds. Those that a large project may meet are raised together: `--limit N` makes all of them N times as
// much. That is one number of the process, set before anything is read. docs/limits.md lists what a person can meet.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/text/diagnostic.h"

namespace weft::text {

constexpr std::uint64_t kMaxRaise = 64;
inline std::uint64_t limitsRaised = 1;  // times

// A bound as it is now.
inline std::uint64_t raised(std::uint64_t bound) {
  return bound * limitsRaised;
}

// "raise the limits with --limit 2, if that is meant": at least so that `needed` is allowed. "" when that cannot be.
std::string hintToRaise(std::uint64_t bound, std::uint64_t needed = 0);

// W201: more than `bound` allows; `counts` says of what, with the word for one kind of them first ("bytes of all files").
Diagnostic& reportLimit(Diagnostics& diagnostics, Where place, std::string message, std::uint64_t bound,
                        std::string_view counts, std::uint64_t needed = 0);

}  // namespace weft::text
