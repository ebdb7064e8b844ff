#include "app/import/text.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/chars.h"
#include "engine/base/json/edit.h"
#include "engine/base/json/layout.h"
#include "engine/base/nearest.h"

namespace weft::convert {

void refuse(base::Diagnostics& diagnostics, base::Code code, const base::Place& place, std::string message,
            std::string hint) {
  base::Diagnostic& d = diagnostics.error(code, place, std::move(message));
  d.hint = std::move(hint);
}

bool checkImageNames(const ConvertOptions& options, std::span<const std::string> known,
                     base::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errorCount();
  for (const auto& [name, file] : options.images) {
    if (std::ranges::find(known, name) != known.end()) continue;
    auto& d = diagnostics.error(base::Code::unknownParameter,
                                base::placeOfOption(fmt::format("--image {}=…", name)),
                                fmt::format("the file has no image '{}'", name));
    d.expected = known.empty() ? "no --image: the file reads none" : "the name of an image of the file";
    d.hint = base::nearestHint(name, known);
  }
  return diagnostics.errorCount() == errors;
}

std::vector<Token> splitTokens(std::string_view text) {
  std::vector<Token> tokens;
  std::uint32_t line = 1;
  std::size_t lineStart = 0, i = 0;
  bool first = true;
  // A line that ends in a backslash goes on in the next one.
  const auto endLine = [&] {
    const bool continued =
        i > 0 && (text[i - 1] == '\\' || (text[i - 1] == '\r' && i > 1 && text[i - 2] == '\\'));
    ++line;
    lineStart = ++i;
    first = first || !continued;
    return !continued;
  };
  while (i < text.size()) {
    if (text[i] == '\n') {
      endLine();
    } else if (base::isSpace(text[i]) || text[i] == '\v' || text[i] == '\f' || text[i] == '\\') {
      ++i;
    } else if (text.substr(i, 2) == "//") {
      for (bool ended = false; i < text.size() && !ended;)
        if (text[i] == '\n')
          ended = endLine();
        else
          ++i;
    } else if (text.substr(i, 2) == "/*") {
      const std::size_t end = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
      while (i < end)
        if (text[i] == '\n')
          endLine();
        else
          ++i;
    } else {
      const std::size_t begin = i++;
      const bool word = base::isIdentStart(text[begin]);
      const bool number =
          base::isDigit(text[begin]) || (text[begin] == '.' && i < text.size() && base::isDigit(text[i]));
      while ((word || number) && i < text.size() &&
             (base::isIdentChar(text[i]) ||
              (number && (text[i] == '.' || ((text[i] == '+' || text[i] == '-') &&
                                             (text[i - 1] == 'e' || text[i - 1] == 'E'))))))
        ++i;
      tokens.push_back({.text = text.substr(begin, i - begin),
                        .line = line,
                        .column = static_cast<std::uint32_t>(begin - lineStart + 1),
                        .word = word,
                        .first = std::exchange(first, false)});
    }
  }
  return tokens;
}

GlslText::GlslText(std::string_view text) : text_(text), tokens_(splitTokens(text)) {
  int depth = 0;
  std::string_view directive;
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    const Token& token = tokens_[i];
    if (token.first) directive = {};
    if (token.first && token.is("#"))
      directive = i + 1 < tokens_.size() && !tokens_[i + 1].first ? tokens_[i + 1].text : token.text;
    directives_.push_back(directive);
    if (!directive.empty()) {
      if (directive == "define" && tokens_[i - (i > 0)].is("define")) outside_.insert(token.text);
      continue;
    }
    if (token.is("{") || token.is("(")) ++depth;
    if (token.is("}") || token.is(")")) depth = std::max(0, depth - 1);
    if (depth == 0 && token.word) outside_.insert(token.text);
  }
}

bool GlslText::isName(std::size_t token) const {
  return tokens_[token].word && (token == 0 || !tokens_[token - 1].is("."));
}

void GlslText::replaceRange(std::size_t first, std::size_t last, std::string replacement) {
  const std::size_t begin = offsetOf(first), end = offsetOf(last) + tokens_[last].text.size();
  // What was on several lines still is.
  const auto lines = std::ranges::count(text_.substr(begin, end - begin), '\n');
  for (auto i = std::ranges::count(replacement, '\n'); i < lines; ++i) replacement += '\n';
  changes_.push_back({begin, end, std::move(replacement)});
}

void GlslText::rename(std::string_view from, std::string_view to) {
  for (std::size_t i = 0; i < tokens_.size(); ++i)
    if (tokens_[i].is(from) && isName(i)) replace(i, std::string(to));
}

void GlslText::renameTaken(std::span<const std::string_view> taken) {
  for (const std::string_view name : taken)
    if (outside_.contains(name)) rename(name, std::string(name) + "_");
}

void GlslText::blankVersions() {
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    const std::string_view name = directives_[i];
    if (!tokens_[i].first || (name != "version" && name != "extension" && name != "line")) continue;
    std::size_t last = i;
    while (last + 1 < tokens_.size() && !tokens_[last + 1].first) ++last;
    replaceRange(i, last, "");
  }
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
  return out.empty() || base::isDigit(out[0]) ? 'n' + out : out;
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

std::string presenceDefineOf(std::string_view slot) {
  std::string text = "HAS_" + std::string(slot);
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  return text;
}

JsonObjectText& JsonObjectText::add(std::string_view key, const std::string& json) {
  if (!json.empty()) members_ += (members_.empty() ? "" : ", ") + base::quoteJson(key) + ": " + json;
  return *this;
}

JsonObjectText& JsonObjectText::addText(std::string_view key, std::string_view text) {
  return add(key, base::quoteJson(text));
}

std::string numberText(double number, bool real) {
  std::string text = fmt::format("{}", number);
  return real && text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string graphText(const JsonObjectText& members) {
  return base::layoutJson(members.text() + "\n", {.packed = {"set"}, .starts = {"read", "write", "modify"}});
}

}  // namespace weft::convert
