// The imports an engine knows, by name. An embedder adds its own before reading graphs.
#pragma once

#include "engine/graph/plug_ins.h"
#include "engine/imports/import.h"

namespace weft::imports {

class ImportRegistry : public graph::PlugIns<Import> {
 public:
  static ImportRegistry builtin();
};

}  // namespace weft::imports
