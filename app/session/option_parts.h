// Parts of the command line that several commands have in common: the options of a graph and of a device, and checks of their
// values. Does not: know the commands.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "app/session/options.h"

namespace weft::app {

// What was written, to be read once everything is there.
struct RawOptions {
  std::string size = "1280x720", frames = "0";
  std::vector<std::string> sets, otherSets, limits, folders;
};

bool parseNumber(const std::string& text, std::uint32_t& out);
// Two numbers around `separator`.
bool parsePair(const std::string& text, char separator, std::uint32_t& a, std::uint32_t& b);

// What is wrong with a value, as a sentence, or "".
std::string checkSize(const std::string& text);
std::string checkFrames(const std::string& text);
std::string checkSet(const std::string& text);
// A number within `low` and `high`; what is no number (nan), has no end (inf) or is no double (1e999) is neither.
CLI::Validator numberFrom(double low, double high);

// Returns that of the graph's file.
CLI::Option* addGraphOptions(CLI::App& command, Options& options, RawOptions& raw);
void addBackendOptions(CLI::App& command, Options& options);
void addDeviceOptions(CLI::App& command, Options& options);

// "NAME=VALUE" of --set.
std::vector<graph::Setting> settingsFrom(const std::vector<std::string>& texts);

}  // namespace weft::app
