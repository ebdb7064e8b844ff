#include "engine/convert/mpv/rpn.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/base/chars.h"
#include "engine/convert/text/json_text.h"

namespace weft::convert {

namespace {

constexpr std::size_t kMostWords = 32;  // as in mpv

struct Word {
  std::string_view text;
  std::size_t at = 0;
};

std::vector<Word> wordsOf(std::string_view text) {
  std::vector<Word> words;
  for (std::size_t i = 0; i < text.size();) {
    if (base::isSpace(text[i])) {
      ++i;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" \t", i), text.size());
    words.push_back({text.substr(i, end - i), i});
    i = end;
  }
  return words;
}

}  // namespace

std::optional<std::string> convertRpn(const MpvText& expression, const RpnNames& names,
                                      base::Diagnostics& diagnostics) {
  const auto fail = [&](std::size_t at, std::string message) {
    base::Place place = expression.place;
    place.column += static_cast<std::uint32_t>(at);
    auto& d = diagnostics.error(base::Code::badMpvHeader, place, std::move(message));
    d.expected = "reverse Polish: numbers, NAME.w, NAME.h, + - * / % > < = !";
    d.found = expression.text.substr(0, 80);
    d.hint = "HOOKED.w 2 * is twice the width of what is hooked";
    return std::nullopt;
  };
  const std::vector<Word> words = wordsOf(expression.text);
  if (words.size() > kMostWords)
    return fail(words[kMostWords].at, fmt::format("more than {} words", kMostWords));
  std::vector<std::string> stack;
  for (const auto& [word, at] : words) {
    const std::size_t point = word.rfind('.');
    const std::string_view end = point == word.npos || base::isDigit(word[0]) ? "" : word.substr(point + 1);
    if (end == "w" || end == "width" || end == "h" || end == "height") {
      const std::string side = names.sideOf(word.substr(0, point), end[0] == 'w');
      if (side.empty()) return fail(at, fmt::format("there is no texture '{}' here", word.substr(0, point)));
      stack.push_back(side);
    } else if (base::isDigit(word[0])) {
      const std::size_t points = static_cast<std::size_t>(std::ranges::count(word, '.'));
      const bool number = points <= 1 && word.size() <= 20 && word.back() != '.' &&
                          word.find_first_not_of("0123456789.") == word.npos;
      if (!number) return fail(at, fmt::format("'{}' is no number", word));
      stack.emplace_back(word);
    } else if (word == "!") {
      if (stack.empty()) return fail(at, "'!' has nothing before it");
      stack.back() = fmt::format("({} == 0)", stack.back());
    } else if (word.size() == 1 && std::string_view("+-*/%><=").find(word[0]) != std::string_view::npos) {
      if (stack.size() < 2) return fail(at, fmt::format("'{}' needs two values before it", word));
      const std::string right = std::move(stack.back());
      stack.pop_back();
      stack.back() = fmt::format("({} {} {})", stack.back(), word == "=" ? "==" : word, right);
    } else if (const std::string parameter = names.parameterOf(word); !parameter.empty()) {
      stack.push_back(parameter);
    } else {
      return fail(at, fmt::format("'{}' is no word of such an expression", word));
    }
  }
  if (stack.size() != 1) return fail(0, stack.empty() ? "the expression is empty" : "values are left over");
  return stack.back();
}

}  // namespace weft::convert
