// Reads and writes whole files, with diagnostics instead of exceptions. Messages tell directories, missing files,
// pipes, devices and unreadable files apart. engine/text/files/file_access.h says which files may be read at all.
// Does not: watch, memory-map or decode anything.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "engine/text/diagnostic.h"

namespace weft::text {

// The bytes of the file at `path`. On failure reports `code` at `place` (or at the file itself when `place`
// is empty); W200 when the path leads out of the folders that reading is confined to.
std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics,
                                    Code code = Code::unreadableFile, const Place& place = {});

// A path that is written in a file, as seen from that file's folder. Absolute paths and "" stay as they are.
std::string besideFile(const Place& place, const std::string& path);

// Called between portions with the bytes read so far and the file's size (0 when it has none, as a pipe), and
// now and then while a pipe has nothing. False ends the reading: readFile returns nothing then and reports
// nothing.
using ReadProgress = std::function<bool(std::uint64_t done, std::uint64_t total)>;
std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics, Code code,
                                    const Place& place, const ReadProgress& goOn);

// Writes a temporary file beside `path` and renames it, so that a failure never leaves half a file. A file that
// exists keeps its permissions, a link still leads to it, and a device is written to directly. On failure reports
// Code::outputNotWritten and returns false.
bool writeFile(const std::string& path, std::span<const char> bytes, Diagnostics& diagnostics);

}  // namespace weft::text
