// When to stop looking for more mistakes: a file with thousands is damaged as a whole, and each message costs
// memory and the search for a fix.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/base/message_choice.h"

namespace weft::graph {

inline bool enoughErrors(const base::Diagnostics& diagnostics) {
  return diagnostics.errorCount() >= base::mostErrors();
}

}  // namespace weft::graph
