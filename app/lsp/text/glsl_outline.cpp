#include "app/lsp/text/glsl_outline.h"

#include <algorithm>
#include <optional>

#include "engine/glsl/interface.h"
#include "engine/glsl/tokens.h"

namespace weft::app::lsp {

namespace {

std::optional<GlslName::Kind> kindOf(glsl::Role role) {
  switch (role) {
    case glsl::Role::sampler:
      return GlslName::Kind::sampler;
    case glsl::Role::image:
      return GlslName::Kind::image;
    case glsl::Role::uniform_block:
      return GlslName::Kind::uniform_block;
    case glsl::Role::storage_block:
      return GlslName::Kind::storage_block;
    case glsl::Role::member:
      return GlslName::Kind::member;
    case glsl::Role::output:
      return GlslName::Kind::output;
    case glsl::Role::uniform:
    case glsl::Role::input:
      return GlslName::Kind::input;
    default:
      return std::nullopt;
  }
}

}  // namespace

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
      words_.push_back({tokens[i].text, rangeOf(tokens[i]), i > 0 && tokens[i - 1].is(".")});
    if (!tokens[i].first || !tokens[i].is("#")) {
      code.push_back(tokens[i]);
      continue;
    }
    const std::size_t hash = i;
    const std::size_t line = std::min(text.find('\n', beginOf(tokens[hash])), text.size());
    const bool includes = i + 1 < tokens.size() && tokens[i + 1].is("include");
    for (; i + 1 < tokens.size() && !tokens[i + 1].first; ++i)
      if (!includes && i > hash && tokens[i + 1].kind == glsl::TokenKind::word)
        words_.push_back({tokens[i + 1].text, rangeOf(tokens[i + 1]), tokens[i].is(".")});
    if (i >= hash + 2 && tokens[hash + 1].is("define"))
      names_.push_back({GlslName::Kind::define,
                        tokens[hash + 2].text,
                        rangeOf(tokens[hash + 2]),
                        {},
                        {beginOf(tokens[hash]), line}});
    const std::size_t open = includes ? text.find('"', beginOf(tokens[hash])) : line;
    const std::size_t close = open < line ? text.find('"', open + 1) : line;
    if (close < line) includes_.push_back({text.substr(open + 1, close - open - 1), {open + 1, close}});
  }
  for (const glsl::Declaration& each : glsl::readInterface(code).declarations)
    if (const auto kind = kindOf(each.role))
      names_.push_back({*kind,
                        each.name,
                        rangeOf(each.at),
                        each.role == glsl::Role::member ? each.owner : std::string_view(),
                        {beginOf(each.begin), beginOf(each.end) + (each.end.is(";") ? 1 : 0)},
                        each.reads,
                        each.writes});
  std::ranges::stable_sort(names_, {}, [](const GlslName& name) { return name.range.begin; });
}

const GlslName* GlslOutline::find(std::string_view name) const {
  const auto found = std::ranges::find(names_, name, &GlslName::name);
  return found == names_.end() ? nullptr : &*found;
}

const GlslWord* GlslOutline::wordAt(std::size_t offset) const {
  for (const GlslWord& word : words_)
    if (word.range.holds(offset)) return &word;
  return nullptr;
}

}  // namespace weft::app::lsp
