// Whether a parameter takes a value: by type, choices and range. Reports and allocates nothing, so that a value can be
// set between two frames; apply_settings.h says what is wrong.
#pragma once

#include "engine/graph/desc.h"

namespace weft::graph {

// 2 to 4 of a list, else 0.
int componentsOf(ParameterDesc::Type type);
bool fitsType(const ParameterDesc& desc, const Value& value);
// Whether a value that fits the type is in the range; of a list every component must be.
bool fitsRange(const ParameterDesc& desc, const Value& value);
inline bool takesValue(const ParameterDesc& desc, const Value& value) {
  return fitsType(desc, value) && fitsRange(desc, value);
}

}  // namespace weft::graph
