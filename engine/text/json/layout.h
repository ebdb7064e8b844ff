// One layout for the JSON files that people write: lines of at most 120 characters, short objects on one
// line, comments and blank lines between entries kept. The same values and comments always give the same
// text, and that text stays as it is. Strings and numbers keep the way they are written. Does not: open
// files, know graphs, or break a string or a comment that is too long.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace weft::text {

// What a kind of file adds to the rules. Keys are without quotes.
struct LayoutRules {
  std::vector<std::string_view> packed;  // members of the document whose numbers and words share lines
  std::vector<std::string_view> starts;  // the first of these in an object of several lines begins a line
};

// `text` is what parseJson takes without a report. Line ends (the first one's kind) and a byte order mark
// stay.
std::string layoutJson(std::string_view text, const LayoutRules& rules = {});

}  // namespace weft::text
