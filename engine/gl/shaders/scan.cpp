#include "engine/gl/shaders/scan.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace weft::gl {

namespace {

bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}
bool isStart(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool isPart(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

bool LineScanner::next() {
  if (rest_.empty()) return false;
  if (directive_.name == "if" || directive_.name == "ifdef" || directive_.name == "ifndef") ++depth_;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
  ++number_;
  strip();
  directive_ = {};
  const std::string_view code = trim(code_);
  if (!code.starts_with('#')) return true;
  std::string_view body = trim(code.substr(1));
  std::size_t length = 0;
  while (length < body.size() && isPart(body[length])) ++length;
  directive_ = {body.substr(0, length), trim(body.substr(length)),
                static_cast<std::uint32_t>(code_.find('#') + 1)};
  if (directive_.name == "endif") depth_ = std::max(0, depth_ - 1);
  return true;
}

void LineScanner::strip() {
  code_.assign(line_);
  bool quoted = false;
  for (std::size_t i = 0; i < code_.size(); ++i) {
    const std::string_view two = std::string_view(code_).substr(i, 2);
    if (inComment_) {
      if (two == "*/") {
        code_[i++] = ' ';
        inComment_ = false;
      }
      code_[i] = ' ';
    } else if (code_[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && two == "/*") {
      code_[i++] = ' ';
      code_[i] = ' ';
      inComment_ = true;
    } else if (!quoted && two == "//") {
      code_.resize(i);
    }
  }
}

namespace {

// Collects the names of one global declaration, token by token.
class DeclarationScan {
 public:
  explicit DeclarationScan(NameSet& declared) : declared_(declared) {}

  void feed(std::string_view token) {
    if (token == "{") {
      if (depth_++ == 0) openBlock();
    } else if (token == "}") {
      depth_ = std::max(0, depth_ - 1);
      statement_.clear();
      if (depth_ == 0) inBlock_ = false;
    } else if (token == ";") {
      if ((depth_ == 0 && isInterface()) || (depth_ == 1 && inBlock_)) addDeclarators();
      statement_.clear();
    } else if (depth_ <= 1) {
      statement_.emplace_back(token);
    }
  }

 private:
  // Says uniform, buffer, in or out outside parentheses, and has none but layout's (a function has its own).
  bool isInterface() const {
    bool storage = false;
    int nested = 0;
    for (std::size_t i = 0; i < statement_.size(); ++i) {
      const std::string& t = statement_[i];
      if (t == "(" && nested++ == 0 && (i == 0 || statement_[i - 1] != "layout")) return false;
      if (t == ")") --nested;
      if (nested == 0) storage |= t == "uniform" || t == "buffer" || t == "in" || t == "out";
    }
    return storage;
  }
  void openBlock() {
    inBlock_ = isInterface() && !statement_.empty() && isStart(statement_.back()[0]);
    if (inBlock_) declared_.insert(statement_.back());
    statement_.clear();
  }
  void addDeclarators() {
    int nested = 0;
    for (std::size_t i = 0; i < statement_.size(); ++i) {
      const std::string& token = statement_[i];
      if (token == "(" || token == "[") ++nested;
      if (token == ")" || token == "]") --nested;
      if (nested > 0 || !isStart(token[0]) || i == 0) continue;
      const bool last = i + 1 == statement_.size();
      if (last || statement_[i + 1] == "," || statement_[i + 1] == "[" || statement_[i + 1] == "=") {
        const bool keyword = token == "in" || token == "out" || token == "uniform" || token == "buffer";
        if (!keyword) declared_.insert(token);
      }
    }
  }

  NameSet& declared_;
  std::vector<std::string> statement_;
  int depth_ = 0;
  bool inBlock_ = false;
};

}  // namespace

void scanNames(std::string_view text, NameSet& identifiers, NameSet& declared) {
  DeclarationScan declarations(declared);
  bool lineStart = true, directive = false, directiveName = false;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (text.substr(i, 2) == "//") {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.substr(i, 2) == "/*") {
      const std::size_t end = text.find("*/", i + 2);
      i = end == std::string_view::npos ? text.size() : end + 2;
    } else if (c == '\n') {
      const bool continued = i > 0 && text[i - 1] == '\\';
      if (!continued) directive = false;
      lineStart = true;
      ++i;
    } else if (isSpace(c)) {
      ++i;
    } else if (isStart(c) || std::isdigit(static_cast<unsigned char>(c)) != 0) {
      const std::size_t begin = i;
      while (i < text.size() && isPart(text[i])) ++i;
      const std::string_view word = text.substr(begin, i - begin);
      if (isStart(c) && !directiveName) identifiers.emplace(word);
      directiveName = false;
      if (!directive) declarations.feed(word);
      lineStart = false;
    } else {
      if (c == '#' && lineStart) directive = directiveName = true;
      if (!directive) declarations.feed(text.substr(i, 1));
      lineStart = false;
      ++i;
    }
  }
}

}  // namespace weft::gl
