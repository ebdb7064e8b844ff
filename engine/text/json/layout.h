// One layout for the JSON files that people write: lines of at most 120 characters, short objects on one
// line, comments and blank lines between entries kept. The same values and comments always give the same
// text, and that text stays as it is. Strings and numbers keep the way they are written; a string or
// a comment that is too long is not broken.
#pragma once

#include <string>
#include <string_view>

namespace weft::text {

// `text` is what parseJson takes without a report. Line ends (the first one's kind) and a byte order mark
// stay.
std::string layoutJson(std::string_view text);

}  // namespace weft::text
