// A shader's text as the tokens that a compiler gets: comments and directives gone, conditionals decided,
// macros expanded, each token with the line of the text that it comes from. The work is bounded: macros that
// double again and again are given up. Where a condition hangs on what only the
// driver knows (a macro GL_…), all its branches are taken. Whether the text is right, the compiler says.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "engine/glsl/source.h"

namespace weft::glsl {

enum class TokenKind : std::uint8_t { word, number, sign };

struct Token {
  std::string_view text;
  std::uint32_t line = 0, column = 0;  // in the text, from 1; of a macro's tokens: where the macro is used
  TokenKind kind = TokenKind::sign;
  bool first = false;  // of its line
  bool inert = false;  // the name of a macro inside its own expansion
  bool is(std::string_view what) const { return text == what; }
};

struct TokenList {
  std::vector<Token> tokens;
  std::deque<std::string> pasted;  // what views of `tokens` may look into besides the text
  // Tokens are missing: macros make too many, or a call of one is interrupted by a directive or nested too deeply. Or an #if was
  // too long to look at.
  bool uncertain = false;
};

// `text` as ShaderSource::text; `defines` as assembleSource() puts them before it. `deepest`: nesting beyond it is cut off.
// `branches`: those of conditionals, the taken ones or all of them.
enum class Branches : std::uint8_t { taken, all };
TokenList expandTokens(std::string_view text, std::span<const Define> defines, std::uint32_t deepest,
                       Branches branches = Branches::taken);

// The words of the conditionals of a text, in any branch. Views look into the text.
struct Conditions {
  std::vector<Token> valued, tested;  // in an #if or #elif; of #ifdef, #ifndef and defined()
  // Words that a #define of the text makes, and those whose value counts anywhere.
  std::unordered_set<std::string_view> made, used;
};
Conditions conditionsOf(std::string_view text);

// "HAS_GAIN": what a shader finds defined when its pass has the slot or parameter "gain".
std::string presenceDefineOf(std::string_view name);

// The tokens of a text as it stands, directives included.
std::vector<Token> splitTokens(std::string_view text);

// The value of a constant expression of whole numbers, brackets and operators; `valueOf` knows names. Nothing
// when it is none, or is nested more than `deepest` deep.
std::optional<std::int64_t> evaluateTokens(
    std::span<const Token> tokens,
    const std::function<std::optional<std::int64_t>(std::string_view)>& valueOf, std::uint32_t deepest);

}  // namespace weft::glsl
