// Graph files that were written before the language's second edition, in its words.
#pragma once

#include <string>
#include <string_view>

namespace weft::graph {

// Writes each pass that is "like" one above it out whole: what it has of the other stands in the place of "like", without comments.
// Moves inputs from "resources" to "inputs", with their comments; takes away each '?' at a slot that reads an optional input;
// makes alternatives of an `if` at a slot that reads, except in a pass with "repeat". What it cannot decide, and a text with
// mistakes, stays as it is.
std::string withNewSpelling(std::string_view text);

}  // namespace weft::graph
