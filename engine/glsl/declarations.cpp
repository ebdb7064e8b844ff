#include "engine/glsl/declarations.h"

#include <algorithm>
#include <array>

namespace weft::glsl {

namespace {

constexpr std::uint64_t kMostElements = std::uint64_t{1} << 40;
constexpr std::uint32_t kDeepest = 64;  // brackets in the size of an array

// Stand before a type.
constexpr std::array<std::string_view, 24> kQualifiers{
    "const",   "in",    "out",      "inout",     "uniform",  "buffer",   "shared",        "highp",
    "mediump", "lowp",  "precise",  "invariant", "flat",     "smooth",   "noperspective", "centroid",
    "sample",  "patch", "coherent", "volatile",  "restrict", "readonly", "writeonly",     "varying"};
// Begin statements that declare nothing.
constexpr std::array<std::string_view, 7> kStatements{"return",   "case",    "default",  "break",
                                                      "continue", "discard", "precision"};

// Or kMostElements.
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > kMostElements / b ? kMostElements : a * b;
}

template <class List>
bool contains(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// Past the bracket that closes the one at `at`.
std::size_t skipBrackets(std::span<const Token> tokens, std::size_t at) {
  int open = 0;
  for (; at < tokens.size(); ++at) {
    const Token& token = tokens[at];
    if (token.is("(") || token.is("[") || token.is("{")) ++open;
    if ((token.is(")") || token.is("]") || token.is("}")) && --open <= 0) return at + 1;
  }
  return at;
}

// Past the initializer at `at`: the next ',' outside brackets, or the end.
std::size_t skipInitializer(std::span<const Token> tokens, std::size_t at) {
  while (at < tokens.size() && !tokens[at].is(",")) {
    const bool opens = tokens[at].is("(") || tokens[at].is("[") || tokens[at].is("{");
    at = opens ? skipBrackets(tokens, at) : at + 1;
  }
  return at;
}

}  // namespace

void DeclarationCount::openBody(std::span<const Token> before) {
  body_ = Body::block;
  struct_ = {};
  for (std::size_t i = 0; i + 1 < before.size(); ++i)
    if (before[i].is("struct")) {
      body_ = Body::members;
      struct_ = before[i + 1].text;
      structs_[struct_] = 0;
    }
}

void DeclarationCount::closeBody() {
  if (body_ == Body::block) struct_ = {};
  body_ = Body::none;
}

std::optional<std::int64_t> DeclarationCount::valueOf(std::span<const Token> tokens) const {
  const auto known = [&](std::string_view name) -> std::optional<std::int64_t> {
    const auto found = constants_.find(name);
    return found == constants_.end() ? std::nullopt : std::optional(found->second);
  };
  return evaluateTokens(tokens, known, kDeepest);
}

std::optional<std::uint64_t> DeclarationCount::dimensions(std::span<const Token> tokens,
                                                          std::size_t& at) const {
  std::optional<std::uint64_t> product = 1;
  while (at < tokens.size() && tokens[at].is("[")) {
    const std::size_t end = skipBrackets(tokens, at);
    const auto inside = tokens.subspan(at + 1, end - at >= 2 ? end - at - 2 : 0);
    at = end;
    if (inside.empty()) continue;  // as many as its initializer has, which is counted there
    const auto count = valueOf(inside);
    product =
        count && product
            ? std::optional(times(*product, static_cast<std::uint64_t>(std::max<std::int64_t>(*count, 0))))
            : std::nullopt;
  }
  return product;
}

void DeclarationCount::note(std::uint64_t elements, const Token& at, std::string_view name) {
  if (elements > 1) size_.allElements = std::min(kMostElements, size_.allElements + elements);
  if (elements <= size_.array.count) return;
  size_.array = {.count = elements, .line = at.line, .column = at.column, .name = std::string(name)};
}

void DeclarationCount::take(std::uint64_t elements, const Token& name) {
  if (body_ == Body::members)
    structs_[struct_] = std::min(kMostElements, structs_[struct_] + elements);
  else if (body_ == Body::none)
    note(elements, name, name.text);
}

void DeclarationCount::add(std::span<const Token> statement) {
  std::size_t at = 0;
  bool constant = false, interface = false;
  while (at < statement.size()) {
    const std::string_view word = statement[at].text;
    if (word == "layout") {
      at = skipBrackets(statement, at + 1);
    } else if (contains(kQualifiers, word)) {
      constant |= word == "const";
      interface |= word == "in" || word == "out" || word == "inout" || word == "buffer" || word == "shared";
      ++at;
    } else {
      break;
    }
  }
  if (at >= statement.size() || statement[at].kind != TokenKind::word ||
      contains(kStatements, statement[at].text))
    return;
  const Token& type = statement[at++];
  const auto known = structs_.find(type.text);
  const std::uint64_t each = known == structs_.end() ? 1 : known->second;
  const bool whole = type.is("int") || type.is("uint");
  const auto typeDimensions = dimensions(statement, at);
  while (at < statement.size() && statement[at].kind == TokenKind::word) {
    const Token& name = statement[at++];
    const auto own = dimensions(statement, at);
    const bool ends = at == statement.size() || statement[at].is(",") || statement[at].is("=");
    if (!ends) return;  // a call, an assignment
    // What a group shares, devices bound by themselves.
    if (own && typeDimensions && !interface)
      take(times(times(*own, *typeDimensions), each), name);
    else
      size_.uncertain |= body_ != Body::block && !interface && (!own || !typeDimensions);
    if (at < statement.size() && statement[at].is("=")) {
      const std::size_t end = skipInitializer(statement, at + 1);
      if (constant && whole)
        if (const auto number = valueOf(statement.subspan(at + 1, end - at - 1)))
          constants_[name.text] = *number;
      at = end;
    }
    if (at < statement.size()) ++at;  // the comma
  }
}

}  // namespace weft::glsl
