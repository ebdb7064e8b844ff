#include "engine/gl/messages/conditionals.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "engine/base/chars.h"

namespace weft::gl {

namespace {

using OpenOnes = std::vector<Conditional>;  // the innermost last

std::string_view trimmedEnds(std::string_view text) {
  while (!text.empty() && base::isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && base::isSpace(text.back())) text.remove_suffix(1);
  return text;
}

void follow(std::string_view line, std::uint32_t number, OpenOnes& open) {
  if (!line.starts_with('#')) return;
  const std::string_view word = trimmedEnds(line.substr(1));
  if (word.starts_with("if"))
    open.push_back({number, std::string(line)});
  else if (word.starts_with("elif") && !open.empty())
    open.back().text = line;
  else if (word.starts_with("else") && !open.empty() && !open.back().text.starts_with("#else of "))
    open.back().text = fmt::format("#else of {}", open.back().text);
  else if (word.starts_with("endif") && !open.empty())
    open.pop_back();
}

// Calls `see` with each line, without blanks at its ends, and what is open there; stops when that returns true. What is open at the end.
OpenOnes forEachLine(std::string_view text,
                     const std::function<bool(std::string_view, const OpenOnes&)>& see) {
  OpenOnes open;
  for (std::uint32_t number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    follow(trimmedEnds(line), number, open);
    if (see(trimmedEnds(line), open)) break;
  }
  return open;
}

}  // namespace

bool mentionsWord(std::string_view line, std::string_view word) {
  for (std::size_t at = line.find(word); at != std::string_view::npos; at = line.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !base::isIdentChar(line[at - 1])) &&
        (end == line.size() || !base::isIdentChar(line[end])))
      return true;
  }
  return false;
}

std::string conditionalAround(std::string_view name, std::string_view text) {
  std::string found;
  forEachLine(text, [&](std::string_view line, const OpenOnes& open) {
    const bool declares =
        std::ranges::any_of(std::initializer_list<std::string_view>{"uniform", "in", "out", "buffer"},
                            [&](std::string_view word) { return mentionsWord(line, word); });
    if (!declares || open.empty() || !mentionsWord(line, name)) return false;
    found = open.back().text;
    return true;
  });
  return found;
}

std::optional<Conditional> unterminatedConditional(std::string_view text) {
  const OpenOnes open = forEachLine(text, [](std::string_view, const OpenOnes&) { return false; });
  return open.empty() ? std::nullopt : std::optional(open.back());
}

}  // namespace weft::gl
