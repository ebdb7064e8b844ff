#include "engine/convert/isf/size_expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/chars.h"

namespace weft::convert {

namespace {

constexpr std::array<std::string_view, 5> kSizeFunctions{"floor", "ceil", "min", "max", "abs"};
constexpr std::size_t kMostText = 400, kMostDepth = 30;

class SizeReader {
 public:
  SizeReader(std::string_view text, const base::Place& place,
             const std::function<std::string(std::string_view)>& variableOf, base::Diagnostics& diagnostics)
      : text_(text), place_(place), variableOf_(variableOf), diagnostics_(diagnostics) {}

  std::optional<std::string> run() {
    if (text_.size() > kMostText) fail(0, fmt::format("the size has more than {} characters", kMostText));
    if (good_) sum();
    skip();
    if (good_ && at_ < text_.size()) fail(at_, fmt::format("'{}' cannot stand here in a size", text_[at_]));
    return good_ ? std::optional(out_) : std::nullopt;
  }

 private:
  void skip() {
    while (at_ < text_.size() && base::isSpace(text_[at_])) ++at_;
  }
  bool take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    out_ += c;
    return true;
  }
  void fail(std::size_t at, std::string message) {
    if (!good_) return;
    good_ = false;
    base::Place place = place_;
    if (place.column > 0) place.column += static_cast<std::uint32_t>(at);
    auto& d = diagnostics_.error(base::Code::sizeNotMapped, place, std::move(message));
    d.expected = "numbers, $WIDTH, $HEIGHT, $input, + - * / % ( ), floor, ceil, min, max, abs";
    d.found = std::string(text_.substr(0, 60));
    d.hint = "write the size with these, and import again";
  }

  void sum() {
    if (++depth_ > kMostDepth) return fail(at_, "the size is nested too deeply");
    unary();
    while (good_ && (take('+') || take('-') || take('*') || take('/') || take('%'))) unary();
    --depth_;
  }

  void unary() {
    while (take('-')) {
    }
    skip();
    const std::size_t begin = at_;
    if (at_ >= text_.size()) return fail(at_, "the size ends too early");
    const auto word = [&] {
      const std::size_t from = at_;
      while (at_ < text_.size() && base::isIdentChar(text_[at_])) ++at_;
      return text_.substr(from, at_ - from);
    };
    if (take('(')) {
      sum();
      if (good_ && !take(')')) fail(at_, "a bracket of the size is not closed");
    } else if (text_[at_] == '$') {
      ++at_;
      const std::string_view name = word();
      const std::string variable = name.empty() ? std::string() : variableOf_(name);
      if (variable.empty()) return fail(begin, fmt::format("'${}' is no number that a size can use", name));
      out_ += variable;
    } else if (base::isDigit(text_[at_]) || text_[at_] == '.') {
      while (at_ < text_.size() && (base::isDigit(text_[at_]) || text_[at_] == '.')) ++at_;
      const std::string_view number = text_.substr(begin, at_ - begin);
      if (std::ranges::count(number, '.') > 1 || number == ".")
        return fail(begin, fmt::format("'{}' is no number", number));
      // Weft has digits on both sides of a point.
      out_ += (number.front() == '.' ? "0" : "") + std::string(number) + (number.back() == '.' ? "0" : "");
    } else if (base::isIdentStart(text_[at_])) {
      const std::string name = base::lowered(word());
      skip();
      if (std::ranges::find(kSizeFunctions, std::string_view(name)) == kSizeFunctions.end())
        return fail(begin, fmt::format("Weft has no function '{}' for sizes", name));
      out_ += name;
      if (!take('(')) return fail(at_, fmt::format("a '(' is missing behind '{}'", name));
      sum();
      while (good_ && take(',')) {
        out_ += ' ';
        sum();
      }
      if (good_ && !take(')')) fail(at_, "a bracket of the size is not closed");
    } else {
      fail(begin, fmt::format("'{}' cannot stand here in a size", text_[begin]));
    }
  }

  std::string_view text_;
  base::Place place_;
  const std::function<std::string(std::string_view)>& variableOf_;
  base::Diagnostics& diagnostics_;
  std::string out_;
  std::size_t at_ = 0, depth_ = 0;
  bool good_ = true;
};

}  // namespace

std::optional<std::string> convertIsfSize(std::string_view text, const base::Place& place,
                                          const std::function<std::string(std::string_view)>& variableOf,
                                          base::Diagnostics& diagnostics) {
  return SizeReader(text, place, variableOf, diagnostics).run();
}

}  // namespace weft::convert
