// Graph files that were written before the language's second edition, in its words.
#pragma once

#include <string>
#include <string_view>

namespace weft::graph {

// Moves inputs from "resources" to "inputs", with their comments; takes away each '?' at a slot that reads an optional input; makes
// alternatives of an `if` at a slot that reads, except in a pass with "repeat". What it cannot decide, and a text with mistakes,
// stays as it is.
std::string withNewSpelling(std::string_view text);

}  // namespace weft::graph
