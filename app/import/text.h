// What the importers share: GLSL that is changed token by token, JSON of graph files as text, and reports. Does not: know types
// of GLSL, or which branch of an #if is taken.
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/import/import.h"

namespace weft::convert {

// Reports an error in a foreign file.
void refuse(base::Diagnostics& diagnostics, base::Code code, const base::Place& place, std::string message,
            std::string hint);

bool contains(const auto& words, std::string_view word) {
  return std::ranges::find(words, word) != std::end(words);
}

// Reports (W044) what `options.images` names and the file does not have; false then.
bool checkImageNames(const ConvertOptions& options, std::span<const std::string> known,
                     base::Diagnostics& diagnostics);

struct Token {
  std::string_view text;
  std::uint32_t line = 0, column = 0;  // from 1
  bool word = false, first = false;    // a word or a keyword; the first token of its line
  bool is(std::string_view what) const { return text == what; }
};
// Words, numbers and single signs; comments are left out, directives are not.
std::vector<Token> splitTokens(std::string_view text);

// Every byte that is not changed, comments and line ends included, stays where it is, so that lines keep their numbers.
class GlslText {
 public:
  explicit GlslText(std::string_view text);  // which must outlive this

  const std::vector<Token>& tokens() const { return tokens_; }
  // "define" for all tokens of a #define, and so on; empty outside of directives.
  std::string_view directiveOf(std::size_t token) const { return directives_[token]; }
  // A word that is no member of something: not behind a '.'.
  bool isName(std::size_t token) const;

  void replace(std::size_t token, std::string replacement) {
    replaceRange(token, token, std::move(replacement));
  }
  void replaceRange(std::size_t first, std::size_t last, std::string replacement);
  // Every name `from` that is no member.
  void rename(std::string_view from, std::string_view to);
  // Names that the text declares outside its functions or by #define and that `taken` holds get a '_' behind them.
  void renameTaken(std::span<const std::string_view> taken);
  // #version, #extension and #line become blank.
  void blankVersions();
  // The text with all changes; of changes that overlap, the first in the text wins.
  std::string changed() const;

 private:
  std::size_t offsetOf(std::size_t token) const {
    return static_cast<std::size_t>(tokens_[token].text.data() - text_.data());
  }

  struct Change {
    std::size_t begin, end;
    std::string replacement;
  };
  std::string_view text_;
  std::vector<Token> tokens_;
  std::vector<std::string_view> directives_;  // by token
  std::set<std::string_view> outside_;        // names outside all braces and brackets, and of macros
  std::vector<Change> changes_;
};

// A name as GLSL, JSON and paths take it: other characters become '_', a digit is not the first.
std::string identifierOf(std::string_view text);
// `wanted`, or with a number behind it where `used` has it; from then on `used` has it.
std::string freshName(std::set<std::string, std::less<>>& used, const std::string& wanted);
// `text` with every NAME of `words` replaced by its value; for the templates in app/import/glsl.
std::string fillTemplate(std::string text,
                         std::initializer_list<std::pair<std::string_view, std::string_view>> words);
// What a shader of Weft is compiled with where the slot has something: HAS_INPUTIMAGE.
std::string presenceDefineOf(std::string_view slot);

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
// A graph file of these members.
std::string graphText(const JsonObjectText& members);

}  // namespace weft::convert
