#include "app/lsp/text/glsl_outline.h"

#include <algorithm>
#include <array>

#include "engine/base/chars.h"

namespace weft::app::lsp {

namespace {

bool isWord(std::string_view text) {
  return !text.empty() && base::isIdentStart(text[0]);
}

}  // namespace

class GlslOutline::Scan {
 public:
  Scan(std::string_view text, GlslOutline& out) : text_(text), out_(out) {}

  void run() {
    while (at_ < text_.size()) step();
  }

 private:
  struct Token {
    std::string_view text;
    std::size_t begin = 0;
  };

  void step() {
    const char c = text_[at_];
    if (text_.substr(at_, 2) == "//") {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (text_.substr(at_, 2) == "/*") {
      const std::size_t end = text_.find("*/", at_ + 2);
      at_ = end == std::string_view::npos ? text_.size() : end + 2;
    } else if (c == '\n') {
      if (at_ == 0 || text_[at_ - 1] != '\\') directive_ = false;
      lineStart_ = true;
      ++at_;
    } else if (base::isSpace(c)) {
      ++at_;
    } else if (c == '#' && lineStart_) {
      ++at_;
      openDirective();
    } else if (base::isIdentStart(c) || base::isDigit(c)) {
      const std::size_t begin = at_;
      while (at_ < text_.size() && base::isIdentChar(text_[at_])) ++at_;
      take({text_.substr(begin, at_ - begin), begin});
    } else {
      take({text_.substr(at_, 1), at_});
      ++at_;
    }
  }

  void openDirective() {
    directive_ = true;
    lineStart_ = false;
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && base::isIdentChar(text_[at_])) ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (name == "define") {
      while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
      std::size_t end = at_;
      while (end < text_.size() && base::isIdentChar(text_[end])) ++end;
      const std::size_t line = std::min(text_.find('\n', at_), text_.size());
      out_.names_.push_back(
          {GlslName::Kind::define, text_.substr(at_, end - at_), {at_, end}, {}, {begin - 1, line}});
    }
    if (name != "include") return;
    const std::size_t line = std::min(text_.find('\n', at_), text_.size());
    const std::size_t open = text_.find('"', at_), close = open < line ? text_.find('"', open + 1) : line;
    if (open < line && close < line)
      out_.includes_.push_back({text_.substr(open + 1, close - open - 1), {open + 1, close}});
    at_ = line;
  }

  void take(const Token& token) {
    lineStart_ = false;
    if (isWord(token.text))
      out_.words_.push_back({token.text, {token.begin, token.begin + token.text.size()}, last_ == "."});
    last_ = token.text;
    if (directive_) return;
    if (token.text == "{") {
      if (depth_++ == 0) openBlock(token);
    } else if (token.text == "}") {
      depth_ = std::max(0, depth_ - 1);
      statement_.clear();
      if (depth_ == 0) inBlock_ = false;
    } else if (token.text == ";") {
      if ((depth_ == 0 && isInterface()) || (depth_ == 1 && inBlock_)) addDeclarators(token);
      statement_.clear();
    } else if (depth_ <= 1) {
      statement_.push_back(token);
    }
  }

  bool says(std::string_view word) const {
    return std::ranges::find(statement_, word, &Token::text) != statement_.end();
  }

  // Whether the statement declares something of the interface: it has uniform, buffer, in or out, and no parentheses but those
  // of layout (a function has its own).
  bool isInterface() const {
    int nested = 0;
    bool storage = false;
    for (std::size_t i = 0; i < statement_.size(); ++i) {
      const std::string_view t = statement_[i].text;
      if (t == "(" && nested++ == 0 && (i == 0 || statement_[i - 1].text != "layout")) return false;
      if (t == ")") --nested;
      if (nested == 0) storage |= t == "uniform" || t == "buffer" || t == "in" || t == "out";
    }
    return storage;
  }

  void openBlock(const Token& brace) {
    inBlock_ = isInterface() && isWord(statement_.back().text);
    if (inBlock_) {
      const Token& name = statement_.back();
      block_ = name.text;
      const bool storage = says("buffer");
      add(storage ? GlslName::Kind::storage_block : GlslName::Kind::uniform_block, name, {}, brace.begin);
    }
    statement_.clear();
  }

  void add(GlslName::Kind kind, const Token& name, std::string_view block, std::size_t end) {
    out_.names_.push_back({kind,
                           name.text,
                           {name.begin, name.begin + name.text.size()},
                           block,
                           {statement_.front().begin, end},
                           !says("writeonly"),
                           !says("readonly")});
  }

  void addDeclarators(const Token& semicolon) {
    const auto begins = [&](std::string_view type) {
      return std::ranges::any_of(statement_, [&](const Token& t) {
        return t.text.starts_with(type) || (t.text.size() > 1 && t.text.substr(1).starts_with(type));
      });
    };
    const GlslName::Kind kind = inBlock_ && depth_ == 1 ? GlslName::Kind::member
                                : begins("sampler")     ? GlslName::Kind::sampler
                                : begins("image")       ? GlslName::Kind::image
                                : says("out")           ? GlslName::Kind::output
                                                        : GlslName::Kind::input;
    int nested = 0;
    for (std::size_t i = 0; i < statement_.size(); ++i) {
      const std::string_view t = statement_[i].text;
      if (t == "(" || t == "[") ++nested;
      if (t == ")" || t == "]") --nested;
      if (nested > 0 || i == 0 || !isWord(t)) continue;
      const bool last = i + 1 == statement_.size();
      const std::string_view next = last ? ";" : statement_[i + 1].text;
      if (next == ";" || next == "," || next == "[" || next == "=")
        add(kind, statement_[i], kind == GlslName::Kind::member ? block_ : std::string_view(),
            semicolon.begin + 1);
    }
  }

  std::string_view text_;
  GlslOutline& out_;
  std::size_t at_ = 0;
  bool lineStart_ = true, directive_ = false, inBlock_ = false;
  int depth_ = 0;
  std::string_view last_, block_;
  std::vector<Token> statement_;
};

GlslOutline::GlslOutline(std::string_view text) {
  Scan(text, *this).run();
}

const GlslName* GlslOutline::find(std::string_view name) const {
  const auto found = std::ranges::find(names_, name, &GlslName::name);
  return found == names_.end() ? nullptr : &*found;
}

const GlslWord* GlslOutline::wordAt(std::size_t offset) const {
  for (const GlslWord& word : words_)
    if (word.range.holds(offset)) return &word;
  return nullptr;
}

}  // namespace weft::app::lsp
