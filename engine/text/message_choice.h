// Which of many messages are printed, when a run has more than anybody reads (kMaxMessages). Does not:
// print.
#pragma once

#include <cstdint>

#include "engine/text/diagnostic.h"

namespace weft::text {

constexpr std::uint64_t kMaxMessages = 100;

// After so many errors nothing more is looked for: ten times what is printed by default, and what is printed where that
// is more.
std::uint64_t mostErrors();

// `all` in the order of their places, exact repeats dropped. Of more than the limit, errors stay before
// warnings and warnings before notes, each from the first place on; a note at the end (W208) counts what is
// left out. `notes` false: without notes, that one aside. Another note (W208) says when names were too many
// for a nearest one to be looked for, once; another that no more errors were looked for.
Diagnostics chooseMessages(const Diagnostics& all, bool notes = true);

}  // namespace weft::text
