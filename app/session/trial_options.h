// The command lines of test, bisect, ablate, fuzz and new, and what diff has of them.
#pragma once

#include "app/session/option_parts.h"

namespace weft::app {

// Of diff: whether it renders, and what becomes of the pictures.
void addDiffOptions(CLI::App& diff, Options& options, RawOptions& raw);
void addTrialCommands(CLI::App& app, Options& options, RawOptions& raw);

}  // namespace weft::app
