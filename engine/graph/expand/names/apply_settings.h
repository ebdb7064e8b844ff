// --set, "set" of files and --disable: finds the parameter or pass a name means (the full dotted name, else
// the only one that ends in it) and checks values. The defaults of parameters were checked by the reader.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Sets Parameter::value, Scope::disabledBy and Model::disables.
void applySettings(Model& model);
void applySetting(Model& model, const Setting& set);
void applyDisable(Model& model, const Disable& disable);

}  // namespace weft::graph::expansion
