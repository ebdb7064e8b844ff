#include "engine/graph/read/ref_parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "engine/base/nearest.h"
#include "engine/graph/language/names.h"
#include "engine/graph/read/ref_words.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

namespace {

using base::Code;

Place shifted(Place place, std::size_t columns) {
  if (place.column > 0) place.column += static_cast<std::uint32_t>(columns);
  return place;
}

// The offset of the bracket that closes the one at `open`, or npos. Kinds of brackets are not told apart: a
// mixed pair is left for the expression parser to object to.
std::size_t closingBracket(std::string_view text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '[' || text[i] == '(') ++depth;
    if (text[i] == ']' || text[i] == ')')
      if (--depth == 0) return i;
  }
  return std::string_view::npos;
}

bool isBlank(std::string_view text) {
  return std::all_of(text.begin(), text.end(), isSpace);
}

class RefParser {
 public:
  RefParser(std::string_view text, const Place& place, base::Diagnostics& diagnostics)
      : whole_(text), text_(text), place_(place), diagnostics_(diagnostics) {
    ref_.text = text;
    ref_.place = place;
  }

  std::optional<RefDesc> run() {
    while (!text_.empty() && isSpace(text_.back())) text_.remove_suffix(1);
    if (!text_.empty() && text_.back() == '?') {
      ref_.optional = true;
      text_.remove_suffix(1);
      while (!text_.empty() && isSpace(text_.back())) text_.remove_suffix(1);
    }
    skipSpace();
    ref_.place = shifted(place_, at_);
    if (text_.empty())
      return fail(0, "the reference is empty", "name a resource, such as \"hdr\" or \"@environment\""),
             std::nullopt;
    if (parseName() && parseSelectors() && parseHistory() && parseWords() && parseCondition())
      return std::move(ref_);
    return std::nullopt;
  }

 private:
  bool fail(std::size_t offset, std::string message, std::string hint = {}) {
    auto& d = diagnostics_.error(Code::badReference, shifted(place_, offset), std::move(message));
    d.found = fmt::format("\"{}\"", whole_);
    d.hint = std::move(hint);
    return false;
  }

  void skipSpace() {
    while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
  }
  bool ended() const { return at_ >= text_.size(); }
  char here() const { return ended() ? '\0' : text_[at_]; }

  std::string_view peekWord(std::size_t from) const {
    std::size_t end = from;
    if (end < text_.size() && isIdentStart(text_[end]))
      while (end < text_.size() && isIdentChar(text_[end])) ++end;
    return text_.substr(from, end - from);
  }

  // A whole character at `from`, for messages.
  std::string_view character(std::size_t from) const {
    std::size_t end = from + 1;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
    return text_.substr(from, end - from);
  }

  bool parseName() {
    if (here() == '@') {
      ref_.import = true;
      ++at_;
    }
    while (true) {
      const std::string_view word = peekWord(at_);
      if (word.empty())
        return fail(at_,
                    ended() ? "the reference ends where a name is expected"
                            : fmt::format("'{}' where a name is expected", character(at_)),
                    hintForName());
      if (isReservedWord(word))
        return fail(at_, fmt::format("'{}' may not stand in a name", word),
                    "it selects a sub-resource, as in \"glow.mip[0]\"");
      ref_.name += word;
      at_ += word.size();
      if (here() != '.' || isReservedWord(peekWord(at_ + 1))) return true;
      ref_.name += '.';
      ++at_;
    }
  }

  // What belongs in the place of a character that begins no name.
  std::string hintForName() const {
    if (here() == '?' && !ref_.optional) return "'?' stands at the very end";
    if (here() == '$' && whole_.find('?') != std::string_view::npos &&
        whole_.find(':') != std::string_view::npos)
      return "a choice between resources is a list in \"resources\": [\"a if $x\", \"b\"]";
    if (const std::string_view name = here() == '$' ? peekWord(at_ + 1) : ""; !name.empty())
      return fmt::format("resources have no '$': write '{}'", name);
    return "names are letters, digits and '_', joined by '.'";
  }

  std::optional<Expr> parseInner(std::size_t from, std::size_t end) {
    while (from < end && isSpace(text_[from])) ++from;
    return Expr::parse(text_.substr(from, end - from), shifted(place_, from), diagnostics_);
  }

  // What stands between the brackets at at_ and its end; moves behind them.
  std::optional<std::pair<std::size_t, std::size_t>> bracket() {
    const std::size_t close = closingBracket(text_, at_);
    if (close == std::string_view::npos || text_[close] != ']') {
      fail(at_, "the '[' that opens here is never closed", "close it with ']'");
      return std::nullopt;
    }
    const std::size_t from = at_ + 1;
    at_ = close + 1;
    if (isBlank(text_.substr(from, close - from))) {
      fail(from, "empty brackets", "write an index, or a span such as [0..3]");
      return std::nullopt;
    }
    return std::pair{from, close};
  }

  bool parseSpan(std::optional<SpanDesc>& span, std::string_view word, std::size_t wordAt) {
    if (span) return fail(wordAt, fmt::format("'.{}' stands twice", word), "select it once");
    if (here() != '[')
      return fail(at_, fmt::format("'.{}' without its index", word),
                  fmt::format("write '.{0}[0]', or '.{0}[1..]' for a span", word));
    const auto inner = bracket();
    if (!inner) return false;
    span.emplace();
    const auto [from, end] = *inner;
    int depth = 0;
    std::size_t dots = std::string_view::npos;
    for (std::size_t i = from; i < end; ++i) {
      if (text_[i] == '[' || text_[i] == '(') ++depth;
      if (text_[i] == ']' || text_[i] == ')') --depth;
      if (depth == 0 && i + 1 < end && text_[i] == '.' && text_[i + 1] == '.') {
        dots = i;
        break;
      }
    }
    const auto side = [&](std::size_t a, std::size_t b, Expr& out) {
      if (isBlank(text_.substr(a, b - a))) return true;
      const auto expr = parseInner(a, b);
      if (expr) out = *expr;
      return expr.has_value();
    };
    if (dots == std::string_view::npos) return side(from, end, span->first);
    span->range = true;
    const bool first = side(from, dots, span->first);
    return side(dots + 2, end, span->last) && first;
  }

  bool parseSelectors() {
    while (!ended()) {
      const std::size_t start = at_;
      if (here() == '[') {
        if (ref_.element) return fail(at_, "a second '[…]'", "an array has one dimension");
        const auto inner = bracket();
        if (!inner) return false;
        ref_.element = parseInner(inner->first, inner->second);
        if (!ref_.element) return false;
        continue;
      }
      if (here() != '.') return true;
      const std::string_view word = peekWord(at_ + 1);
      at_ += 1 + word.size();
      if (word == "stencil") {
        if (ref_.stencil) return fail(start, "'.stencil' stands twice", "select it once");
        ref_.stencil = true;
        continue;
      }
      std::optional<SpanDesc>* span = word == "mip"     ? &ref_.mip
                                      : word == "layer" ? &ref_.layer
                                      : word == "face"  ? &ref_.face
                                                        : nullptr;
      if (!span) {
        static const std::vector<std::string> kSelectors = {"mip", "layer", "face", "stencil"};
        return fail(start, fmt::format("'.{}' selects nothing", word), base::nearestHint(word, kSelectors));
      }
      if (!parseSpan(*span, word, start)) return false;
    }
    return true;
  }

  bool parseHistory() {
    skipSpace();
    if (here() != '@') return true;
    const std::size_t start = at_;
    const bool minus = at_ + 1 < text_.size() && text_[at_ + 1] == '-';
    at_ += minus ? 2 : 1;
    const char* first = text_.data() + at_;
    int depth = 0;
    if (minus && isDigit(here())) {
      const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), depth);
      at_ += static_cast<std::size_t>(end - first);
      if (error != std::errc()) depth = 0;
    }
    if (depth < 1)
      return fail(start, "history is written '@-1', '@-2', …",
                  fmt::format("write '{}@-1' for what it was in the frame before", ref_.name));
    ref_.history = depth;
    return true;
  }

  static bool isWordOfAs(std::string_view word) {
    return std::ranges::find(kSamplerWords, word) != kSamplerWords.end() ||
           std::ranges::find(kKindNames, word) != kKindNames.end();
  }

  bool parseWords() {
    skipSpace();
    if (peekWord(at_) != "as") return true;
    const std::size_t start = at_;
    at_ += 2;
    const auto mistake = parseAsWords(text_, at_, ref_);
    ref_.wordsAt = static_cast<std::uint32_t>(start);
    ref_.wordsSize = static_cast<std::uint32_t>(text_.find_last_not_of(" \t\r\n", at_ - 1) + 1 - start);
    return !mistake || fail(mistake->at, mistake->message, mistake->hint);
  }

  bool parseCondition() {
    skipSpace();
    if (ended()) return true;
    const std::string_view word = peekWord(at_);
    if (word != "if") {
      std::string hint = "a reference is: name, selectors, @-n, 'as' words, 'if' condition, '?'";
      if (here() == '?') hint = "'?' stands at the very end";
      if (here() == '.') hint = "selectors stand right behind the name";
      if (ref_.history == 0 && isIdentStart(here()))
        hint = isWordOfAs(word) ? fmt::format("write 'as {}'", word)
                                : fmt::format("did you mean 'as {}' or 'if {}'?", word, word);
      return fail(at_, fmt::format("unexpected '{}'", word.empty() ? character(at_) : word), hint);
    }
    at_ += 2;
    const std::size_t start = at_;
    if (isBlank(text_.substr(start)))
      return fail(start, "'if' without a condition", "write one, such as 'if $bloom'");
    auto condition = parseInner(start, text_.size());
    if (!condition) return false;
    ref_.condition = *condition;
    return true;
  }

  std::string_view whole_, text_;  // as written; without the trailing '?' and spaces
  Place place_;
  base::Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  RefDesc ref_;
};

}  // namespace

std::optional<RefDesc> parseRef(std::string_view text, const Place& place, base::Diagnostics& diagnostics) {
  return RefParser(text, place, diagnostics).run();
}

bool looksLikeRef(std::string_view text) {
  std::size_t at = 0;
  const auto skipSpace = [&] {
    while (at < text.size() && isSpace(text[at])) ++at;
  };
  skipSpace();
  if (at < text.size() && text[at] == '@') return true;
  const std::size_t start = at;
  while (at < text.size() && (isIdentChar(text[at]) || text[at] == '.')) ++at;
  const std::string_view word = text.substr(start, at - start);
  if (word.empty() || !isIdentStart(word[0]) || word == "true" || word == "false" || word == "screen" ||
      word.substr(0, 7) == "device.")
    return false;
  skipSpace();
  return at >= text.size() || text[at] != '(';
}

std::optional<CallText> parseCallText(std::string_view text, const Place& place,
                                      base::Diagnostics& diagnostics) {
  CallText call;
  std::size_t at = 0;
  while (at < text.size() && isIdentChar(text[at])) ++at;
  call.name = text.substr(0, at);
  const auto fail = [&](std::size_t offset, std::string message) {
    auto& d = diagnostics.error(Code::badReference, shifted(place, offset), std::move(message));
    d.found = fmt::format("\"{}\"", text);
    d.expected = "a word with its arguments, such as \"quad\" or \"icosphere(2)\"";
    return std::nullopt;
  };
  if (!isIdent(call.name)) return fail(0, "this is no word");
  if (at == text.size()) return call;
  if (text[at] != '(') return fail(at, "unexpected text behind the word");
  if (closingBracket(text, at) != text.size() - 1 || text.back() != ')')
    return fail(at, "the '(' that opens here is not closed at the end");
  int depth = 0;
  std::size_t from = at + 1;
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (text[i] == '[' || text[i] == '(') ++depth;
    if (text[i] == ']') --depth;
    const bool last = i == text.size() - 1;
    if (text[i] == ')' && !last) --depth;
    if (!last && (depth != 0 || text[i] != ',')) continue;
    auto argument = Expr::parse(text.substr(from, i - from), shifted(place, from), diagnostics);
    if (!argument) return std::nullopt;
    call.arguments.push_back(*std::move(argument));
    from = i + 1;
  }
  return call;
}

}  // namespace weft::graph
