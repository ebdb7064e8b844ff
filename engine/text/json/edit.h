// Small changes of a JSON text that leave every other byte as it is: comments, layout, line ends, a byte order mark. New members
// and items take the style of those around them: a line of their own or the same line, the indentation, tabs.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/json/dom.h"

namespace weft::text {

// A text, which must outlive it, and its tree. Each change gives the whole changed text; `json` is JSON text.
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

// JSON is printed and parsed here for every room, since either takes long to compile. `indent` -1: one line; bytes that are no UTF-8
// are replaced; what is no JSON becomes a discarded value.
std::string dumpJson(const nlohmann::ordered_json& json, int indent = 2, bool ascii = true);
nlohmann::ordered_json loadJson(std::string_view text);

// One layout for the JSON files that people write: lines of at most 120 characters, short objects on one
// line, comments and blank lines between entries kept. The same values and comments always give the same
// text, and that text stays as it is. Strings and numbers keep the way they are written; a string or
// a comment that is too long is not broken.

// A comment as it is written, with its slashes, without a line end.
struct LayoutComment {
  std::string_view text;
  bool blankBefore = false;
  bool toLineEnd() const { return text.starts_with("//"); }
  // Nothing else stands in its last line.
  bool endsLine() const { return toLineEnd() || text.find('\n') != std::string_view::npos; }
};

struct LayoutItem;

// A value with its comments.
struct LayoutNode {
  enum class Kind : unsigned char { scalar, object, array };
  Kind kind = Kind::scalar;
  std::string line;                     // of a scalar, as it is written
  std::vector<LayoutItem> items;        // of an object or an array
  std::vector<LayoutComment> dangling;  // in front of the closing bracket
  bool isContainer() const { return kind != Kind::scalar; }
  // The member of that key, or null.
  LayoutItem* find(std::string_view key);
  // What a string says, without its quotes; "" of another value.
  std::string_view word() const {
    return line.starts_with('"') ? std::string_view(line).substr(1, line.size() - 2) : std::string_view();
  }
};

// A member of an object or an item of an array.
struct LayoutItem {
  std::vector<LayoutComment> leading;  // in front of it
  std::string key;                     // with its quotes and the colon, "\"name\": "; empty in an array
  LayoutNode value;
  std::vector<LayoutComment> trailing;  // behind it, on its last line
  bool blankBefore = false;  // between the leading comments, or what is before, and the key or value
  std::string line;          // all of it on one line, with key and comments; empty when it cannot be
  std::string_view name() const {
    return key.empty() ? std::string_view() : std::string_view(key).substr(1, key.size() - 4);
  }
};

// `text` is what parseJson takes without a report. Line ends (the first one's kind) and a byte order mark
// stay. `change` may change the values before they are laid out.
std::string layoutJson(std::string_view text, const std::function<void(LayoutNode& root)>& change = {});

}  // namespace weft::text
