// The values of a JSON text with their byte ranges, also of a text that is being typed: what is broken is passed over.
// Comments are skipped; one that is never closed ends with its line. Does not: report (the reader does), resolve escapes in
// strings other than those of quotes and backslashes, or convert numbers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/lsp/text/positions.h"

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
class JsonOutline {
 public:
  explicit JsonOutline(std::string_view text);
  const Node& root() const { return *root_; }

  struct Spot {
    const Node* node = nullptr;  // the innermost value here, or the container around an empty place
    bool inKey = false;          // in the key of `node`
    bool atKey = false;          // in an object, where a key may begin
    bool inComment = false;
  };
  Spot at(std::size_t offset) const;

 private:
  class Parser;
  std::vector<Range> comments_;  // before root_, whose parser fills it
  std::unique_ptr<Node> root_;
};

}  // namespace weft::app::lsp
