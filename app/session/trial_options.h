// The command lines of test, bisect, ablate, fuzz and new.
#pragma once

#include "app/session/option_parts.h"

namespace weft::app {

void addTrialCommands(CLI::App& app, Options& options, RawOptions& raw);

}  // namespace weft::app
