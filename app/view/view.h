// The command `weft view`: a window that runs a graph and follows its files. Returns the exit code of the program.
#pragma once

#include "app/session/options.h"

namespace weft::app {

int runView(const Options& options);

}  // namespace weft::app
