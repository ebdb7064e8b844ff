// A GLSL text that is changed token by token: every other byte, comments and line ends included, stays where it is,
// so that lines keep their numbers. Names are told apart from members (behind a '.') and directives. Does not: know
// types, or which branch of an #if is taken.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/glsl/tokens.h"

namespace weft::convert {

class GlslText {
 public:
  // `text` must outlive this object.
  explicit GlslText(std::string_view text);

  std::string_view text() const { return text_; }
  const std::vector<glsl::Token>& tokens() const { return tokens_; }
  std::size_t offsetOf(std::size_t token) const {
    return static_cast<std::size_t>(tokens_[token].text.data() - text_.data());
  }
  // The token stands in a directive such as #define; `nameOfDirective` is "define" then.
  bool isDirective(std::size_t token) const { return !directives_[token].empty(); }
  std::string_view directiveOf(std::size_t token) const { return directives_[token]; }
  // A word that is no member of something: not behind a '.'.
  bool isName(std::size_t token) const;
  bool mentions(std::string_view name) const;
  // Names that stand outside all braces and brackets, and those that a #define makes.
  const std::set<std::string_view>& declaredOutside() const { return outside_; }

  void replace(std::size_t token, std::string replacement) {
    replaceRange(offsetOf(token), offsetOf(token) + tokens_[token].text.size(), std::move(replacement));
  }
  void replaceRange(std::size_t begin, std::size_t end, std::string replacement);
  // Every name `from` that is no member.
  void rename(std::string_view from, std::string_view to);
  // The directive that `token` belongs to, with its continued lines, becomes blank.
  void blankDirective(std::size_t token);
  // The text with all changes; of changes that overlap, the first in the text wins.
  std::string changed() const;

 private:
  struct Change {
    std::size_t begin, end;
    std::string replacement;
  };
  std::string_view text_;
  std::vector<glsl::Token> tokens_;
  std::vector<std::string_view> directives_;  // by token
  std::set<std::string_view> outside_;
  std::vector<Change> changes_;
};

// A name as GLSL, JSON and paths take it: other characters become '_', a digit is not the first.
std::string identifierOf(std::string_view text);

// What a shader of Weft is compiled with where the slot has something: HAS_INPUTIMAGE.
std::string presenceDefineOf(std::string_view slot);

}  // namespace weft::convert
