// Says in plain words what shader compilers report: tokens of Mesa's grammar become what they stand for, an undeclared
// name is reported in the same words for every driver and with the nearest declared one, and a syntax error says what
// is probably missing. An unknown message stays as the driver wrote it. Does not: find places (mapLog in log.cpp does).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/glsl/source.h"

namespace weft::gl {

// A message of a log with its true place. `textLine` counts in source.text; 0: nowhere in it.
struct LogMessage {
  base::Diagnostic diagnostic;
  std::uint32_t textLine = 0;
};

// Rewrites message, expected and hint.
void explainMessage(LogMessage& message, const glsl::ShaderSource& source,
                    std::span<const glsl::Define> defines);

// Takes away errors that only follow from another one of the list: on the same line, or about the type
// "error" that Mesa gives to what it could not understand. Before explainMessage.
void dropConsequences(std::vector<LogMessage>& messages, const glsl::ShaderSource& source);

// Line `number` (from 1) of a text.
std::string_view lineOf(std::string_view text, std::uint32_t number);

}  // namespace weft::gl
