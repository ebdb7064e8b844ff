// JSON text as a tree of slices of it, with its comments and blank lines. Private to engine/base/json/layout*.cpp. Does
// not: check anything; the text is one that parseJson takes.
#pragma once

#include <string_view>
#include <vector>

namespace weft::base::layout {

struct Comment {
  std::string_view text;  // with its slashes, without a line end
  bool blankBefore = false;
  bool toLineEnd() const { return text.starts_with("//"); }
  // Nothing else stands in its last line.
  bool endsLine() const { return toLineEnd() || text.find('\n') != std::string_view::npos; }
};

struct Item;

struct Node {
  enum class Kind : unsigned char { scalar, object, array };
  Kind kind = Kind::scalar;
  std::string_view text;          // of a scalar
  std::vector<Item> items;        // of an object or an array
  std::vector<Comment> dangling;  // in front of the closing bracket
  int width = 0;                  // on one line; kBroken: it cannot be
  bool commented = false;         // inside
  bool isContainer() const { return kind != Kind::scalar; }
};

// A member of an object or an item of an array.
struct Item {
  std::vector<Comment> leading;  // in front of it
  std::string_view key;          // with its quotes; empty in an array
  Node value;
  std::vector<Comment> trailing;  // behind it, on its last line
  bool blankBefore = false;       // between the leading comments, or what is before, and the key or value
  int width = 0;                  // as that of a node, with key and comments
};

constexpr int kBroken = 1'000'000;

struct Document {
  std::vector<Comment> before, after;
  bool blankBefore = false;  // in front of the value
  Node root;
};

Document parse(std::string_view text);

// Characters, not bytes.
int widthOf(std::string_view text);

}  // namespace weft::base::layout
