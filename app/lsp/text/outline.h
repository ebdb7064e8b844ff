// The tree of a JSON text (engine/base/json/dom.h), also of one that is being typed, as editors ask for it: by offset, each
// value with what is around it, and strings as they are written.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/lsp/text/positions.h"
#include "engine/base/json/dom.h"

namespace weft::app::lsp {

struct Node {
  enum class Type : std::uint8_t { absent, word, string, array, object };
  Type type = Type::absent;
  Range range;            // the whole value; of a string with its quotes
  bool closed = true;     // false: of a string or container whose end is missing
  std::string_view text;  // of a string: between the quotes, as written; of a word: all of it
  Range keyRange;         // of a member: its key, without quotes
  std::string_view key;
  bool hasValue = true;  // false: a key without ':'
  const Node* parent = nullptr;
  std::vector<std::unique_ptr<Node>> children;

  const Node* find(std::string_view key) const;
  // The text of a member that is a string, or "".
  std::string_view textOf(std::string_view key) const;
  // The range of the text, without quotes.
  Range inside() const;
};

// The text must outlive it.
class Outline {
 public:
  explicit Outline(std::string_view text);
  const Node& root() const { return *root_; }

  struct Spot {
    const Node* node = nullptr;  // the innermost value here, or the container around an empty place
    bool inKey = false;          // in the key of `node`
    bool atKey = false;          // in an object, where a key may begin
    bool inComment = false;
  };
  Spot at(std::size_t offset) const;

 private:
  std::vector<Range> comments_;
  std::unique_ptr<Node> root_;
};

}  // namespace weft::app::lsp
