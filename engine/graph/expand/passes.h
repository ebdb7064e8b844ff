// The walk over all passes in declared order: includes, repeats, enabled or not, slots, versions, and what
// goes into the FlatGraph. Missing versions are only recorded; live.h decides which are errors.
#pragma once

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

// Of a graph, each instance of a repeat counted; `--limit` raises them.
constexpr std::uint64_t kMaxPasses = 4096;
constexpr std::uint64_t kMaxSlotsOfPass = 1024;              // slots, parameters and defines
constexpr std::uint64_t kMaxSlots = std::uint64_t{1} << 18;  // of all passes, and the versions that they read

// ---- the steps of it for one stanza and one instance ----

// What is checked once per stanza: type, keys, slots of fixed types, draw list, geometry, cadence,
// expressions in branches not taken. (That slots, parameters and defines share one namespace is the
// reader's.)
bool checkStanza(Model& model, Scope& scope, const PassDesc& desc, const PassType* type,
                 const std::string& declared);

// A uniform or "instances" that may change without another plan: it is folded when all versions and all structural
// parameters are known.
struct DeferredUniform {
  std::uint32_t pass = 0;
  std::uint32_t uniform = kNone;    // kNone: "instances"
  const Expr* expr = nullptr;       // null: `parameter` alone
  std::uint32_t parameter = kNone;  // the one that it is, or kNone
  Scope* scope = nullptr;           // in which, with the indices, the expression is evaluated
  std::vector<Names::Index> indices;
};

// Fills everything of `spec`, of `pass`, but names, slots and the values of uniforms whose expression contains
// age(). `deferred`, unless it is null, gets those, and every uniform that names a parameter.
void fillSpec(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
              PassSpec& spec, std::uint32_t pass, std::vector<DeferredUniform>* deferred);

// ---- the walk ----

// Fills passes, uses, slots, specs and disabled.
void expandPasses(Model& model, std::vector<DeferredUniform>& deferred);

}  // namespace weft::graph::expansion
