// weft bench: what frames and edits cost, as JSON. Times depend on the machine and are not judged.
#pragma once

#include "app/session/command_line.h"

namespace weft::app {

void addBench(CommandLine& line);

}  // namespace weft::app
