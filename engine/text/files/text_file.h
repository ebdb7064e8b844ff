// Reads whole text files, JSON and .cube tables, and refuses those that are too large before they fill the memory.
// Does not: parse them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/text/diagnostic.h"
#include "engine/text/limits.h"

namespace weft::text {

constexpr std::uint64_t kMaxTextBytes = 32ull << 20;

// Does what readFile (file.h) does. Reports Code::limitExceeded for a file of more than kMaxTextBytes, and reads only its beginning.
std::optional<std::string> readTextFile(const std::string& path, Diagnostics& diagnostics,
                                        Code code = Code::unreadableFile, const Place& place = {});

// The same report for a text that is in memory already.
void reportTooLarge(const Place& place, std::uint64_t bytes, Diagnostics& diagnostics);

}  // namespace weft::text
