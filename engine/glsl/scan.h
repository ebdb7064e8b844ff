// The lexical part of shader_source: lines with their directives, and the names a text mentions and declares.
// Knows comments and brackets; does not know macros, types or which branch of an #if is taken. Not for other
// rooms.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "engine/glsl/declared.h"

namespace weft::glsl {

struct Directive {
  std::string_view name;     // "include", or "" when the line is none
  std::string_view rest;     // what follows, trimmed, without comments
  std::uint32_t column = 0;  // of the '#', from 1
};

// Walks the lines of a text. A directive inside a comment is none. Views live until next().
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : rest_(text) {}
  bool next();
  std::string_view line() const { return line_; }   // without its newline
  std::uint32_t number() const { return number_; }  // from 1
  const Directive& directive() const { return directive_; }
  // Of #if around the line. The guard of a whole file, #ifndef X with #define X next, does not count: what it leaves out is there
  // already.
  int depth() const { return depth_ - guard_; }

 private:
  void strip();
  std::string_view rest_, line_;
  std::string code_;  // the line, comments as spaces, columns kept
  std::uint32_t number_ = 0;
  int depth_ = 0;
  int guard_ = 0;       // 1 within it
  std::string guards_;  // the X of a first directive #ifndef X, until the next directive
  int directives_ = 0;
  bool inComment_ = false;
  Directive directive_;
};

using NameSet = std::set<std::string, std::less<>>;

// `identifiers`: every identifier outside comments. `declared`: names of uniforms, blocks, block members, ins
// and outs as far as brackets tell; branches of an #if that split a bracket may confuse it, so it is for
// hints only. So are `parts`.
void scanNames(std::string_view text, NameSet& identifiers, NameSet& declared, DeclaredParts& parts);

}  // namespace weft::glsl
