// Text that came from files, drivers and command lines, made fit to be printed: nothing in it can move a
// terminal's cursor, colour it, turn its direction, or begin a line that looks like one of Weft's own. Does
// not: quote, wrap, or translate.
#pragma once

#include <string>
#include <string_view>

namespace weft::base {

// One line: control characters (C0, DEL, C1), line and paragraph separators, marks that turn the direction of
// text, and bytes that are no UTF-8 become `\n`, `\x1b`, `\u{202e}`; everything else stays.
std::string printable(std::string_view text);

// At most about 400 bytes: a word without a space in it is cut after 200 bytes when it has more than 256, and
// the whole after 360; how long it was stands behind "…". Cut between characters.
std::string shortened(std::string_view text);

// A whole JSON document, whose C0 characters are escaped already: of what printable() escapes, the rest
// becomes \uXXXX, which means the same in JSON.
std::string printableJson(std::string_view json);

}  // namespace weft::base
