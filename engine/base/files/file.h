// Whole files in and out, with diagnostics instead of exceptions. Directories, missing files, pipes, devices
// and unreadable files are told apart. What may be read at all is said in engine/base/files/file_access.h. Does
// not: watch, memory-map or decode anything.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "engine/base/diagnostic.h"

namespace weft::base {

// The bytes of the file at `path`. On failure reports `code` at `place` (or at the file itself when `place`
// is empty); W200 when the path leads out of the folders that reading is confined to.
std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics,
                                    Code code = Code::unreadableFile, const Place& place = {});

// A path written in a file, from that file's folder; absolute ones and "" as they are.
std::string besideFile(const Place& place, const std::string& path);

// Called between portions with the bytes read so far and the file's size (0 when it has none, as a pipe), and
// now and then while a pipe has nothing. False ends the reading: readFile returns nothing then and reports
// nothing.
using ReadProgress = std::function<bool(std::uint64_t done, std::uint64_t total)>;
std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics, Code code,
                                    const Place& place, const ReadProgress& goOn);

// Writes through a temporary file beside `path` and renames it, so that a failure never leaves half a file. A
// file that is there keeps its permissions, a link goes on leading to it, a device is written to as it is.
// Reports Code::outputNotWritten and returns false when it cannot.
bool writeFile(const std::string& path, std::span<const char> bytes, Diagnostics& diagnostics);

}  // namespace weft::base
