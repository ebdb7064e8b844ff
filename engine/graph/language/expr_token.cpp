#include "engine/graph/language/expr_token.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "engine/base/words/foreign_words.h"
#include "engine/graph/language/names.h"

namespace weft::graph {

namespace {

std::size_t endOfNumber(std::string_view text, std::size_t at) {
  const auto digits = [&](std::size_t i) {
    while (i < text.size() && isDigit(text[i])) ++i;
    return i;
  };
  at = digits(at);
  if (at + 1 < text.size() && text[at] == '.' && isDigit(text[at + 1])) at = digits(at + 1);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && isDigit(text[exponent])) at = digits(exponent);
  }
  return at;
}

}  // namespace

Token scanToken(std::string_view text, std::size_t from) {
  while (from < text.size() && isSpace(text[from])) ++from;
  Token token;
  token.begin = from;
  if (from >= text.size()) return token;
  const char c = text[from];
  std::size_t end = from + 1;
  if (isDigit(c)) {
    end = endOfNumber(text, from);
    token.kind = Token::Kind::number;
    const auto result = std::from_chars(text.data() + from, text.data() + end, token.number);
    if (result.ec != std::errc() || !std::isfinite(token.number)) token.kind = Token::Kind::bad;
  } else if (isIdentStart(c)) {
    while (end < text.size() && isIdentChar(text[end])) ++end;
    token.kind = Token::Kind::identifier;
  } else {
    token.kind = Token::Kind::punctuation;
    const std::string_view two = text.substr(from, 2);
    if (two == "||" || two == "&&" || two == "==" || two == "!=" || two == "<=" || two == ">=") ++end;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) ++end;
  }
  token.text = text.substr(from, end - from);
  return token;
}

namespace {

// "#ff8000" and "#f80" to "[1, 0.502, 0]": the numbers of the picture file, not linear light. "" for anything else.
std::string hintForColor(std::string_view text) {
  const std::size_t digits = text.empty() || text[0] != '#' ? 0 : text.size() - 1;
  if (digits != 3 && digits != 6 && digits != 8) return {};
  std::string list;
  const std::size_t each = digits == 3 ? 1 : 2;
  for (std::size_t at = 1; at < text.size(); at += each) {
    unsigned value = 0;
    const char* const end = text.data() + at + each;
    const auto [stop, error] = std::from_chars(text.data() + at, end, value, 16);
    if (error != std::errc() || stop != end) return {};
    list += fmt::format("{}{:.3g}", list.empty() ? "" : ", ", value / (each == 1 ? 15.0 : 255.0));
  }
  return fmt::format("a color is a list of numbers, which Weft takes as they are: [{}]", list);
}

// "1920,1080" to "[1920, 1080]".
std::string hintForPair(std::string_view text) {
  double first = 0, second = 0;
  const char* const end = text.data() + text.size();
  const auto comma = std::from_chars(text.data(), end, first);
  if (comma.ec != std::errc() || comma.ptr == end || *comma.ptr != ',') return {};
  const auto last = std::from_chars(comma.ptr + 1, end, second);
  return last.ec == std::errc() && last.ptr == end ? fmt::format("write [{}, {}]", first, second) : "";
}

// "uint[256]" and "256uints" to "256*4": how many bytes that is.
std::string hintForElements(std::string_view text) {
  double count = 0;
  std::string_view type = text;
  if (const std::size_t open = text.find('['); open != std::string_view::npos && text.ends_with(']')) {
    const char* const end = text.data() + text.size() - 1;
    const auto number = std::from_chars(text.data() + open + 1, end, count);
    if (number.ec != std::errc() || number.ptr != end) return {};
    type = text.substr(0, open);
  } else {
    const auto number = std::from_chars(text.data(), text.data() + text.size(), count);
    if (number.ec != std::errc()) return {};
    type.remove_prefix(static_cast<std::size_t>(number.ptr - text.data()));
  }
  if (type.ends_with('s')) type.remove_suffix(1);
  for (const auto& [name, bytes] : {std::pair{"uint", 4}, std::pair{"int", 4}, std::pair{"float", 4},
                                    std::pair{"uvec2", 8}, std::pair{"vec2", 8}, std::pair{"uvec4", 16},
                                    std::pair{"vec4", 16}, std::pair{"uint32", 4}, std::pair{"float32", 4}})
    if (type == name) return fmt::format("sizes of buffers are bytes: write {}*{}", count, bytes);
  return {};
}

}  // namespace

std::string hintForSize(std::string_view whole) {
  if (std::string color = hintForColor(whole); !color.empty()) return color;
  std::string packed(whole);
  std::erase_if(packed, isSpace);
  const std::string_view text = packed;
  if (text == "width,height") return "write 'screen'";
  if (std::string list = hintForPair(text); !list.empty()) return list;
  if (std::string bytes = hintForElements(text); !bytes.empty()) return bytes;
  // "screen*50%", "width/2,height/2", "screen.width"
  if (text.starts_with("screen*") && text.ends_with('%')) {
    double part = 0;
    const auto [at, error] = std::from_chars(text.data() + 7, text.data() + text.size(), part);
    if (error == std::errc() && at + 1 == text.data() + text.size())
      return fmt::format("write 'screen*{}'", part / 100);
  }
  if (text.starts_with("width/")) {
    const std::string_view by = text.substr(6, text.find(',') - std::min<std::size_t>(6, text.size()));
    double part = 0;
    const bool divides =
        std::from_chars(by.data(), by.data() + by.size(), part).ptr == by.data() + by.size() && part > 0;
    if (divides && text == fmt::format("width/{},height/{}", by, by))
      return fmt::format("write 'screen/{}'", by);
  }
  for (const auto& [theirs, ours] : {std::pair{".width", ".x"}, std::pair{".height", ".y"}})
    if (const std::size_t at = text.find(theirs); at != std::string_view::npos)
      return fmt::format("a size has .x and .y: write '{}{}'", text.substr(0, at), ours);
  if (text.ends_with("px") && text.find(',') == std::string_view::npos && !isDigit(text[0]))
    return fmt::format("texels have no unit: write '{}'", text.substr(0, text.size() - 2));
  double first = 0, second = 0;
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const auto number = std::from_chars(begin, end, first);
  if (number.ec != std::errc() || number.ptr == end) return {};
  const std::string_view rest(number.ptr, static_cast<std::size_t>(end - number.ptr));
  if (rest == "%")
    return fmt::format("write '{}' of what it is a part of: 'screen*{}'", first / 100, first / 100);
  if (rest == "px") return fmt::format("texels have no unit: write {}", first);
  if (rest == "x") return fmt::format("write 'screen*{}'", first);
  for (const std::string_view unit : {"f", "F", "deg", "rad", "s", "ms", "B", "bytes", "texels", "pixels"})
    if (rest == unit) return fmt::format("numbers have no unit and no ending: write {}", first);
  for (const auto& [unit, bytes] :
       {std::pair{"KB", 1024}, std::pair{"KiB", 1024}, std::pair{"MB", 1 << 20}, std::pair{"MiB", 1 << 20}})
    if (rest == unit) return fmt::format("sizes of buffers are bytes: write {}*{}", first, bytes);
  if (rest[0] != 'x' && rest[0] != 'X') return {};
  const auto other = std::from_chars(number.ptr + 1, end, second);
  return other.ec == std::errc() && other.ptr == end ? fmt::format("write [{}, {}]", first, second) : "";
}

std::string hintForMember(std::string_view name, std::string_view member) {
  struct Theirs {
    const char *member, *before, *after;
  };
  constexpr Theirs kTheirs[] = {
      {"size", "size(", ")"},   {"width", "size(", ").x"}, {"height", "size(", ").y"}, {"mips", "mips(", ")"},
      {"levels", "mips(", ")"}, {"count", "count(", ")"},  {"length", "count(", ")"}};
  for (const Theirs& theirs : kTheirs)
    if (member == theirs.member) return fmt::format("write '{}{}{}'", theirs.before, name, theirs.after);
  if (isReservedWord(member)) return hintForPart(name);
  return base::hintForForeign(base::Foreign::value, fmt::format("{}.{}", name, member));
}

std::string hintForPart(std::string_view name) {
  return fmt::format(
      "values know the whole: size({0}) is that of level 0, count({0}) and mips({0}) say how many; "
      "\"threads\" left "
      "out is the size of the level that the pass writes, and a shader asks textureSize() or imageSize()",
      name);
}

}  // namespace weft::graph
