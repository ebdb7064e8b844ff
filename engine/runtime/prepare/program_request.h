// What a pass asks of the program cache: the stages, defines and outputs of a variant.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/gl/programs/program_cache.h"
#include "engine/graph/plan.h"

namespace weft::runtime {

// The vertex shader of a triangle over the whole picture. z = 0 is the far plane (reversed Z), so that a depth test "equal"
// against a cleared buffer finds the background.
extern const char* const kFullscreenVertex;

// Whether an attachment does no more than say how large the raster of a pass is that stores: nobody reads it, and the
// shader need not write it.
bool givesRasterAlone(const graph::Plan& plan, std::uint32_t pass, std::uint32_t use);

// The stages, defines and outputs of a pass's variant: what `check` compiles without running anything.
gl::ProgramRequest programRequestOf(const graph::FlatGraph& graph, const graph::Plan& plan,
                                    std::uint32_t pass, const graph::PassType& type);

// The columns of the table that a use reads; empty when the use reads no table.
std::span<const graph::TableColumn> columnsOf(const graph::FlatGraph& graph, const graph::FlatUse& use);
// The columns of the rows of the list that a draw pass draws.
std::vector<graph::TableColumn> instanceColumnsOf(const graph::PassSpec& spec);

}  // namespace weft::runtime
