#include "engine/glsl/scan.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/chars.h"

namespace weft::glsl {

namespace {

bool isLineSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isLineSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isLineSpace(text.back())) text.remove_suffix(1);
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
  const std::string_view code = trimmed(code_);
  if (!code.starts_with('#')) return true;
  std::string_view body = trimmed(code.substr(1));
  std::size_t length = 0;
  while (length < body.size() && base::isIdentChar(body[length])) ++length;
  directive_ = {body.substr(0, length), trimmed(body.substr(length)),
                static_cast<std::uint32_t>(code_.find('#') + 1)};
  const std::string_view name = directive_.name;
  if (name == "endif") depth_ = std::max(0, depth_ - 1);
  if (name == "define" && directives_ == 1 && !guards_.empty() && directive_.rest == guards_) guard_ = 1;
  if (depth_ == 0 || (depth_ == 1 && name.starts_with("el"))) guard_ = 0;
  guards_ = directives_++ == 0 && name == "ifndef" ? std::string(directive_.rest) : std::string();
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
  DeclarationScan(NameSet& declared, DeclaredParts& parts) : declared_(declared), parts_(parts) {}

  void feed(std::string_view token) {
    if (token == "{") {
      if (depth_++ == 0) openBlock();
    } else if (token == "}") {
      depth_ = std::max(0, depth_ - 1);
      statement_.clear();
      closed_ = depth_ == 0 && inBlock_;
      if (depth_ == 0) inBlock_ = false;
    } else if (token == ";") {
      if (std::exchange(closed_, false))
        addInstance();
      else if ((depth_ == 0 && isInterface()) || (depth_ == 1 && inBlock_))
        addDeclarators();
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
    inBlock_ = isInterface() && !statement_.empty() && base::isIdentStart(statement_.back()[0]);
    if (inBlock_) declared_.insert(block_ = statement_.back());
    members_.clear();
    closed_ = false;
    statement_.clear();
  }
  void addDeclarators() {
    int nested = 0;
    for (std::size_t i = 0; i < statement_.size(); ++i) {
      const std::string& token = statement_[i];
      if (token == "(" || token == "[") ++nested;
      if (token == ")" || token == "]") --nested;
      if (nested > 0 || !base::isIdentStart(token[0]) || i == 0) continue;
      const bool last = i + 1 == statement_.size();
      if (last || statement_[i + 1] == "," || statement_[i + 1] == "[" || statement_[i + 1] == "=") {
        const bool keyword = token == "in" || token == "out" || token == "uniform" || token == "buffer";
        if (keyword) continue;
        declared_.insert(token);
        if (inBlock_) members_.push_back(token);
        addImageFormat(token);
      }
    }
  }

  // What stands between a block's '}' and its ';'.
  void addInstance() {
    if (statement_.empty() || !base::isIdentStart(statement_[0][0])) return;
    parts_.instanceOf[block_] = statement_[0];
    for (const std::string& member : members_) parts_.blockOf[member] = block_;
  }
  // The words of layout(…) of an image; which of them are formats is not known here.
  void addImageFormat(const std::string& name) {
    const bool image = std::ranges::any_of(statement_, [](const std::string& t) {
      return t.starts_with("image") || t.starts_with("iimage") || t.starts_with("uimage");
    });
    const auto layout = std::ranges::find(statement_, "layout");
    if (!image || layout == statement_.end()) return;
    std::vector<std::string>& formats = parts_.imageFormats[name];
    for (auto at = layout; at != statement_.end() && *at != ")"; ++at)
      if (at != layout && base::isIdentStart((*at)[0])) formats.push_back(*at);
  }

  NameSet& declared_;
  DeclaredParts& parts_;
  std::string block_;  // the one that is open, or closed last
  std::vector<std::string> members_;
  bool closed_ = false;  // the statement is what follows a block
  std::vector<std::string> statement_;
  int depth_ = 0;
  bool inBlock_ = false;
};

}  // namespace

void scanNames(std::string_view text, NameSet& identifiers, NameSet& declared, DeclaredParts& parts) {
  DeclarationScan declarations(declared, parts);
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
    } else if (isLineSpace(c)) {
      ++i;
    } else if (base::isIdentStart(c) || base::isDigit(c)) {
      const std::size_t begin = i;
      while (i < text.size() && base::isIdentChar(text[i])) ++i;
      const std::string_view word = text.substr(begin, i - begin);
      if (base::isIdentStart(c) && !directiveName) identifiers.emplace(word);
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

}  // namespace weft::glsl
