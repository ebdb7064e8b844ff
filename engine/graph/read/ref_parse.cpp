#include "engine/graph/read/ref_parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "engine/graph/language/keys.h"
#include "engine/graph/language/names.h"
#include "engine/graph/subresource.h"
#include "engine/text/nearest.h"
#include "engine/text/words/words.h"
#include "graph_sentences.h"

namespace weft::graph {

namespace {

using std::string_view;
using text::Code;

// The offset of the first `wanted` outside of brackets in text[from, end), or `end`. Kinds of brackets are not told apart: a
// mixed pair is left for the expression parser to object to.
std::size_t findOutside(string_view text, std::size_t from, std::size_t end, string_view wanted) {
  int depth = 0;
  for (std::size_t i = from; i < end; ++i) {
    if (depth == 0 && text.substr(i, end - i).starts_with(wanted)) return i;
    if (text[i] == '[' || text[i] == '(') ++depth;
    if (text[i] == ']' || text[i] == ')') --depth;
  }
  return end;
}

// The offset of the bracket that closes the one at `open`, or npos.
std::size_t closingBracket(string_view text, std::size_t open) {
  const std::size_t close = findOutside(text, open + 1, text.size(), text[open] == '[' ? "]" : ")");
  return close < text.size() ? close : string_view::npos;
}

// "0, 0, 0, 1", or one number for all four.
std::optional<BorderColor> parseColor(string_view list) {
  const Value value = parseValue(fmt::format("[{}]", list));
  if (value.type != Value::Type::list || (value.count != 1 && value.count != 4)) return {};
  BorderColor color{};
  for (std::size_t i = 0; i < color.size(); ++i)
    color[i] = static_cast<float>(value.v[value.count == 1 ? 0 : i]);
  return std::ranges::all_of(color, [](float x) { return std::isfinite(x); }) ? std::optional(color)
                                                                              : std::nullopt;
}

class RefParser {
 public:
  RefParser(string_view text, const Place& place, text::Diagnostics& diagnostics)
      : whole_(text), text_(text), place_(place), diagnostics_(diagnostics) {
    ref_.text = text;
  }

  std::optional<RefDesc> run() {
    dropSpaceBehind();
    if (text_.ends_with('?')) {
      ref_.optional = true;
      text_.remove_suffix(1);
      dropSpaceBehind();
    }
    skipSpace();
    ref_.place = place_.after(at_);
    return parseName() && parseSelectors() && parseHistory() && parseWords() && parseCondition()
               ? std::optional(std::move(ref_))
               : std::nullopt;
  }

 private:
  template <class... Args>
  bool fail(text::Saying<Args...> what, std::size_t offset, Args&&... args) {
    diagnostics_.error<Args...>(what, place_.after(offset), std::forward<Args>(args)...).found =
        fmt::format("\"{}\"", whole_);
    return false;
  }

  void dropSpaceBehind() {
    while (!text_.empty() && isSpace(text_.back())) text_.remove_suffix(1);
  }
  void skipSpace() {
    while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
  }
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  string_view peekWord(std::size_t from) const {
    std::size_t end = from;
    if (end < text_.size() && isIdentStart(text_[end]))
      while (end < text_.size() && isIdentChar(text_[end])) ++end;
    return text_.substr(from, end - from);
  }

  // What is at hand, for messages: a word, a whole character, or the end.
  std::string found() const {
    if (at_ >= text_.size()) return "the end";
    std::size_t end = at_ + std::max<std::size_t>(peekWord(at_).size(), 1);
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
    return fmt::format("'{}'", text_.substr(at_, end - at_));
  }

  bool parseName() {
    ref_.import = here() == '@';
    if (ref_.import) ++at_;
    while (true) {
      const string_view word = peekWord(at_);
      if (word.empty())
        return fail(say::nameExpected, at_, found(),
                    here() == '$'
                        ? "resources have no '$'; a choice is a list in \"resources\": [\"a if $x\", \"b\"]"
                        : "names are letters, digits and '_', joined by '.'; '?' stands at the very end");
      if (isReservedWord(word)) return fail(say::reservedInName, at_, word);
      ref_.name += word;
      at_ += word.size();
      if (here() != '.' || isReservedWord(peekWord(at_ + 1))) return true;
      ref_.name += '.';
      ++at_;
    }
  }

  std::optional<Expr> parseInner(std::size_t from, std::size_t end) {
    while (from < end && isSpace(text_[from])) ++from;
    return Expr::parse(text_.substr(from, end - from), place_.after(from), diagnostics_);
  }

  // The offset of the bracket that closes the one at at_; 0 after a report, also of empty brackets. Moves behind it.
  std::size_t closeBracket() {
    const std::size_t close = closingBracket(text_, at_), from = at_ + 1;
    if (close == string_view::npos) return fail(say::openBracket, at_), 0;
    at_ = close + 1;
    if (trimmed(text_.substr(from, close - from)).empty()) return fail(say::emptyBrackets, from), 0;
    return close;
  }

  bool parseSpan(std::optional<SpanDesc>& span, string_view word, std::size_t wordAt) {
    if (span) return fail(say::selectorTwice, wordAt, word);
    if (here() != '[') return fail(say::selectorWithoutIndex, at_, word);
    const std::size_t from = at_ + 1, end = closeBracket();
    if (end == 0) return false;
    const auto side = [&](std::size_t a, std::size_t b, Expr& out) {
      if (trimmed(text_.substr(a, b - a)).empty()) return true;
      const auto expr = parseInner(a, b);
      if (expr) out = *expr;
      return expr.has_value();
    };
    span.emplace();
    const std::size_t dots = findOutside(text_, from, end, "..");
    span->range = dots < end;
    return side(from, dots, span->first) && (!span->range || side(dots + 2, end, span->last));
  }

  bool parseSelectors() {
    while (here() == '[' || here() == '.') {
      const std::size_t start = at_;
      if (here() == '[') {
        if (ref_.element) return fail(say::secondElement, at_);
        const std::size_t end = closeBracket();
        const std::optional<Expr> index = end > 0 ? parseInner(start + 1, end) : std::nullopt;
        if (!index) return false;
        ref_.element = SpanDesc{.first = *index};
        continue;
      }
      const string_view word = peekWord(at_ + 1);
      at_ += 1 + word.size();
      if (word == "stencil" && !std::exchange(ref_.stencil, true)) continue;
      std::optional<SpanDesc>* span = word == "mip"     ? &ref_.mip
                                      : word == "layer" ? &ref_.layer
                                      : word == "face"  ? &ref_.face
                                                        : nullptr;
      if (!span)
        return fail(say::unknownSelector, start, word,
                    text::nearestHint(word, std::vector<std::string>{"mip", "layer", "face", "stencil"}));
      if (!parseSpan(*span, word, start)) return false;
    }
    return true;
  }

  bool parseHistory() {
    skipSpace();
    if (here() != '@') return true;
    const std::size_t start = at_;
    if (text_.substr(at_).starts_with("@-") && at_ + 2 < text_.size() && isDigit(text_[at_ + 2])) {
      const auto [end, error] =
          std::from_chars(text_.data() + at_ + 2, text_.data() + text_.size(), ref_.history);
      at_ = static_cast<std::size_t>(end - text_.data());
      if (error == std::errc() && ref_.history > 0) return true;
    }
    return fail(say::badHistory, start, ref_.name);
  }

  // ---- the words after "as": a kind and filters ----

  bool parseWords() {
    skipSpace();
    if (peekWord(at_) != "as") return true;
    const std::size_t start = at_;
    at_ += 2;
    for (bool any = false;; any = true) {
      skipSpace();
      const string_view word = peekWord(at_);
      if ((word.empty() || word == "if") && !any) return fail(say::asWithoutWord, at_);
      if (word.empty() || word == "if") break;
      if (!takeWord(word, at_)) return false;
    }
    ref_.samples = filtered_ || wrapped_ || ref_.sampler.compare;
    if (ref_.sampler.compare) ref_.sampler.linear = ref_.sampler.linear || !filtered_;
    ref_.wordsAt = static_cast<std::uint32_t>(start);
    ref_.wordsSize = static_cast<std::uint32_t>(text_.find_last_not_of(" \t\r\n", at_ - 1) + 1 - start);
    return true;
  }

  bool takeWord(string_view word, std::size_t wordAt) {
    const auto sampler =
        static_cast<std::size_t>(std::ranges::find(kSamplerWords, word) - kSamplerWords.begin());
    const auto kind = static_cast<std::size_t>(std::ranges::find(kKindNames, word) - kKindNames.begin());
    const bool isKind = kind < kKindNames.size();
    if (!isKind && sampler == kSamplerWords.size()) return failWord(word, wordAt);
    at_ += word.size();
    const bool filters = sampler < 2, wraps = sampler >= 2 && sampler < 6;
    bool& taken = isKind ? hasKind_ : filters ? filtered_ : wraps ? wrapped_ : ref_.sampler.compare;
    if (std::exchange(taken, true)) return fail(say::wordRepeats, wordAt, word);
    if (isKind) ref_.kind = static_cast<Kind>(kind);
    if (filters) ref_.sampler.linear = word == "linear";
    if (wraps) ref_.sampler.wrap = static_cast<Wrap>(sampler - 2);
    if ((word == "border" || word == "compare") && !takeArguments(word, wordAt)) return false;
    // A blit has a filter, and samples nothing.
    const bool mayFilter = !ref_.kind || *ref_.kind == Kind::sampled || *ref_.kind == Kind::copy;
    const bool maySample = !ref_.kind || *ref_.kind == Kind::sampled;
    if ((filtered_ && !mayFilter) || ((wrapped_ || ref_.sampler.compare) && !maySample))
      return fail(say::filterOfUnsampled, wordAt);
    return true;
  }

  bool failWord(string_view word, std::size_t wordAt) {
    std::vector<std::string> known(kKindNames.begin(), kKindNames.end());
    known.insert(known.end(), kSamplerWords.begin(), kSamplerWords.end());
    std::string hint = text::hintOrNearest("sampling", word, known);
    if (hint.empty()) hint = fmt::format("known: {}", fmt::join(known, " "));
    return fail(say::unknownWordAfterAs, wordAt, word, hint);
  }

  // What stands between parentheses right behind a word, of which there need be none: `border(0, 0, 0, 1)`, `compare(greater)`.
  bool takeArguments(string_view word, std::size_t wordAt) {
    if (here() != '(') return true;
    const std::size_t from = at_ + 1, end = text_.find(')', from);
    if (end == string_view::npos) return fail(say::openParenthesis, at_);
    at_ = end + 1;
    const string_view argument = trimmed(text_.substr(from, end - from));
    if (word == "border") {
      const std::optional<BorderColor> color = parseColor(argument);
      if (color) ref_.border = *color;
      return color || fail(say::noBorderColor, wordAt, text_.substr(wordAt, at_ - wordAt));
    }
    const auto found = std::ranges::find(kCompareNames, argument);
    if (found != kCompareNames.end()) {
      ref_.sampler.function = static_cast<Compare>(found - kCompareNames.begin());
      return true;
    }
    const std::vector<std::string> known(kCompareNames.begin(), kCompareNames.end());
    return fail(say::noComparison, wordAt, text_.substr(wordAt, at_ - wordAt),
                text::hintOrNearest("state_word", argument, known));
  }

  bool parseCondition() {
    skipSpace();
    if (at_ >= text_.size()) return true;
    const string_view word = peekWord(at_);
    if (word != "if") {
      const bool sampling = std::ranges::find(kSamplerWords, word) != kSamplerWords.end() ||
                            std::ranges::find(kKindNames, word) != kKindNames.end();
      return fail(say::unexpectedInReference, at_, found(),
                  sampling ? fmt::format("write 'as {}'", word)
                           : "a reference is: name, selectors, @-n, 'as' words, 'if' condition, '?'");
    }
    at_ += 2;
    if (trimmed(text_.substr(at_)).empty()) return fail(say::ifWithoutCondition, at_);
    auto condition = parseInner(at_, text_.size());
    if (condition) ref_.condition = *std::move(condition);
    return ref_.condition.present();
  }

  string_view whole_, text_;  // as written; without the trailing '?' and spaces
  Place place_;
  text::Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  bool filtered_ = false, wrapped_ = false, hasKind_ = false;  // words said so
  RefDesc ref_;
};

}  // namespace

std::optional<RefDesc> parseRef(string_view text, const Place& place, text::Diagnostics& diagnostics) {
  return RefParser(text, place, diagnostics).run();
}

bool looksLikeRef(string_view text) {
  text = trimmed(text);
  if (text.starts_with('@')) return true;
  const string_view word = dottedNameIn(text);
  if (word.empty() || word == "true" || word == "false" || word == "screen" || word.starts_with("device."))
    return false;
  return !trimmed(text.substr(word.size())).starts_with('(');
}

std::optional<CallText> parseCallText(string_view text, const Place& place, text::Diagnostics& diagnostics) {
  CallText call;
  std::size_t at = 0;
  while (at < text.size() && isIdentChar(text[at])) ++at;
  call.name = text.substr(0, at);
  if (!isIdent(call.name) || (at < text.size() && (text[at] != '(' || text.back() != ')' ||
                                                   closingBracket(text, at) != text.size() - 1))) {
    diagnostics.error(say::notACall, place.after(isIdent(call.name) ? at : 0), text);
    return std::nullopt;
  }
  const std::size_t end = text.empty() ? 0 : text.size() - 1;
  for (std::size_t from = at + 1; from <= end;) {
    const std::size_t comma = findOutside(text, from, end, ",");
    auto argument = Expr::parse(text.substr(from, comma - from), place.after(from), diagnostics);
    if (!argument) return std::nullopt;
    call.arguments.push_back(*std::move(argument));
    from = comma + 1;
  }
  return call;
}

}  // namespace weft::graph
