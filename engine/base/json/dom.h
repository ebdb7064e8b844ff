// A JSON document in which every value and every key keeps its file, line, column and JSON pointer. Built
// through nlohmann-json's SAX interface with a counting input adapter (its own DOM keeps no places
// in 3.11.2). Extensions: // and /* */ comments, a leading byte order mark. Never throws on any input. Does
// not: know graphs, resolve includes, or keep comments and layout.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/base/json/pointer.h"

namespace weft::base {

struct JsonMember;

struct JsonValue {
  enum class Type : std::uint8_t { null, boolean, number, string, array, object };
  Type type = Type::null;
  bool flag = false;    // boolean
  bool whole = false;   // number: written without a point or an exponent
  Place place;          // of its first character: the opening quote, brace or bracket, the first digit
  JsonPointer pointer;  // "/passes/3/read/source"; "" for the document
  double number = 0;    // finite
  std::string text;     // string, escapes resolved
  std::vector<JsonValue> items;     // array
  std::vector<JsonMember> members;  // object, in file order, every key once

  bool is(Type other) const { return type == other; }
  // The member's value, or null.
  const JsonValue* find(std::string_view key) const;
  // The place of the first character inside the quotes of a string.
  Place textPlace() const;
};

struct JsonMember {
  std::string key;
  Place place;  // of the key's opening quote
  JsonValue value;
};

// How deep objects and arrays may be nested.
constexpr int kMaxJsonDepth = 64;

// Empty after Code::notJson, Code::nestedTooDeeply or Code::limitExceeded (a text beyond the limit json_bytes, more values
// than json_values, a key beyond name_bytes). A duplicate key is reported as Code::duplicateKey, its later value is dropped,
// and reading goes on. `file` becomes part of every place and may be null.
std::optional<JsonValue> parseJson(std::string_view text, const std::shared_ptr<const std::string>& file,
                                   Diagnostics& diagnostics);

// "an object", "a string": for "expected" and "found".
const char* nameOf(JsonValue::Type type);
// "the number 3", "the string \"high\"", "an object": what stands in the file, shortened.
std::string describe(const JsonValue& value);

}  // namespace weft::base
