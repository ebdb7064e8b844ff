// The short spellings of a file, written out as what everything behind the parser knows: lists of names as objects, and "inputs" as
// resources.
#pragma once

#include "engine/text/diagnostic.h"
#include "engine/text/json/dom.h"

namespace weft::graph {

// Makes objects of the lists under "read", "write", "modify", "bind" and "parameters" of passes and sets: ["ibl.brdf", { "sky":
// "clouds" }] is { "brdf": "ibl.brdf", "sky": "clouds" }. Each name stands where its string does. What is neither a string nor
// an object stays a list, which does not fit the schema.
// An input, "specular as linear ?", becomes the resource "specular": { "inputs": "specular as linear ?" }.
void writeOutLists(text::JsonValue& root, text::Diagnostics& diagnostics);

}  // namespace weft::graph
