// What the importers share: GLSL that is changed token by token, names, and reports.
#pragma once

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/glsl/tokens.h"
#include "importers/import.h"

namespace weft::importing {

using Json = nlohmann::ordered_json;

// A text of the foreign file, and where it is there.
struct PlacedText {
  std::string text;
  text::Place place;
};

// Reports an error in a foreign file.
void refuse(text::Diagnostics& diagnostics, text::Code code, const text::Place& place, std::string message,
            std::string hint);

bool contains(const auto& words, std::string_view word) {
  return std::ranges::find(words, word) != std::end(words);
}

// Reports (W044) what `options.images` names and the file does not have; false then.
bool checkImageNames(const ConvertOptions& options, std::span<const std::string> known,
                     text::Diagnostics& diagnostics);

// GLSL in which tokens are replaced. Every other byte, comments and line ends included, stays where it is, so that lines keep
// their numbers. #version, #extension and #line become blank.
class GlslText {
 public:
  explicit GlslText(std::string_view text);  // which must outlive this

  const std::vector<glsl::Token>& tokens() const { return tokens_; }
  // A word that is no member of something: not behind a '.'.
  bool isName(std::size_t token) const;

  // Of changes that overlap, the first in the text wins; of the same token, the one that was made first.
  void replace(std::size_t first, std::size_t last, std::string replacement);
  // Every name `from` that is no member.
  void rename(std::string_view from, const std::string& to);
  // Names that the text declares outside its functions or by #define and that `taken` holds get a '_' behind them.
  void renameTaken(std::initializer_list<std::string_view> taken);
  bool declares(std::string_view name) const { return outside_.contains(name); }
  std::string changed() const;

 private:
  std::string_view text_;
  std::vector<glsl::Token> tokens_;
  std::set<std::string_view> outside_;  // names outside all braces and brackets, and of macros
  std::map<std::size_t, std::pair<std::size_t, std::string>> replaced_;  // by first token: the last, the text
};

// A name as GLSL, JSON and paths take it: other characters become '_', a digit is not the first.
std::string identifierOf(std::string_view text);
// `wanted`, or with a number behind it where `used` has it; from then on `used` has it.
std::string freshName(std::set<std::string, std::less<>>& used, const std::string& wanted);
// `text` with every NAME of `words` replaced by its value; for the templates in importers/glsl.
std::string fillTemplate(std::string text,
                         std::initializer_list<std::pair<std::string_view, std::string_view>> words);
// The block of a shader's uniforms; nothing without `members`.
std::string parameterBlockOf(const std::string& members);

// The shortest number that means the same: whole ones of an `int` without a point.
Json numberOf(double number, bool real);
// The text of a graph file.
std::string graphText(const Json& graph);

}  // namespace weft::importing
