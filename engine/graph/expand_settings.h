// --set, "set" of files and --disable: finds the parameter or pass a name means (the full dotted name, else
// the only one that ends in it) and parses and checks values. The defaults of parameters were checked by the
// reader.
#pragma once

#include "engine/graph/expand_model.h"

namespace weft::graph::expansion {

// Sets Parameter::value, Scope::disabledBy and Model::disables.
void applySettings(Model& model);

// Whether `value` fits a parameter: its type, its choices, its range. Reports at `place`.
bool checkParameterValue(Model& model, const Parameter& parameter, const Value& value, const Place& place);

}  // namespace weft::graph::expansion
