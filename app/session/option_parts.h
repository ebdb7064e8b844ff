// Parts of the command line that several commands have in common: the options of a graph and of a device. Does not: know the
// commands, or check values (option_checks.h).
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/session/options.h"

namespace weft::app {

// What was written, to be read once everything is there.
struct RawOptions {
  std::string size = "1280x720", frames = "0";
  std::vector<std::string> sets, otherSets, limits, folders, outputs;
  std::string present;
};

// Returns that of the graph's file.
CLI::Option* addGraphOptions(CLI::App& command, Options& options, RawOptions& raw);
void addPresetFolder(CLI::App& command, Options& options);
void addPointerOption(CLI::App& command, Options& options);
void addBackendOptions(CLI::App& command, Options& options);
void addDeviceOptions(CLI::App& command, Options& options);

// "NAME=VALUE" of `option`: "--set".
std::vector<graph::Setting> settingsFrom(const std::vector<std::string>& texts, const char* option);

}  // namespace weft::app
