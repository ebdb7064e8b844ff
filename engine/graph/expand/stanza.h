// What is checked once per pass stanza, however often it repeats. Reports and changes nothing.
#pragma once

#include <string>

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// What is checked once per stanza: type, keys, slots of fixed types, draw list, geometry, cadence,
// expressions in branches not taken. (That slots, parameters and defines share one namespace is the
// reader's.)
bool checkStanza(Model& model, Scope& scope, const PassDesc& desc, const PassType* type,
                 const std::string& declared);

}  // namespace weft::graph::expansion
