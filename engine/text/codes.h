// Every diagnostic code of Weft: what is printed ("W053"), its name in C++, its one-line title: the rows of codes.json beside this
// file, which also says what each means and what mends it. docs/errors.md has one section per code, and tests/bad_graphs (or the
// room's tests) one failing input per code.
//
// Ranges: W001-W019 JSON and files, W020-W039 expressions and references, W040-W099 graph (expansion, validation),
// W100-W149 shaders and GL, W150-W179 assets and scenes, W180-W199 command line, runtime and outputs, W200-W219 limits, W220-W239 pipelines of other
// programs, W240-W259 graph again.
// Numbers are never reused; W010 (overlays are not supported yet), W027 (like a pass that is not there), W087 (reserved kinds), W088 (reads of what timed passes made) and W093-W099 (workloads) are retired. Does not hold the message texts: those
// are in the sentences.json of each room.
#pragma once

#include <cstdint>

#include "code_rows.h"  // made by the build: WEFT_CODES(X), as X(W001, unreadableFile, "file cannot be read") and so on

namespace weft::text {

// 53 of "W053".
constexpr std::uint16_t numberOf(const char* code) {
  std::uint16_t number = 0;
  for (const char* digit = code + 1; *digit != 0; ++digit)
    number = static_cast<std::uint16_t>(10 * number + (*digit - '0'));
  return number;
}

// A diagnostic code; the numeric value is what follows the W in "W040".
enum class Code : std::uint16_t {
#define WEFT_CODE_ENUM(number, name, title) name = numberOf(#number),
  WEFT_CODES(WEFT_CODE_ENUM)
#undef WEFT_CODE_ENUM
};

// The title of a code as it stands in the table above.
constexpr const char* titleOf(Code code) {
  switch (code) {
#define WEFT_CODE_CASE(number, name, title) \
  case Code::name:                          \
    return title;
    WEFT_CODES(WEFT_CODE_CASE)
#undef WEFT_CODE_CASE
  }
  return "";
}

}  // namespace weft::text
