// Files that are read whole as text, JSON and .cube tables, refused by their size before they fill the
// memory. Does not: parse them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/base/diagnostic.h"
#include "engine/base/limits.h"

namespace weft::base {

// As readFile (file.h), and Code::limitExceeded for a file beyond the limit json_bytes, of which only the beginning is
// read.
std::optional<std::string> readTextFile(const std::string& path, Diagnostics& diagnostics,
                                        Code code = Code::unreadableFile, const Place& place = {});

// The limit as it binds `file`, which may be null: Weft's own data (file_access.h) has at least the default.
std::uint64_t limitFor(Limit limit, const std::string* file);

// The same report for a text that is there already.
void reportTooLarge(const Place& place, std::uint64_t bytes, Diagnostics& diagnostics);

}  // namespace weft::base
