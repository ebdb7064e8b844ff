// How many frames a command may run: the limit `frames`, in one message for all commands. Does not: count them.
#pragma once

#include <cstdint>
#include <string>

#include "engine/base/diagnostic.h"

namespace weft::app {

// False after W201 at `place`. `why`: ", because …" where more run than were asked for. `instead`: ", or …" behind the fix.
bool checkFrameCount(std::uint64_t count, const base::Where& place, const std::string& why,
                     base::Diagnostics& diagnostics, const std::string& instead = {});

inline constexpr const char* kRemembers = ", because the graph remembers what came before";

}  // namespace weft::app
