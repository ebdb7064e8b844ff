#include "engine/graph/read/ref_parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "engine/graph/language/names.h"
#include "engine/graph/subresource.h"
#include "engine/text/nearest.h"
#include "engine/text/words/foreign_words.h"

namespace weft::graph {

namespace {

using std::string_view;
using text::Code;

Place shifted(Place place, std::size_t columns) {
  if (place.column > 0) place.column += static_cast<std::uint32_t>(columns);
  return place;
}

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
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '[' || text[i] == '(') ++depth;
    if (text[i] == ']' || text[i] == ')')
      if (--depth == 0) return i;
  }
  return string_view::npos;
}

// "0, 0, 0, 1", or one number for all four.
std::optional<BorderColor> parseColor(string_view list) {
  BorderColor color{};
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const auto number = parseNumber(list.substr(0, comma));
    if (!number || count == color.size() || std::abs(*number) > std::numeric_limits<float>::max()) return {};
    color[count] = static_cast<float>(*number);
    more = comma < list.size();
    list.remove_prefix(more ? comma + 1 : comma);
  }
  if (count == 1) color.fill(color[0]);
  return count == 1 || count == 4 ? std::optional(color) : std::nullopt;
}

class RefParser {
 public:
  RefParser(string_view text, const Place& place, text::Diagnostics& diagnostics)
      : whole_(text), text_(text), place_(place), diagnostics_(diagnostics) {
    ref_.text = text;
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

  string_view peekWord(std::size_t from) const {
    std::size_t end = from;
    if (end < text_.size() && isIdentStart(text_[end]))
      while (end < text_.size() && isIdentChar(text_[end])) ++end;
    return text_.substr(from, end - from);
  }

  // A whole character at `from`, for messages.
  string_view character(std::size_t from) const {
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
      const string_view word = peekWord(at_);
      if (word.empty())
        return fail(at_,
                    ended() ? "the reference ends where a name is expected"
                            : fmt::format("'{}' where a name is expected", character(at_)),
                    here() == '?' ? "'?' stands at the very end"
                    : here() == '$'
                        ? "resources have no '$'; a choice is a list in \"resources\": [\"a if $x\", \"b\"]"
                        : "names are letters, digits and '_', joined by '.'");
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

  std::optional<Expr> parseInner(std::size_t from, std::size_t end) {
    while (from < end && isSpace(text_[from])) ++from;
    return Expr::parse(text_.substr(from, end - from), shifted(place_, from), diagnostics_);
  }

  // The offset of the bracket that closes the one at at_; 0 after a report, also of empty brackets. Moves behind it.
  std::size_t closeBracket() {
    const std::size_t close = closingBracket(text_, at_), from = at_ + 1;
    if (close == string_view::npos || text_[close] != ']')
      return fail(at_, "the '[' that opens here is never closed", "close it with ']'"), 0;
    at_ = close + 1;
    if (trimmed(text_.substr(from, close - from)).empty())
      return fail(from, "empty brackets", "write an index, or a span such as [0..3]"), 0;
    return close;
  }

  bool parseSpan(std::optional<SpanDesc>& span, string_view word, std::size_t wordAt) {
    if (span) return fail(wordAt, fmt::format("'.{}' stands twice", word), "select it once");
    if (here() != '[')
      return fail(at_, fmt::format("'.{}' without its index", word),
                  fmt::format("write '.{0}[0]', or '.{0}[1..]' for a span", word));
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
    const bool first = side(from, dots, span->first);
    return (!span->range || side(dots + 2, end, span->last)) && first;
  }

  bool parseSelectors() {
    while (!ended()) {
      const std::size_t start = at_;
      if (here() == '[') {
        if (ref_.element) return fail(at_, "a second '[…]'", "an array has one dimension");
        const std::size_t end = closeBracket();
        if (end == 0) return false;
        ref_.element = parseInner(start + 1, end);
        if (!ref_.element) return false;
        continue;
      }
      if (here() != '.') return true;
      const string_view word = peekWord(at_ + 1);
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
        return fail(start, fmt::format("'.{}' selects nothing", word), text::nearestHint(word, kSelectors));
      }
      if (!parseSpan(*span, word, start)) return false;
    }
    return true;
  }

  bool parseHistory() {
    skipSpace();
    if (here() != '@') return true;
    const std::size_t start = at_;
    if (text_.substr(at_).starts_with("@-") && at_ + 2 < text_.size() && isDigit(text_[at_ + 2])) {
      const char* first = text_.data() + at_ + 2;
      const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), ref_.history);
      at_ = static_cast<std::size_t>(end - text_.data());
      if (error == std::errc() && ref_.history > 0) return true;
    }
    return fail(start, "history is written '@-1', '@-2', …",
                fmt::format("write '{}@-1' for what it was in the frame before", ref_.name));
  }

  // ---- the words after "as": a kind and filters ----

  bool parseWords() {
    skipSpace();
    if (peekWord(at_) != "as") return true;
    const std::size_t start = at_;
    at_ += 2;
    if (!takeWords()) return false;
    ref_.wordsAt = static_cast<std::uint32_t>(start);
    ref_.wordsSize = static_cast<std::uint32_t>(text_.find_last_not_of(" \t\r\n", at_ - 1) + 1 - start);
    return true;
  }

  bool takeWords() {
    for (bool any = false;; any = true) {
      skipSpace();
      wordAt_ = at_;
      const string_view word = peekWord(at_);
      if (word.empty() || word == "if") {
        if (ref_.sampler.compare) ref_.sampler.linear = filter_ != "nearest";
        return any || fail(at_, "'as' without a word",
                           "say a kind or a filter, such as 'as depth' or 'as linear wrap'");
      }
      at_ += word.size();
      if (!takeWord(word)) return false;
      const bool samples = !filter_.empty() || !wrapping_.empty() || ref_.sampler.compare;
      if (samples && ref_.kind && *ref_.kind != Kind::sampled)
        return fail(wordAt_, "filters belong to sampled textures only", "drop the kind or the filter");
    }
  }

  bool takeWord(string_view word) {
    constexpr std::array<string_view, 4> kWraps = {"clamp", "wrap", "mirror", "border"};
    if (word == "linear" || word == "nearest") {
      ref_.sampler.linear = word == "linear";
      return takeOnce(word, filter_);
    }
    if (const auto wrap = std::ranges::find(kWraps, word); wrap != kWraps.end()) {
      ref_.sampler.wrap = static_cast<Wrap>(wrap - kWraps.begin());
      return takeOnce(word, wrapping_) && (word != "border" || takeColor());
    }
    if (word == "compare") {
      ref_.sampler.compare = true;
      return takeOnce(word, compare_) && takeFunction();
    }
    if (const auto kind = std::ranges::find(kKindNames, word); kind != kKindNames.end()) {
      if (ref_.kind) return fail(wordAt_, fmt::format("a second kind, '{}'", word), "a use has one kind");
      ref_.kind = static_cast<Kind>(kind - kKindNames.begin());
      return true;
    }
    std::vector<std::string> known(kKindNames.begin(), kKindNames.end());
    known.insert(known.end(), kSamplerWords.begin(), kSamplerWords.end());
    std::string hint = text::hintForForeign(text::Foreign::sampling, word);
    if (hint.empty()) hint = text::nearestHint(word, known);
    if (hint.empty())
      hint = fmt::format("kinds are {}, filters are {}", fmt::join(kKindNames, " "),
                         fmt::join(kSamplerWords, " "));
    return fail(wordAt_, fmt::format("unknown word '{}' after 'as'", word), std::move(hint));
  }

  // Takes a word where only one of several may stand.
  bool takeOnce(string_view word, string_view& earlier) {
    if (!earlier.empty())
      return fail(
          wordAt_,
          fmt::format("'{}' {}", word, earlier == word ? "stands twice" : "contradicts an earlier word"),
          "keep one of them");
    earlier = word;
    return true;
  }

  // What stands between the parentheses right behind a word; nothing when there are none. False after a mistake.
  bool takeArguments(std::optional<string_view>& arguments) {
    if (here() != '(') return true;
    const std::size_t from = at_ + 1, end = text_.find(')', from);
    if (end == string_view::npos)
      return fail(at_, "the '(' that opens here is never closed", "close it with ')'");
    at_ = end + 1;
    arguments = text_.substr(from, end - from);
    return true;
  }

  // `border`, `border(1)`, `border(0, 0, 0, 1)`.
  bool takeColor() {
    std::optional<string_view> list;
    if (!takeArguments(list)) return false;
    const std::optional<BorderColor> color = list ? parseColor(*list) : ref_.border;
    if (!color)
      return fail(wordAt_, fmt::format("'{}' is no color of a border", text_.substr(wordAt_, at_ - wordAt_)),
                  "write four numbers, 'border(0, 0, 0, 1)', or one for all channels, 'border(1)'");
    ref_.border = *color;
    return true;
  }

  // `compare`, `compare(greater)`.
  bool takeFunction() {
    std::optional<string_view> argument;
    if (!takeArguments(argument)) return false;
    if (!argument) return true;
    const string_view word = trimmed(*argument);
    const auto found = std::ranges::find(kCompareNames, word);
    if (found == kCompareNames.end()) {
      std::string hint = text::hintForForeign(text::Foreign::state_word, word);
      if (hint.empty())
        hint = text::nearestHint(word, std::vector<std::string>(kCompareNames.begin(), kCompareNames.end()));
      return fail(wordAt_, fmt::format("'{}' is no comparison", text_.substr(wordAt_, at_ - wordAt_)),
                  std::move(hint));
    }
    ref_.sampler.function = static_cast<Compare>(found - kCompareNames.begin());
    return true;
  }

  bool parseCondition() {
    skipSpace();
    if (ended()) return true;
    const string_view word = peekWord(at_);
    if (word != "if") {
      std::string hint = "a reference is: name, selectors, @-n, 'as' words, 'if' condition, '?'";
      if (here() == '?') hint = "'?' stands at the very end";
      if (here() == '.') hint = "selectors stand right behind the name";
      if (std::ranges::find(kSamplerWords, word) != kSamplerWords.end() ||
          std::ranges::find(kKindNames, word) != kKindNames.end())
        hint = fmt::format("write 'as {}'", word);
      return fail(at_, fmt::format("unexpected '{}'", word.empty() ? character(at_) : word), hint);
    }
    at_ += 2;
    if (trimmed(text_.substr(at_)).empty())
      return fail(at_, "'if' without a condition", "write one, such as 'if $bloom'");
    auto condition = parseInner(at_, text_.size());
    if (condition) ref_.condition = *std::move(condition);
    return ref_.condition.present();
  }

  string_view whole_, text_;  // as written; without the trailing '?' and spaces
  Place place_;
  text::Diagnostics& diagnostics_;
  std::size_t at_ = 0, wordAt_ = 0;          // at hand; where its word after `as` begins
  string_view filter_, wrapping_, compare_;  // the words that said so
  RefDesc ref_;
};

}  // namespace

std::optional<RefDesc> parseRef(string_view text, const Place& place, text::Diagnostics& diagnostics) {
  return RefParser(text, place, diagnostics).run();
}

bool looksLikeRef(string_view text) {
  text = trimmed(text);
  if (text.starts_with('@')) return true;
  std::size_t at = 0;
  while (at < text.size() && (isIdentChar(text[at]) || text[at] == '.')) ++at;
  const string_view word = text.substr(0, at);
  if (word.empty() || !isIdentStart(word[0]) || word == "true" || word == "false" || word == "screen" ||
      word.starts_with("device."))
    return false;
  return !trimmed(text.substr(at)).starts_with('(');
}

std::optional<CallText> parseCallText(string_view text, const Place& place, text::Diagnostics& diagnostics) {
  CallText call;
  std::size_t at = 0;
  while (at < text.size() && isIdentChar(text[at])) ++at;
  call.name = text.substr(0, at);
  if (!isIdent(call.name) || (at < text.size() && (text[at] != '(' || text.back() != ')' ||
                                                   closingBracket(text, at) != text.size() - 1))) {
    auto& d = diagnostics.error(Code::badReference, shifted(place, isIdent(call.name) ? at : 0),
                                "this is no word with its arguments");
    d.found = fmt::format("\"{}\"", text);
    d.expected = "a word with its arguments, such as \"quad\" or \"icosphere(2)\"";
    return std::nullopt;
  }
  const std::size_t end = text.empty() ? 0 : text.size() - 1;
  for (std::size_t from = at + 1; from <= end;) {
    const std::size_t comma = findOutside(text, from, end, ",");
    auto argument = Expr::parse(text.substr(from, comma - from), shifted(place, from), diagnostics);
    if (!argument) return std::nullopt;
    call.arguments.push_back(*std::move(argument));
    from = comma + 1;
  }
  return call;
}

}  // namespace weft::graph
