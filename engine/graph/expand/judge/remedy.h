// What helps where a version is missing: another texture to present, what to disable too. Finds the words for a fix that works
// with the switches as they are; does not report.
#pragma once

#include <string>
#include <vector>

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Why a pass whose "enabled" is false is disabled. Kept for each instance, so a long expression is cut.
std::string whyFalse(const Expr& enabled);
// Whether --disable or a checkbox has taken this pass out, and not its "enabled".
bool isSwitchedOff(const Model& model, const DisabledPass& disabled);

// `"present": "hdr" at FILE:LINE:COLUMN`, where `missing` is what the graph presents and 'hdr' is as large, has colours and was
// written last before this position, or has a clear. "" otherwise.
std::string otherPresent(Model& model, std::uint32_t missing, std::uint32_t position);

// "'a' and 'b'": the passes to disable so that nothing needs what `writer` would write; one include that holds all of the readers
// and not the writer stands for them. "" for more than four.
std::string namesToDisable(const std::vector<std::string>& readers, std::string_view writer);

// For "x[k]" of what is no array.
std::string hintForElement(const std::string& name, std::int64_t element, bool levels);

}  // namespace weft::graph::expansion
