// Pieces of JSON text for graph files that are made by a program; base::layoutJson then lays the whole file out. Does
// not: check anything.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace weft::convert {

// Members of one object, in the order of adding.
class JsonObjectText {
 public:
  // `json` is a value as text; one that is empty is left out.
  JsonObjectText& add(std::string_view key, const std::string& json);
  JsonObjectText& addText(std::string_view key, std::string_view text);
  bool empty() const { return members_.empty(); }
  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

// The shortest text that gives the number again; with a point or an exponent where `real`.
std::string numberText(double number, bool real);
// One number, or a list of them.
std::string numbersText(std::span<const double> numbers, bool real);

// A graph file: what layoutJson makes of `members` behind a "$schema".
std::string graphText(const JsonObjectText& members);

}  // namespace weft::convert
