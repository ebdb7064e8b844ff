// What a pass asks of the program cache: the stages, defines and outputs of a variant. Conditions (dynamic defines) choose
// the variant. Does not: compile anything, or know how a pass is bound.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "engine/gl/programs/program_cache.h"
#include "engine/graph/plan.h"

namespace weft::runtime {

// Which of the pass's dynamic defines hold, one bit each. `ageOf(resource)` is how many seconds ago it was published.
std::uint32_t conditionsOf(const graph::PassSpec& spec, const std::function<double(std::uint32_t)>& ageOf);
// The same when everything was published long ago.
std::uint32_t settledConditionsOf(const graph::PassSpec& spec);
// The number of bits.
std::uint32_t conditionCount(const graph::PassSpec& spec);
// Whether the pass runs under these conditions; the `enabled` of a timed pass is one of them.
bool runsUnder(const graph::PassSpec& spec, std::uint32_t conditions);

// The stages, defines and outputs of a pass's variant under `conditions`: what `check` compiles without running anything.
// Whether an attachment does no more than say how large the raster of a pass is that stores: nobody reads it, and the
// shader need not write it.
bool givesRasterAlone(const graph::Plan& plan, std::uint32_t pass, std::uint32_t use);

gl::ProgramRequest programRequestOf(const graph::FlatGraph& graph, const graph::Plan& plan,
                                    std::uint32_t pass, const graph::PassType& type,
                                    std::uint32_t conditions);

// "HAS_GAIN": what a shader finds defined when its pass has the slot or parameter "gain".
std::string presenceDefineOf(std::string_view name);

// The columns of the table that a use reads; empty when the use reads no table.
std::span<const graph::TableColumn> columnsOf(const graph::FlatGraph& graph, const graph::FlatUse& use);
// The columns of the rows of the list that a draw pass draws.
std::span<const graph::TableColumn> instanceColumnsOf(const graph::PassSpec& spec);

}  // namespace weft::runtime
