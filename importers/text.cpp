#include "importers/text.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/text/chars.h"
#include "engine/text/json/edit.h"
#include "engine/text/nearest.h"

namespace weft::importing {

void refuse(text::Diagnostics& diagnostics, text::Code code, const text::Place& place, std::string message,
            std::string hint) {
  diagnostics.add({.code = code, .message = std::move(message), .place = place, .hint = std::move(hint)});
}

bool checkImageNames(const ConvertOptions& options, std::span<const std::string> known,
                     text::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errorCount();
  for (const auto& [name, file] : options.images)
    if (!contains(known, name))
      diagnostics.add({.code = text::Code::unknownParameter,
                       .message = fmt::format("the file has no image '{}'", name),
                       .place = text::placeOfOption(fmt::format("--image {}=…", name)),
                       .hint = known.empty() ? "leave --image out" : text::nearestHint(name, known)});
  return diagnostics.errorCount() == errors;
}

GlslText::GlslText(std::string_view text) : text_(text), tokens_(glsl::splitTokens(text)) {
  int depth = 0;
  std::string_view directive;
  std::size_t first = 0;  // of the directive
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    const glsl::Token& token = tokens_[i];
    if (token.first) directive = {};
    if (token.first && token.is("#")) {
      directive = i + 1 < tokens_.size() && !tokens_[i + 1].first ? tokens_[i + 1].text : token.text;
      first = i;
    }
    if (!directive.empty()) {
      if (directive == "define" && tokens_[i - (i > 0)].is("define")) outside_.insert(token.text);
      const bool last = i + 1 == tokens_.size() || tokens_[i + 1].first;
      if (last && (directive == "version" || directive == "extension" || directive == "line"))
        replace(first, i, "");
      continue;
    }
    if (token.is("{") || token.is("(")) ++depth;
    if (token.is("}") || token.is(")")) depth = std::max(0, depth - 1);
    if (depth == 0 && token.kind == glsl::TokenKind::word) outside_.insert(token.text);
  }
}

bool GlslText::isName(std::size_t token) const {
  return tokens_[token].kind == glsl::TokenKind::word && (token == 0 || !tokens_[token - 1].is("."));
}

void GlslText::replace(std::size_t first, std::size_t last, std::string replacement) {
  // What was on several lines still is.
  const std::string_view old(tokens_[first].text.begin(), tokens_[last].text.end());
  replacement.append(static_cast<std::size_t>(std::max<std::ptrdiff_t>(
                         0, std::ranges::count(old, '\n') - std::ranges::count(replacement, '\n'))),
                     '\n');
  replaced_.emplace(first, std::pair(last, std::move(replacement)));
}

void GlslText::rename(std::string_view from, const std::string& to) {
  for (std::size_t i = 0; i < tokens_.size(); ++i)
    if (tokens_[i].is(from) && isName(i)) replace(i, i, to);
}

void GlslText::renameTaken(std::initializer_list<std::string_view> taken) {
  for (const std::string_view name : taken)
    if (outside_.contains(name)) rename(name, std::string(name) + "_");
}

std::string GlslText::changed() const {
  std::string out;
  const char* at = text_.data();
  for (const auto& [first, change] : replaced_) {
    const char* const begin = tokens_[first].text.data();
    if (begin < at) continue;
    out.append(at, begin).append(change.second);
    at = tokens_[change.first].text.data() + tokens_[change.first].text.size();
  }
  return out.append(at, text_.data() + text_.size());
}

std::string identifierOf(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (text::isIdentChar(c))
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() || text::isDigit(out[0]) ? 'n' + out : out;
}

std::string freshName(std::set<std::string, std::less<>>& used, const std::string& wanted) {
  std::string name = wanted;
  for (int i = 2; !used.insert(name).second; ++i)
    name = fmt::format("{}{}{}", wanted, wanted.ends_with('_') ? "" : "_", i);
  return name;
}

std::string fillTemplate(std::string text,
                         std::initializer_list<std::pair<std::string_view, std::string_view>> words) {
  for (const auto& [word, value] : words)
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + value.size()))
      text.replace(at, word.size(), value);
  return text;
}

std::string parameterBlockOf(const std::string& members) {
  return members.empty() ? "" : "layout(std140) uniform Parameters {\n" + members + "};\n";
}

Json numberOf(double number, bool real) {
  if (real || number != std::floor(number) || std::abs(number) > 1e15) return number;
  return static_cast<std::int64_t>(number);
}

std::string graphText(const Json& graph) {
  return text::layoutJson(text::dumpJson(graph, -1, false) + "\n");
}

}  // namespace weft::importing
