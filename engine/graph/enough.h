// When to stop looking for more mistakes: a file with thousands is damaged as a whole, and each message costs
// memory and the search for a fix.
#pragma once

#include <algorithm>

#include "engine/base/diagnostic.h"
#include "engine/base/limits.h"

namespace weft::graph {

// Many times what is printed.
inline bool enoughErrors(const base::Diagnostics& diagnostics) {
  return diagnostics.errorCount() >= std::max<std::uint64_t>(1000, base::limitOf(base::Limit::diagnostics));
}

}  // namespace weft::graph
