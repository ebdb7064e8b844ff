#include "app/lsp/text/glsl_outline.h"

#include <algorithm>

#include "engine/glsl/tokens.h"

namespace weft::app::lsp {

GlslOutline::GlslOutline(std::string_view text) {
  const auto beginOf = [&](const glsl::Token& token) {
    return static_cast<std::size_t>(token.text.data() - text.data());
  };
  const auto rangeOf = [&](const glsl::Token& token) {
    return Range{beginOf(token), beginOf(token) + token.text.size()};
  };
  const std::vector<glsl::Token> tokens = glsl::splitTokens(text);
  std::vector<glsl::Token> code;  // without directives
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].kind == glsl::TokenKind::word)
      words.push_back({tokens[i].text, rangeOf(tokens[i]), i > 0 && tokens[i - 1].is(".")});
    if (!tokens[i].first || !tokens[i].is("#")) {
      code.push_back(tokens[i]);
      continue;
    }
    const std::size_t hash = i, begin = beginOf(tokens[hash]);
    const std::size_t line = std::min(text.find('\n', begin), text.size());
    const bool include = i + 1 < tokens.size() && tokens[i + 1].is("include");
    for (; i + 1 < tokens.size() && !tokens[i + 1].first; ++i)
      if (!include && i > hash && tokens[i + 1].kind == glsl::TokenKind::word)
        words.push_back({tokens[i + 1].text, rangeOf(tokens[i + 1]), tokens[i].is(".")});
    if (i >= hash + 2 && tokens[hash + 1].is("define"))
      names.push_back(
          {{}, tokens[hash + 2].text, rangeOf(tokens[hash + 2]), {}, text.substr(begin, line - begin)});
    const std::size_t open = include ? text.find('"', begin) : line;
    const std::size_t close = open < line ? text.find('"', open + 1) : line;
    if (close < line) includes.push_back({text.substr(open + 1, close - open - 1), {open + 1, close}});
  }
  using enum glsl::Role;
  for (const glsl::Declaration& each : glsl::readInterface(code).declarations) {
    constexpr glsl::Role kShown[] = {sampler, image,  uniform,       input,
                                     output,  member, uniform_block, storage_block};
    if (std::ranges::find(kShown, each.role) == std::end(kShown)) continue;
    const std::size_t begin = beginOf(each.begin), end = beginOf(each.end) + (each.end.is(";") ? 1 : 0);
    names.push_back({each.role, each.name, rangeOf(each.at),
                     each.role == member ? each.owner : std::string_view(), text.substr(begin, end - begin)});
  }
  std::ranges::stable_sort(names, {}, [](const GlslName& name) { return name.range.begin; });
}

const GlslName* GlslOutline::find(std::string_view name) const {
  const auto found = std::ranges::find(names, name, &GlslName::name);
  return found == names.end() ? nullptr : &*found;
}

const GlslWord* GlslOutline::wordAt(std::size_t offset) const {
  const auto found =
      std::ranges::find_if(words, [&](const GlslWord& word) { return word.range.holds(offset); });
  return found == words.end() ? nullptr : &*found;
}

}  // namespace weft::app::lsp
