// Every key and word of the graph format. The keys come from its JSON Schema, docs/graph.schema.json, which the build puts into
// the program: what the reader accepts, what completion offers and what editors check through "$schema" is one text. It
// describes shapes and words; names, expressions and references are checked by the reader and by expansion.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace weft::graph {

constexpr std::array<std::string_view, 8> kParameterTypes = {"bool", "int",  "float",  "vec2",
                                                             "vec3", "vec4", "choice", "file"};
constexpr std::array<std::string_view, 3> kUpdateWords = {"always", "on_change", "once"};  // or every(n)

// Of "depth_test" and `as compare(…)`, in the order of Compare.
constexpr std::array<std::string_view, 8> kCompareNames = {
    "never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"};

// The text of the schema (draft 2020-12).
extern const char* const kGraphSchema;

struct Shape;

struct KeySpec {
  std::string_view key, doc;
  bool required = false;
  std::span<const std::string_view> words = {};  // that it may be, where these are few
  const Shape* shape = nullptr;
};

// What the schema says of a value.
struct Shape {
  std::string_view kind, doc;  // "texture" and what it is, of a named definition
  unsigned types = 0;          // a bit for each JsonValue::Type that it may be; 0: any
  std::vector<KeySpec> keys;
  const Shape* others = nullptr;  // the values of all other keys; null: there are none
  const Shape* items = nullptr;   // of an array
  std::size_t minItems = 0, maxItems = ~std::size_t{0};
  std::vector<const Shape*> anyOf;
  std::span<const std::string_view> words = {};  // that it may be, or, with `open`, that are examples
  bool open = true;
  // Null for a key of which it says nothing.
  const KeySpec* find(std::string_view key) const;
};
// Of a definition of the schema: "resource".
const Shape& shapeOf(std::string_view kind);
// Of a whole file: of a graph, or of one that changes others.
const Shape& shapeOfFile(bool changes);

// Of "cull", "blend.SLOT", "blend.SLOT.source", "stencil.back.pass"; null when there is none.
const KeySpec* findStateKey(std::string_view path);
// The words that such a key may be, in the order of the enumeration in flat_graph.h.
std::span<const std::string_view> stateWords(std::string_view path);
// Of a stanza in an overlay, beside those of passes and includes.
std::span<const KeySpec> placeKeys();

}  // namespace weft::graph
