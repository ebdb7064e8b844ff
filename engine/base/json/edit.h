// Small changes of a JSON file's text that leave every other byte as it is: comments, layout, line ends, a
// byte order mark. New members and items take the style of those around them: a line of their own or the same
// line, the indentation, tabs. Each function takes and returns the whole text, is given the new value as JSON
// text, and yields nothing when the text does not parse or the pointer leads nowhere. Does not: open files,
// check what the values mean, or remove anything.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/json/dom.h"

namespace weft::base {

// The value at a JSON pointer such as "/passes/3/enabled"; null when there is none.
const JsonValue* findPointer(const JsonValue& root, std::string_view pointer);

// The text with another value at `pointer`.
std::optional<std::string> replaceValue(std::string_view text, std::string_view pointer,
                                        std::string_view json);

// The text with a new last member in the object at `pointer`, or one behind the member `after` where that is
// there. Nothing when the object has the key already.
std::optional<std::string> insertMember(std::string_view text, std::string_view pointer, std::string_view key,
                                        std::string_view json, std::string_view after = {});

// The text with a new last item in the array at `pointer`.
std::optional<std::string> appendItem(std::string_view text, std::string_view pointer, std::string_view json);

// A string as JSON, with quotes and the escapes that are needed.
std::string quoteJson(std::string_view text);

}  // namespace weft::base
