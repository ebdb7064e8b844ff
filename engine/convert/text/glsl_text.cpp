#include "engine/convert/text/glsl_text.h"

#include <algorithm>

#include "engine/base/chars.h"

namespace weft::convert {

using glsl::TokenKind;

GlslText::GlslText(std::string_view text) : text_(text), tokens_(glsl::splitTokens(text)) {
  directives_.resize(tokens_.size());
  int depth = 0;
  std::string_view directive;
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    const glsl::Token& token = tokens_[i];
    if (token.first) {
      directive = {};
      if (token.is("#")) {
        const bool named = i + 1 < tokens_.size() && !tokens_[i + 1].first;
        directive = named ? tokens_[i + 1].text : token.text;
      }
    }
    directives_[i] = directive;
    if (!directive.empty()) {
      const bool defined = directive == "define" && i > 0 && tokens_[i - 1].is("define");
      if (defined) outside_.insert(token.text);
      continue;
    }
    if (token.is("{") || token.is("(")) ++depth;
    if (token.is("}") || token.is(")")) depth = std::max(0, depth - 1);
    if (depth == 0 && token.kind == TokenKind::word) outside_.insert(token.text);
  }
}

bool GlslText::isName(std::size_t token) const {
  return tokens_[token].kind == TokenKind::word && (token == 0 || !tokens_[token - 1].is("."));
}

bool GlslText::mentions(std::string_view name) const {
  for (std::size_t i = 0; i < tokens_.size(); ++i)
    if (tokens_[i].is(name) && isName(i)) return true;
  return false;
}

void GlslText::replaceRange(std::size_t begin, std::size_t end, std::string replacement) {
  // What stood on several lines still does.
  const auto lines = std::ranges::count(text_.substr(begin, end - begin), '\n');
  const auto kept = std::ranges::count(replacement, '\n');
  for (auto i = kept; i < lines; ++i) replacement += '\n';
  changes_.push_back({begin, end, std::move(replacement)});
}

void GlslText::rename(std::string_view from, std::string_view to) {
  for (std::size_t i = 0; i < tokens_.size(); ++i)
    if (tokens_[i].is(from) && isName(i)) replace(i, std::string(to));
}

void GlslText::blankDirective(std::size_t token) {
  while (token > 0 && !tokens_[token].first) --token;
  std::size_t last = token;
  while (last + 1 < tokens_.size() && !tokens_[last + 1].first) ++last;
  replaceRange(offsetOf(token), offsetOf(last) + tokens_[last].text.size(), "");
}

std::string GlslText::changed() const {
  std::vector<Change> sorted = changes_;
  std::ranges::stable_sort(sorted, {}, &Change::begin);
  std::string out;
  std::size_t at = 0;
  for (const Change& change : sorted) {
    if (change.begin < at) continue;
    out.append(text_.substr(at, change.begin - at)).append(change.replacement);
    at = change.end;
  }
  return out.append(text_.substr(at));
}

std::string identifierOf(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (base::isIdentChar(c))
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty() || base::isDigit(out[0])) return 'n' + out;
  return out;
}

std::string presenceDefineOf(std::string_view slot) {
  std::string text = "HAS_" + std::string(slot);
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  return text;
}

}  // namespace weft::convert
