// Reports that a limit is exceeded, in the same words everywhere: Code::limitExceeded with the limit's name, its
// value and how to raise it. Does not: count.
#pragma once

#include <string>

#include "engine/base/diagnostic.h"
#include "engine/base/limits.h"

namespace weft::base {

// `message` says what is too large; "expected" and the fix come from the limit.
Diagnostic& reportLimit(Diagnostics& diagnostics, Limit limit, Where place, std::string message,
                        std::uint64_t needed = 0);

// The same for a bound that is no row of the table; `counts` says of what it is one.
Diagnostic& reportLimit(Diagnostics& diagnostics, Where place, std::string message, std::uint64_t bound,
                        std::string_view counts, std::uint64_t needed = 0);

}  // namespace weft::base
