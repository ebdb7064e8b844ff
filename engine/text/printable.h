// Makes text from files, drivers and command lines safe to print: nothing in it can move a terminal's cursor,
// color the terminal, turn the direction of text, or begin a line that looks like one of Weft's own. Does not:
// quote, wrap, or translate.
#pragma once

#include <string>
#include <string_view>

namespace weft::text {

// One line: control characters (C0, DEL, C1), line and paragraph separators, marks that turn the direction of
// text, and bytes that are no UTF-8 become `\n`, `\x1b`, `\u{202e}`; everything else stays.
std::string printable(std::string_view text);

// At most about 400 bytes of `text`. A word of more than 256 bytes is cut after 200, the whole text after 360; "…" and
// the full length follow. Cuts between characters only.
std::string shortened(std::string_view text);

// The same for a whole JSON document, in which C0 characters are escaped already: all other characters that
// printable() escapes become \uXXXX, which means the same in JSON.
std::string printableJson(std::string_view json);

}  // namespace weft::text
