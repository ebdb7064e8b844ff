// What a plan knows of one thing, by its name: a pass, a resource or a parameter; for `weft explain`. Sentences are for
// people. Does not: change or compile anything.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/diagnostic.h"
#include "engine/graph/plan.h"

namespace weft::graph {

// Everything that `name` means: the pass or its repeats, the resource and its versions, the parameter. `name` is any unique
// suffix. Nothing after a report: unknown (W045, with the nearest) or ambiguous (W046).
std::optional<std::string> describe(const Plan& plan, std::string_view name, base::Diagnostics& diagnostics);

}  // namespace weft::graph
