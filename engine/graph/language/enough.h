// When to stop looking for more mistakes: a file with thousands is damaged as a whole, and each message costs
// memory and the search for a fix.
#pragma once

#include "engine/text/diagnostic.h"
#include "engine/text/message_choice.h"

namespace weft::graph {

inline bool enoughErrors(const text::Diagnostics& diagnostics) {
  return diagnostics.errorCount() >= text::mostErrors();
}

}  // namespace weft::graph
