// Small changes of a JSON text that leave every other byte as it is: comments, layout, line ends, a byte order mark. New members
// and items take the style of those around them: a line of their own or the same line, the indentation, tabs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/text/json/dom.h"

namespace weft::text {

// A text and its tree. Each change gives the whole changed text; what it is given as `json` is JSON text. The text must outlive
// it.
class JsonEdit {
 public:
  explicit JsonEdit(std::string_view text);
  // False when the text has mistakes; then nothing is to be changed.
  explicit operator bool() const { return good_; }
  const JsonValue& root() const { return tree_.root; }
  const JsonValue& valueAt(const Place& place) const {
    return text::valueAt(tree_.root, offsetOf(text_, place));
  }
  std::string_view written(const JsonValue& value) const {
    return text_.substr(value.begin, value.end - value.begin);
  }

  std::string withValue(const JsonValue& value, std::string_view json) const;
  // With a new last member, or one behind the member `after` where that is there. The object does not have the key.
  std::string withMember(const JsonValue& object, std::string_view key, std::string_view json,
                         std::string_view after = {}) const;
  // With a new last item.
  std::string withItem(const JsonValue& array, std::string_view json) const;

 private:
  // `added` behind element `index` of the elements of a container, of which there is one at least.
  std::string putBehind(const std::vector<ByteRange>& elements, std::size_t index,
                        const std::string& added) const;

  std::string_view text_;
  JsonTree tree_;
  bool good_ = false;
};

// A string as JSON, with quotes and the escapes that are needed.
std::string quoteJson(std::string_view text);

// One layout for the JSON files that people write: lines of at most 120 characters, short objects on one
// line, comments and blank lines between entries kept. The same values and comments always give the same
// text, and that text stays as it is. Strings and numbers keep the way they are written; a string or
// a comment that is too long is not broken.

// `text` is what parseJson takes without a report. Line ends (the first one's kind) and a byte order mark
// stay.
std::string layoutJson(std::string_view text);

}  // namespace weft::text
