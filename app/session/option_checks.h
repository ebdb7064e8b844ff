// Values on the command line: what each has to look like. A check gives "" or what is wrong, for CLI11. Does not: know single options.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "engine/imports/world.h"

namespace weft::app {

// False when `text` is no whole number, or no two with `separator` between them.
bool parseNumber(const std::string& text, std::uint32_t& out);
bool parsePair(const std::string& text, char separator, std::uint32_t& a, std::uint32_t& b);

// Pixels of the picture from its lower left corner, and whether the button is held there. Nothing when `text` is neither.
std::optional<imports::Pointer> parsePointer(const std::string& text);

std::string checkSize(const std::string& text);    // "640x360"
std::string checkFrames(const std::string& text);  // "7" or "0:59"
std::string checkFrame(const std::string& text);
std::string checkCount(const std::string& text);
std::string checkSet(const std::string& text);          // "NAME=VALUE"
std::string checkPointer(const std::string& text);      // "80,45" or "80,45,down"
std::string checkFolder(const std::string& path);       // that is there
std::string checkCacheFolder(const std::string& path);  // that is there or can be made, or "none"
// A number within `low` and `high`; what is no number (nan), has no end (inf) or is no double (1e999) is neither.
CLI::Validator numberFrom(double low, double high);

// An option of `command` for a file or a folder that was given as "", as by a variable of a script that is not set. What is wrong
// with it, or "".
std::string findEmptyName(const CLI::App& command);

// Set a limit (NAME=VALUE), and confine reading to a folder, for this process.
std::string takeLimit(const std::string& text);
std::string takeConfinement(const std::string& folder);

}  // namespace weft::app
