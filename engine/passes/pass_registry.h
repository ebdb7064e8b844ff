// The pass types an engine knows, by name. An embedder adds its own before reading graphs.
#pragma once

#include "engine/graph/plug_ins.h"
#include "engine/passes/pass_type.h"

namespace weft::passes {

class PassRegistry : public graph::PlugIns<PassType> {
 public:
  static PassRegistry builtin();
};

}  // namespace weft::passes
