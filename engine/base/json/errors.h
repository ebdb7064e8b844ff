// Turns what nlohmann's lexer and parser object to into a diagnostic with the exact place and a message a
// person can act on. Private to dom.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"

namespace weft::base {

// The text of a file and where its lines begin.
class JsonText {
 public:
  JsonText(std::string_view text, std::shared_ptr<const std::string> file);

  std::string_view text() const { return text_; }
  char at(std::size_t offset) const { return text_[offset]; }
  Place placeOf(std::size_t offset) const;
  // The offset of the opening quote of the string whose closing quote stands just before `end`; also for a
  // string that is still open at `end`. Every quote inside a string has an odd number of backslashes before
  // it, no other has.
  std::size_t startOfString(std::size_t end) const;

 private:
  std::string_view text_;
  std::shared_ptr<const std::string> file_;
  std::vector<std::uint32_t> lines_;  // offset of the first character of each line
};

// The innermost object or array that is open where the error is.
struct JsonOpening {
  bool object = false;
  Place place;
};

// False, with a diagnostic, for an empty file and for zero bytes (which nlohmann's lexer takes for the end).
bool reportUnreadable(const JsonText& text, Diagnostics& diagnostics);

// `consumed`: characters read when the error was found; `token`: the text of a number (for other tokens the
// lexer does not keep it apart from what came before); `what`: nlohmann's message; `key`: the last key read.
void reportJsonError(const JsonText& text, std::size_t consumed, const std::string& token,
                     std::string_view what, const std::optional<JsonOpening>& inside, const std::string& key,
                     Diagnostics& diagnostics);

}  // namespace weft::base
