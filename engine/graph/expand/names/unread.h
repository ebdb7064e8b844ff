// Names that are unknown: what their author may have meant, and those that are unknown only because something else went
// wrong, left out by the reader, or of an include that is not there. One mistake is reported once.
#pragma once

#include <string>
#include <string_view>

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// The first stanza that includes a file that could not be read, or null.
const PassDesc* failedInclude(const Scope& scope);
// True when the reader reported the declaration of this name and left it out: a use of it is no second
// mistake.
bool isUnread(const Scope& from, std::string_view name);
// True when nothing is known of this variable because an include could not be read, which the reader
// reported.
bool mayBeUnread(const Scope& from, std::string_view name);
// "noise.png": a file in the place of a resource.
bool isPicturePath(std::string_view name);
// The fix for a resource that is not there; the arguments are those of findEntityOrReport().
std::string hintForResource(const Model& model, const Scope& scope, std::string_view name, const NamedBy& by,
                            const Place& place);
// True when `name` is dotted and this file includes nothing under its first part: kept for reportUnincluded.
bool isUnincluded(Model& model, Scope& scope, std::string_view name, const Place& place, const NamedBy& by);
// A pass that writes by this slot was left out for its mistakes: what is missing of the resource is no second mistake.
void leaveOutWrite(Model& model, Scope& scope, const RefDesc& ref);
// The "repeat" of a pass is empty, by `range`: what it would write says so when it is missing.
void noteEmptyRepeat(Model& model, Scope& scope, const PassDesc& desc, const RangeDesc& range,
                     EmptyRepeat empty);
// Reports them, each name once: W040, or a note when it is because of an include that could not be read.
void reportUnincluded(Model& model);
}  // namespace weft::graph::expansion
