// The short spellings of a file, written out as what everything behind the parser knows: lists of names as objects, "inputs" as
// resources, and groups of passes as passes.
#pragma once

#include <functional>

#include "engine/text/diagnostic.h"
#include "engine/text/json/dom.h"

namespace weft::graph {

// Makes objects of the lists under "read", "write", "modify", "bind" and "parameters" of passes and sets: ["ibl.brdf", { "sky":
// "clouds" }] is { "brdf": "ibl.brdf", "sky": "clouds" }. Each name stands where its string does. What is neither a string nor
// an object stays a list, which does not fit the schema.
// An input, "specular as linear ?", becomes the resource "specular": { "inputs": "specular as linear ?" }.
// Each pass of a group gets what the group says; "enabled" and "repeat", which it may have itself, stand together under its key
// "passes", at the place of the group. `mayShare(group, place)`: whether one more pass may get it; a report says that it may not.
void writeOutLists(
    text::JsonValue& root,
    const std::function<bool(const text::JsonValue& group, const text::Place& place)>& mayShare,
    text::Diagnostics& diagnostics);

}  // namespace weft::graph
