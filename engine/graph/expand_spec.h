// What the executor needs of a pass instance besides its uses: state, defines, uniforms, threads, draw list,
// geometry and view. Reads expressions and reports what does not fit. Does not know versions.
#pragma once

#include "engine/graph/expand_slots.h"

namespace weft::graph::expansion {

// Fills everything of `spec` but names, slots and dynamic uniforms' values; returns false after a report.
// `deferred` gets the indices of uniforms whose expression contains age(): they are folded when all versions
// are known.
bool fillSpec(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
              PassSpec& spec, std::vector<std::pair<std::uint32_t, const Expr*>>& deferred);

// The import a view names; kNone means the default camera. nullopt after a report.
std::optional<std::uint32_t> resolveView(const SlotContext& context, const PassDesc& desc, PassSpec& spec);

}  // namespace weft::graph::expansion
