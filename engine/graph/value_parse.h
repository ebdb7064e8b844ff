// Values as a person types them behind --set NAME=.
#pragma once

#include <optional>
#include <string_view>

#include "engine/graph/value.h"

namespace weft::graph {

// A JSON scalar or list of one to four numbers, else a word; quotes around a word may be left out.
Value parseValue(std::string_view text);
// A finite number, blanks around it.
std::optional<double> parseNumber(std::string_view text);
// What is wrong with a word that is spelled as a number and is none ("nan", "inf", "1e999"); null for any other.
const char* whyNoNumber(std::string_view text);

}  // namespace weft::graph
