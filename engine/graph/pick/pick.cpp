#include "engine/graph/pick/pick.h"

#include <charconv>

#include "engine/graph/language/names.h"

namespace weft::graph {

namespace {

// Takes a whole number off the front.
bool takeWhole(std::string_view& text, std::uint32_t& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc{} || end == text.data()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool takeWord(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

// "mip[3]" and the like.
bool takeSelector(std::string_view& text, std::string_view word, std::uint32_t& out) {
  return takeWord(text, word) && takeWord(text, "[") && takeWhole(text, out) && takeWord(text, "]");
}

// A dotted name, which ends before a selector; with the [k] of an array.
std::string takeName(std::string_view& text) {
  std::string name(takeWord(text, "@") ? "@" : "");
  for (bool first = true;; first = false) {
    const std::string_view rest = first ? text : text.substr(text.starts_with('.') ? 1 : 0);
    if (!first && rest.size() == text.size()) break;
    std::size_t length = 0;
    while (length < rest.size() && isIdentChar(rest[length])) ++length;
    const std::string_view word = rest.substr(0, length);
    if (!isIdent(word)) return first ? std::string{} : name;
    if (!first && isReservedWord(word)) break;
    name += (first ? "" : ".") + std::string(word);
    text = rest.substr(length);
  }
  if (std::string_view rest = text; takeWord(rest, "[")) {
    std::uint32_t element = 0;
    if (!takeWhole(rest, element) || !takeWord(rest, "]")) return {};
    name += "[" + std::to_string(element) + "]";
    text = rest;
  }
  return name;
}

}  // namespace

std::optional<Pick> parsePick(std::string_view text) {
  Pick pick{.text = std::string(text), .name = {}, .pass = {}};
  std::string_view rest = text;
  pick.name = takeName(rest);
  if (pick.name.empty()) return std::nullopt;
  if (takeWord(rest, "#") && (!takeWhole(rest, pick.version) || pick.version == 0)) return std::nullopt;
  std::uint32_t face = 0, cube = 0;
  bool ofCube = false;
  while (takeWord(rest, ".")) {
    if (rest.starts_with("mip")) {
      if (!takeSelector(rest, "mip", pick.mip)) return std::nullopt;
    } else if (rest.starts_with("layer")) {
      if (!takeSelector(rest, "layer", cube)) return std::nullopt;
    } else if (rest.starts_with("face")) {
      if (!takeSelector(rest, "face", face) || face > 5) return std::nullopt;
      ofCube = true;
    } else if (takeWord(rest, "stencil")) {
      pick.stencil = true;
    } else {
      return std::nullopt;
    }
  }
  if (cube > 0xffff) return std::nullopt;
  pick.layer = ofCube ? cube * 6 + face : cube;
  if (takeWord(rest, "@-") && (!takeWhole(rest, pick.history) || pick.history == 0)) return std::nullopt;
  if (takeWord(rest, " after ")) {
    pick.pass = rest;
    rest = {};
    if (pick.pass.empty()) return std::nullopt;
  }
  return rest.empty() ? std::optional(std::move(pick)) : std::nullopt;
}

bool matchesPattern(std::string_view pattern, std::string_view text) {
  // The last * and how much of the text it has taken: when the rest does not match, it takes one letter more.
  std::size_t p = 0, t = 0, star = std::string_view::npos, taken = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++taken;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace weft::graph
