// What the executor needs of a pass instance besides its uses: state, defines, uniforms, threads, draw list,
// geometry and view. Reads expressions and reports what does not fit. Does not know versions.
#pragma once

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

// A uniform that may change without another plan: it is folded when all versions and all structural parameters
// are known.
struct DeferredValue {
  std::uint32_t uniform = 0;
  const Expr* expr = nullptr;       // null: `parameter` alone
  std::uint32_t parameter = kNone;  // the one that it is, or kNone
};

// Fills everything of `spec` but names, slots and the values of uniforms and defines whose expression contains
// age(); returns false after a report. `deferred` gets those, and every uniform that names a parameter.
bool fillSpec(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
              PassSpec& spec, std::vector<DeferredValue>& deferred);

}  // namespace weft::graph::expansion
