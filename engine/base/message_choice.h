// Which of many messages are printed, when a run has more than anybody reads (limit "diagnostics"). Does not:
// print.
#pragma once

#include "engine/base/diagnostic.h"

namespace weft::base {

// `all` in the order of their places, exact repeats dropped. Of more than the limit, errors stay before
// warnings and warnings before notes, each from the first place on; a note at the end (W208) counts what is
// left out. `notes` false: without notes, that one aside. Another note (W208) says when names were too many
// for a nearest one to be looked for, once.
Diagnostics chooseMessages(const Diagnostics& all, bool notes = true);

}  // namespace weft::base
