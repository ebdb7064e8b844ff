// What a pass asks of the program cache: the stages, defines and outputs of its variant, which conditions (dynamic defines)
// choose. Does not: compile anything, or know how a pass is bound.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/gl/programs/program_cache.h"
#include "engine/graph/plan.h"

namespace weft::runtime {

// Which of the pass's dynamic defines hold, one bit each, when resources were published `ageOf(resource)` seconds ago.
std::uint32_t conditionsOf(const graph::PassSpec& spec, const std::function<double(std::uint32_t)>& ageOf);
// The same long after everything was published; and how many bits there are.
std::uint32_t settledConditionsOf(const graph::PassSpec& spec);
std::uint32_t conditionCount(const graph::PassSpec& spec);
// Whether the pass runs under them: a timed one has its `enabled` among them.
bool runsUnder(const graph::PassSpec& spec, std::uint32_t conditions);

// The stages, defines and outputs of a pass's variant under `conditions`: what `check` compiles without running anything.
gl::ProgramRequest programRequestOf(const graph::FlatGraph& graph, const graph::Plan& plan,
                                    std::uint32_t pass, const graph::PassType& type,
                                    std::uint32_t conditions);

// The columns of the table that a use reads; none: it is no table whose layout is the shader's.
std::span<const graph::TableColumn> columnsOf(const graph::FlatGraph& graph, const graph::FlatUse& use);
// Of the rows of the list that a draw pass draws.
std::span<const graph::TableColumn> instanceColumnsOf(const graph::PassSpec& spec);

}  // namespace weft::runtime
