// The one tree of a JSON text: every value and every key keeps its bytes in the text, its file, line and column.
// Comments (// and /* */) are listed beside it, so that a text can be laid out and edited by its tree without a loss. A leading
// byte order mark is passed over. Never throws on any input.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::text {

struct JsonMember;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Bytes [begin, end) of a text.
struct ByteRange {
  std::size_t begin = 0, end = 0;
  bool holds(std::size_t at) const { return begin <= at && at <= end; }
};

struct JsonValue {
  // broken: what is no value, such as a misspelt word; absent: nothing where a value should be. Only parseJsonTree gives them.
  enum class Type : std::uint8_t { null, boolean, number, string, array, object, broken, absent };
  Type type = Type::null;
  bool flag = false;   // boolean
  bool whole = false;  // number: written without a point or an exponent
  bool closed = true;  // false: the closing quote or bracket is missing
  Place place;         // of its first character: the opening quote, brace or bracket, the first digit
  std::uint32_t begin = 0, end = 0;  // its bytes in the text
  double number = 0;                 // finite
  std::string text;                  // string, escapes resolved
  std::vector<JsonValue> items;      // array
  std::vector<JsonMember> members;   // object, in file order; parseJson gives every key once

  bool is(Type other) const { return type == other; }
  // The member's value, or null.
  const JsonValue* find(std::string_view key) const;
  // The place of the first character inside the quotes of a string.
  Place textPlace() const { return place.after(1); }
};

struct JsonMember {
  std::string key;
  Place place;  // of the key's opening quote
  JsonValue value;
  std::uint32_t begin = 0, end = 0;  // the bytes of the key, with its quotes
  bool closed = true;                // false: the closing quote of the key is missing
  bool hasValue = true;              // false: a key without ':'
};

// A text of any kind as a tree: what is broken is passed over, a string ends with its line at the latest, and so does a
// comment that is never closed. Keys may appear twice. The values have no places.
struct JsonTree {
  JsonValue root;
  std::vector<ByteRange> comments;  // without line ends, in the order of the text

  // Behind the comment that begins at `at`; `at` when none does.
  std::size_t behindComment(std::size_t at) const;
};
JsonTree parseJsonTree(std::string_view text);

// How deep objects and arrays may be nested.
constexpr int kMaxJsonDepth = 64;
constexpr std::uint64_t kMaxValues = 1'500'000;  // of all JSON files of one graph, each use counted
constexpr std::uint64_t kMaxNameBytes = 255;     // of a name or a key

// Empty after Code::notJson, Code::nestedTooDeeply or Code::limitExceeded (a text beyond the limit json_bytes, more values
// than json_values, a key beyond name_bytes). A duplicate key is reported as Code::duplicateKey, its later value is dropped,
// and reading goes on. `file` becomes part of every place and may be null.
std::optional<JsonValue> parseJson(std::string_view text, FileName file, Diagnostics& diagnostics);

// Where a place with a line is in the text of its file.
std::size_t offsetOf(std::string_view text, const Place& place);

// The innermost value around a byte of a tree's text, or the value of the key there; and its JSON pointer (RFC 6901),
// "/passes/3/read/source", or "" of the document.
const JsonValue& valueAt(const JsonValue& root, std::size_t at);
std::string pointerAt(const JsonValue& root, std::size_t at);

// "an object", "a string": for "expected" and "found".
const char* nameOf(JsonValue::Type type);
// "the number 3", "the string \"high\"", "an object": what stands in the file, shortened.
std::string describe(const JsonValue& value);

}  // namespace weft::text
