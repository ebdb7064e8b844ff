// The size of an ISF pass as an expression of Weft: "floor($WIDTH/4.0)" becomes "floor(screen.x/4.0)". Names behind a
// '$' are the picture's size or inputs. What Weft's expressions cannot say is reported (W222). Does not: evaluate.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/diagnostic.h"

namespace weft::convert {

// `place` is that of the expression's first character. `variableOf` gives the text that stands for a name, or "".
std::optional<std::string> convertIsfSize(std::string_view text, const base::Place& place,
                                          const std::function<std::string(std::string_view)>& variableOf,
                                          base::Diagnostics& diagnostics);

}  // namespace weft::convert
