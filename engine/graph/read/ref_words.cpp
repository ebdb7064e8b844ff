#include "engine/graph/read/ref_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/language/names.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

namespace {

std::optional<Wrap> wrapOf(std::string_view word) {
  constexpr std::array<std::string_view, 4> kWraps = {"clamp", "wrap", "mirror", "border"};
  const auto found = std::ranges::find(kWraps, word);
  if (found == kWraps.end()) return std::nullopt;
  return static_cast<Wrap>(found - kWraps.begin());
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
  return text;
}

class WordParser {
 public:
  WordParser(std::string_view text, std::size_t& at, RefDesc& ref) : text_(text), at_(at), ref_(ref) {}

  std::optional<WordMistake> run() {
    for (bool any = false;; any = true) {
      while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
      start_ = at_;
      while (at_ < text_.size() && (at_ == start_ ? isIdentStart(text_[at_]) : isIdentChar(text_[at_])))
        ++at_;
      const std::string_view word = text_.substr(start_, at_ - start_);
      if (word.empty() || word == "if") {
        at_ = start_;
        if (any) return std::nullopt;
        return WordMistake{start_, "'as' without a word",
                           "say a kind or a filter, such as 'as depth' or 'as linear wrap'"};
      }
      if (!takeWord(word)) return mistake_;
      const bool samples = !filter_.empty() || !wrapping_.empty() || ref_.sampler.compare;
      if (samples && ref_.kind && *ref_.kind != Kind::sampled)
        return WordMistake{start_, "filters belong to sampled textures only", "drop the kind or the filter"};
      if (ref_.sampler.compare) ref_.sampler.linear = filter_ != "nearest";
    }
  }

 private:
  bool fail(std::size_t at, std::string message, std::string hint) {
    mistake_ = WordMistake{at, std::move(message), std::move(hint)};
    return false;
  }

  bool takeWord(std::string_view word) {
    if (word == "linear" || word == "nearest") {
      ref_.sampler.linear = word == "linear";
      return takeOneOf(word, filter_);
    }
    if (const auto wrap = wrapOf(word)) {
      ref_.sampler.wrap = *wrap;
      return takeOneOf(word, wrapping_) && (*wrap != Wrap::border || takeColor());
    }
    if (word == "compare") {
      if (ref_.sampler.compare) return fail(start_, "'compare' stands twice", "keep one of them");
      ref_.sampler.compare = true;
      return takeFunction();
    }
    return takeKind(word);
  }

  // Takes a word where only one of several may stand.
  bool takeOneOf(std::string_view word, std::string_view& earlier) {
    if (earlier == word) return fail(start_, fmt::format("'{}' stands twice", word), "keep one of them");
    if (!earlier.empty())
      return fail(start_, fmt::format("'{}' contradicts an earlier word", word), "keep one of them");
    earlier = word;
    return true;
  }

  // What stands between the parentheses right behind a word; nothing when there are none. False after a mistake.
  bool takeArguments(std::optional<std::string_view>& arguments) {
    if (at_ >= text_.size() || text_[at_] != '(') return true;
    const std::size_t from = at_ + 1, end = text_.find(')', from);
    if (end == std::string_view::npos)
      return fail(at_, "the '(' that opens here is never closed", "close it with ')'");
    at_ = end + 1;
    arguments = text_.substr(from, end - from);
    return true;
  }

  // `border`, `border(1)`, `border(0, 0, 0, 1)`.
  bool takeColor() {
    std::optional<std::string_view> rest;
    if (!takeArguments(rest)) return false;
    if (!rest) return true;
    std::vector<float> numbers;
    for (bool more = true; more && numbers.size() <= 4;) {
      const std::size_t comma = std::min(rest->find(','), rest->size());
      const std::string_view number = trimmed(rest->substr(0, comma));
      float value = 0;
      const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
      if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(value)) {
        numbers.clear();
        break;
      }
      numbers.push_back(value);
      more = comma < rest->size();
      rest->remove_prefix(more ? comma + 1 : comma);
    }
    if (numbers.size() == 1) numbers.resize(4, numbers[0]);
    if (numbers.size() != 4)
      return fail(start_, fmt::format("'{}' is no colour of a border", text_.substr(start_, at_ - start_)),
                  "write four numbers, 'border(0, 0, 0, 1)', or one for all channels, 'border(1)'");
    std::ranges::copy(numbers, ref_.border.begin());
    return true;
  }

  // `compare`, `compare(greater)`.
  bool takeFunction() {
    std::optional<std::string_view> argument;
    if (!takeArguments(argument)) return false;
    if (!argument) return true;
    const std::string_view word = trimmed(*argument);
    const auto found = std::ranges::find(kCompareNames, word);
    if (found == kCompareNames.end()) {
      std::string hint = base::hintForForeign(base::Foreign::state_word, word);
      if (hint.empty())
        hint = base::nearestHint(word, std::vector<std::string>(kCompareNames.begin(), kCompareNames.end()));
      return fail(start_, fmt::format("'{}' is no comparison", text_.substr(start_, at_ - start_)),
                  std::move(hint));
    }
    ref_.sampler.function = static_cast<Compare>(found - kCompareNames.begin());
    return true;
  }

  bool takeKind(std::string_view word) {
    std::vector<std::string> known;
    for (std::size_t kind = 0; kind < kKindNames.size(); ++kind) {
      known.emplace_back(kKindNames[kind]);
      if (word != known.back()) continue;
      if (ref_.kind) return fail(start_, fmt::format("a second kind, '{}'", word), "a use has one kind");
      ref_.kind = static_cast<Kind>(kind);
      return true;
    }
    for (const std::string_view name : kSamplerWords) known.emplace_back(name);
    std::string hint = base::nearestHint(word, known);
    if (const std::string meant = base::hintForForeign(base::Foreign::sampling, word); !meant.empty())
      hint = meant;
    if (hint.empty())
      hint = fmt::format("kinds are {}, filters are {}", fmt::join(kKindNames, " "),
                         fmt::join(kSamplerWords, " "));
    return fail(start_, fmt::format("unknown word '{}' after 'as'", word), std::move(hint));
  }

  std::string_view text_;
  std::size_t& at_;
  RefDesc& ref_;
  std::size_t start_ = 0;               // of the word at hand
  std::string_view filter_, wrapping_;  // the words that said so
  WordMistake mistake_;
};

}  // namespace

std::optional<WordMistake> parseAsWords(std::string_view text, std::size_t& at, RefDesc& ref) {
  return WordParser(text, at, ref).run();
}

}  // namespace weft::graph
