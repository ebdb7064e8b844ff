// Diagnostics for other programs: JSON of Weft's own, and SARIF 2.1.0, which code hosts and editors read. Does not: choose
// which of many to tell, or print.
#pragma once

#include <string>
#include <string_view>

#include "engine/text/diagnostic.h"

namespace weft::text {

// A path as an absolute URI, or as a relative reference.
std::string uriOf(std::string_view path);

// An array of objects: severity, code, title, message, and where they are known file, line, column (from 1, in bytes),
// pointer, pass, resource, expected, found, fix. `indent` as of a JSON printer; -1: one line.
std::string diagnosticsJson(const Diagnostics& diagnostics, int indent = 2);

// One SARIF document with one run. `version`: of the program.
std::string diagnosticsSarif(const Diagnostics& diagnostics, std::string_view version);

}  // namespace weft::text
