// --set, "set" of files and --disable: finds the parameter or pass a name means (the full dotted name, else
// the only one that ends in it) and parses and checks values. The defaults of parameters were checked by the
// reader.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Sets Parameter::value, Scope::disabledBy and Model::disables.
void applySettings(Model& model);
void applySetting(Model& model, const Setting& set);
void applyDisable(Model& model, const Disable& disable);

// Whether `value` fits a parameter: its type, its choices, its range. Reports at `place`, in words that come after
// `before`.
bool checkParameterValue(Model& model, const Parameter& parameter, const Value& value, const Where& place,
                         const std::string& before);

// A problem with a whole file that one of the `arguments` of an import names, reported where somebody wrote the
// name: the "set" of a preset, the command line, the default of a parameter, or the argument itself. Any
// other as it is.
base::Diagnostic placedAtArgument(Model& model, Scope& scope, const std::vector<NamedExpr>& arguments,
                                  base::Diagnostic problem);

}  // namespace weft::graph::expansion
