// Declared in source.h.
#include <map>
#include <set>

#include "engine/glsl/source.h"
#include "engine/glsl/tokens.h"

namespace weft::glsl {

namespace {

class IndexClamper {
 public:
  explicit IndexClamper(std::string_view text) : text_(text), tokens_(splitTokens(text)) {}

  std::string run() {
    if (!findShared()) return std::string(text_);
    for (int round = 0; round < 16 && addMacros();) ++round;
    std::map<std::size_t, std::string> added;  // by where
    for (std::size_t i = 1; i < tokens_.size(); ++i) {
      const std::size_t end = tokens_[i].is("[") && !declarations_.contains(i) ? pairOf(i, 1) : 0;
      if (end <= i + 1 || (end == i + 2 && tokens_[i + 1].kind == TokenKind::number)) continue;
      const Indexed what = indexedAt(i);
      if (!what.named || what.declared) continue;
      added[offsetOf(i) + 1] = "min(uint(";
      added[offsetOf(end)] = "), uint(" + what.text + ".length()) - 1u)";
    }
    std::string out;
    std::size_t from = 0;
    for (const auto& [at, more] : added) {
      out.append(text_.substr(from, at - from)).append(more);
      from = at;
    }
    return out.append(text_.substr(from));
  }

 private:
  // What is before a '[': "a[0].b", with zeros for its own indices.
  struct Indexed {
    std::string text;
    bool named = false;     // one of `names_` is in it
    bool declared = false;  // it is a type and a name
  };

  bool isWord(std::size_t i) const { return tokens_[i].kind == TokenKind::word; }
  std::size_t offsetOf(std::size_t i) const {
    return static_cast<std::size_t>(tokens_[i].text.data() - text_.data());
  }

  // The bracket that pairs with the one at `at`, forward or backward (-1); 0 where none does.
  std::size_t pairOf(std::size_t at, std::ptrdiff_t step) const {
    int open = 0;
    for (; at > 0 && at < tokens_.size(); at += static_cast<std::size_t>(step)) {
      const Token& token = tokens_[at];
      open += (token.is("(") || token.is("[") ? 1 : 0) - (token.is(")") || token.is("]") ? 1 : 0);
      if (open == 0) return at;
      if (token.is(";") || token.is("{")) break;
    }
    return 0;
  }

  Indexed indexedAt(std::size_t bracket) const {
    Indexed what;
    std::size_t at = bracket;  // the first token of it
    while (at > 1) {
      const std::size_t last = at - 1, first = isWord(last) ? last : pairOf(last, -1);
      if (first == 0) break;
      at = first;
      if (tokens_[last].is("]")) {
        what.text.insert(0, "[0]");
        continue;
      }
      if (tokens_[last].is(")") && isWord(at - 1)) --at;  // a call
      for (std::size_t i = at; i <= last; ++i) what.named = what.named || names_.contains(tokens_[i].text);
      what.text.insert(0,
                       text_.substr(offsetOf(at), offsetOf(last) + tokens_[last].text.size() - offsetOf(at)));
      if (!tokens_[at - 1].is(".")) break;
      what.text.insert(0, ".");
      --at;
    }
    const Token& before = tokens_[at - 1];
    const bool macro = at > 1 && tokens_[at - 2].is("define");
    what.declared =
        isWord(bracket - 1) &&
        ((isWord(at - 1) && !before.is("return") && !before.is("else") && !macro) || before.is("]"));
    return what;
  }

  // What is said to be `shared`, but in a layout. False when nothing is.
  bool findShared() {
    for (std::size_t i = 1; i < tokens_.size(); ++i)
      if (tokens_[i].is("shared") && !tokens_[i - 1].is("(") && !tokens_[i - 1].is(","))
        for (i += 2; i + 1 < tokens_.size() && !tokens_[i].is(";"); declarations_.insert(i++))
          if (isWord(i) && (tokens_[i + 1].is("[") || tokens_[i + 1].is(",") || tokens_[i + 1].is(";")))
            names_.insert(tokens_[i].text);
    return !names_.empty();
  }

  // Macros that stand for one of the names. True when there is one more.
  bool addMacros() {
    const std::size_t before = names_.size();
    for (std::size_t i = 2; i < tokens_.size(); ++i) {
      if (!tokens_[i - 1].is("define") || !tokens_[i - 2].is("#")) continue;
      const std::string_view name = tokens_[i].text;
      for (++i; i < tokens_.size() && !tokens_[i].first; ++i)
        if (names_.contains(tokens_[i].text)) names_.insert(name);
    }
    return names_.size() > before;
  }

  std::string_view text_;
  std::vector<Token> tokens_;
  std::set<std::string_view> names_;
  std::set<std::size_t> declarations_;  // tokens of theirs
};

}  // namespace

std::string clampShared(std::string_view text) {
  return IndexClamper(text).run();
}

}  // namespace weft::glsl
