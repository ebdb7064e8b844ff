// The view of a pass: which import it names, and which layer and face of it.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

// The import a view names; kNone means the default camera. nullopt after a report.
std::optional<std::uint32_t> resolveView(const SlotContext& context, const PassDesc& desc, PassSpec& spec);

}  // namespace weft::graph::expansion
