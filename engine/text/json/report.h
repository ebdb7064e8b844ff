// What is printed of many diagnostics, and for other programs: JSON of Weft's own, and SARIF 2.1.0 for code hosts and editors.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/text/diagnostic.h"

namespace weft::text {

constexpr std::uint64_t kMaxMessages = 100;

// After so many errors nothing more is looked for (ten times what is printed by default, and what is printed where that is more):
// a file with thousands is damaged as a whole, and each message costs memory and the search for a fix.
bool enoughErrors(const Diagnostics& diagnostics);

// `all` in the order of their places, exact repeats dropped. Of more than kMaxMessages, errors are preferred to warnings and
// warnings to notes, each from the first place on; a note at the end (W208) counts what is left out. `notes` false: without
// notes, that one aside.
Diagnostics chooseMessages(const Diagnostics& all, bool notes = true);

// A path as an absolute URI, or as a relative reference.
std::string uriOf(std::string_view path);
// With the bytes that "%20" and its kind mean.
std::string unescapeUri(std::string_view uri);

// An array of objects: severity, code, title, message, and where they are known file, line, column (from 1, in bytes),
// pointer, pass, resource, expected, found, fix. `indent` as of a JSON printer; -1: one line.
std::string diagnosticsJson(const Diagnostics& diagnostics, int indent = 2);

// One SARIF document with one run. `version`: of the program.
std::string diagnosticsSarif(const Diagnostics& diagnostics, std::string_view version);

}  // namespace weft::text
