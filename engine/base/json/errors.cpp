#include "engine/base/json/errors.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/characters.h"
#include "engine/base/chars.h"
#include "engine/base/files/file_kind.h"

namespace weft::base {

JsonText::JsonText(std::string_view text, std::shared_ptr<const std::string> file)
    : text_(text), file_(std::move(file)) {
  lines_.reserve(static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '\n')) + 1);
  lines_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') lines_.push_back(static_cast<std::uint32_t>(i + 1));
}

Place JsonText::placeOf(std::size_t offset) const {
  const auto next = std::upper_bound(lines_.begin(), lines_.end(), offset);
  const auto line = static_cast<std::size_t>(next - lines_.begin());
  return {file_, static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(offset - *(next - 1) + 1)};
}

std::size_t JsonText::startOfString(std::size_t end) const {
  std::size_t at = end;
  if (at > 0 && text_[at - 1] == '"') --at;  // the closing quote
  while (at > 0) {
    --at;
    if (text_[at] != '"') continue;
    std::size_t slashes = 0;
    while (slashes < at && text_[at - 1 - slashes] == '\\') ++slashes;
    if (slashes % 2 == 0) return at;
    at -= slashes;
  }
  return 0;
}

namespace {

class Reporter {
 public:
  Reporter(const JsonText& text, std::size_t consumed, const std::string& token, std::string_view what,
           const std::optional<JsonOpening>& inside, const std::string& key, Diagnostics& diagnostics)
      : text_(text),
        consumed_(std::min(consumed, text.text().size())),
        token_(token),
        what_(what),
        inside_(inside),
        key_(key),
        diagnostics_(diagnostics) {}

  void run() {
    if (says("number overflow"))
      return report(numberStart(), fmt::format("the number {} is too large", token_),
                    "the largest is about 1.8e308");
    if (says("missing closing quote"))
      return report(text_.startOfString(consumed_), "the string that opens here is never closed",
                    "close it with '\"'");
    if (says("invalid string: control character")) return reportControl();
    if (says("after backslash"))
      return report(
          consumed_ - 2, fmt::format("unknown escape '{}' in a string", printable(consumed_ - 2, consumed_)),
          "write '/' in paths, '\\\\' for a backslash; others are \\\" \\n \\r \\t \\b \\f \\/ \\uXXXX");
    if (says("must be followed by 4 hex digits"))
      return report(consumed_ - 1, "'\\u' needs four hexadecimal digits",
                    "write it as \\u00e9, or the character itself");
    if (says("surrogate"))
      return report(consumed_ - 1, "half of a surrogate pair in a string",
                    "write the character itself instead of \\u…");
    if (says("ill-formed UTF-8")) return reportEncoding();
    if (says("invalid comment"))
      return report(commentStart(),
                    says("missing closing") ? "the comment that opens here is never closed"
                                            : "a '/' that begins no comment",
                    "comments are // to the end of the line and /* … */");
    if (says("invalid BOM")) return report(0, "a damaged byte order mark", "save the file as UTF-8");
    if (says("invalid number"))
      return report(consumed_ - std::min(token_.size(), consumed_),
                    fmt::format("'{}' is not a number", word(consumed_ - std::min(token_.size(), consumed_))),
                    "digits are needed before and after the point, and after 'e'");
    if (says("invalid literal")) return reportLiteral();
    if (says("unexpected end of input")) return reportEnd();
    reportUnexpected();
  }

 private:
  bool says(std::string_view part) const { return what_.find(part) != std::string_view::npos; }

  void report(std::size_t offset, std::string message, std::string hint, std::string expected = {}) {
    auto& d = diagnostics_.error(Code::notJson, text_.placeOf(offset), std::move(message));
    d.hint = std::move(hint);
    d.expected = std::move(expected);
  }

  std::string printable(std::size_t from, std::size_t to) const {
    std::string out(text_.text().substr(from, to - from));
    for (char& c : out)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7F) c = '?';
    return out;
  }

  // The word or number around `start`; a single character when it is neither.
  std::string word(std::size_t start) const {
    std::size_t end = start;
    const std::string_view all = text_.text();
    while (end < all.size() &&
           (isIdentChar(all[end]) || all[end] == '.' || all[end] == '-' || all[end] == '+'))
      ++end;
    return printable(start, std::max(end, std::min(start + 1, all.size())));
  }

  std::size_t wordStart(std::size_t at) const {
    while (at > 0 && isIdentChar(text_.at(at - 1))) --at;
    return at;
  }

  std::size_t numberStart() const {
    std::size_t end = consumed_;
    if (end > 0 && !isDigit(text_.at(end - 1))) --end;
    return end - std::min(token_.size(), end);
  }

  std::size_t commentStart() const {
    const std::size_t block = text_.text().rfind("/*", consumed_);
    if (says("missing closing") && block != std::string_view::npos) return block;
    const std::size_t slash = text_.text().rfind('/', consumed_ == 0 ? 0 : consumed_ - 1);
    return slash == std::string_view::npos ? consumed_ : slash;
  }

  void reportEncoding() {
    std::size_t at = consumed_ - 1;
    const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(text_.at(i)); };
    // A plain character that cuts a sequence short: the sequence is to blame.
    if (byteAt(at) < 0x80)
      while (at > 0 && byteAt(at) < 0xC0 && byteAt(at - 1) >= 0x80) --at;
    report(at, fmt::format("the byte 0x{:02X} is not UTF-8", byteAt(at)), "save the file as UTF-8");
  }

  void reportControl() {
    const std::size_t at = consumed_ - 1;
    if (text_.at(at) == '\n' || text_.at(at) == '\r')
      return report(text_.startOfString(at), "the string that opens here is not closed on its line",
                    "close it with '\"'; a line break inside a string is written \\n");
    const auto byte = static_cast<unsigned>(static_cast<unsigned char>(text_.at(at)));
    report(at, fmt::format("a control character (U+{:04X}) inside a string", byte),
           byte == 9 ? "write a tab as \\t" : fmt::format("write it as \\u{:04x}", byte));
  }

  void reportLiteral() {
    // The lexer stops at the first character that spells no literal; the word it belongs to begins before it.
    std::size_t start = consumed_ - 1;
    if (!isIdentChar(text_.at(start)) && start > 0 && isIdentChar(text_.at(start - 1))) {
      const std::string before = word(wordStart(start - 1));
      if (before != "true" && before != "false" && before != "null") --start;
    }
    if (isIdentChar(text_.at(start))) start = wordStart(start);
    if (isConflict(start))
      return report(start, "a merge conflict is left in the file", "keep one side, and take the marks away");
    if (start > 0 && text_.at(start - 1) == '"') {
      const std::size_t open = text_.startOfString(start);
      return report(open,
                    fmt::format("the string '{}' ends before '{}'", printable(open, start), word(start)),
                    "a '\"' is missing in it, or one is too many");
    }
    if (static_cast<unsigned char>(text_.at(start)) >= 0x80) {
      const StrayCharacter stray = describeStray(text_.text().substr(start));
      return report(start, stray.message,
                    stray.hint.empty() ? "outside of strings a graph is plain ASCII" : stray.hint);
    }
    const std::string found = word(start);
    if (says("while parsing object key") && isIdentChar(found[0]) && !isDigit(found[0]))
      return report(start, fmt::format("the key '{}' has no quotes", found),
                    fmt::format("write \"{}\"", found), "a key in double quotes");
    std::string lower = found;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    std::string hint = "values are numbers, true, false, null, \"strings\", [arrays] and {objects}";
    if (lower == "true" || lower == "false" || lower == "null")
      hint = fmt::format("write '{}' in lower case", lower);
    if (lower == "none" || lower == "nil" || lower == "undefined") hint = "write 'null'";
    if (lower == "nan" || lower.find("inf") == 0 || lower == "-inf" || lower == "+inf")
      hint = "JSON has no such number; leave the key out";
    if (found == "'") hint = "strings stand in double quotes";
    if (found[0] == '.' || found[0] == '+') hint = "a number begins with a digit or '-'";
    if (found[0] == '#') hint = "comments are // to the end of the line and /* … */";
    report(start, fmt::format("'{}' is not a JSON value", found), hint);
  }

  // Whether git's mark of a merge conflict stands there, which fills the beginning of a line.
  bool isConflict(std::size_t at) const {
    if (at > 0 && text_.at(at - 1) != '\n') return false;
    const std::string_view rest = text_.text().substr(at);
    return std::ranges::any_of(
        std::initializer_list<std::string_view>{"<<<<<<<", "=======", ">>>>>>>", "|||||||"},
        [&](std::string_view mark) { return rest.starts_with(mark); });
  }

  void reportEnd() {
    std::size_t end = text_.text().size();
    while (end > 0 && isSpace(text_.at(end - 1))) --end;
    if (!inside_)
      return report(end, "the file holds no value", "a document is one object: { … }", "an object");
    report(end,
           fmt::format("the file ends inside the {} that opens at {}:{}",
                       inside_->object ? "object" : "array", inside_->place.line, inside_->place.column),
           fmt::format("close it with '{}'", inside_->object ? '}' : ']'));
  }

  // Where the unexpected token begins.
  std::size_t tokenStart() const {
    if (says("unexpected string literal")) return text_.startOfString(consumed_);
    if (says("unexpected number literal")) return numberStart();
    for (const char* literal : {"true", "false", "null"})
      if (says(fmt::format("unexpected {} literal", literal))) return wordStart(consumed_ - 1);
    return consumed_ - 1;
  }

  void reportUnexpected() {
    const std::size_t start = tokenStart();
    const std::string found = says("unexpected number literal") ? token_ : printable(start, consumed_);
    const bool closing = found == "}" || found == "]";
    if (says("expected end of input"))
      return report(start, fmt::format("'{}' follows the end of the document", found),
                    closing ? "one bracket too many closes here or before" : "a file holds one object",
                    "the end of the file");
    if (says("while parsing object key"))
      return report(start, fmt::format("'{}' where a key is expected", found),
                    found == "}" ? "remove the comma before it" : "keys are strings in double quotes",
                    "a key in double quotes");
    if (says("while parsing object separator"))
      return report(start, fmt::format("'{}' follows the key \"{}\"", found, key_),
                    "write ':' between a key and its value", "':'");
    const bool array = says("while parsing array");
    if (array || says("while parsing object"))
      return report(
          start,
          fmt::format("'{}' follows a value of the {}{}", found, array ? "array" : "object", opening()),
          closing || found == ":" ? "a bracket or a comma is missing before it" : "put a comma before it",
          array ? "',' or ']'" : "',' or '}'");
    report(start, fmt::format("'{}' where a value is expected", found),
           closing ? "remove the comma before it, or add a value" : "", "a value");
  }

  std::string opening() const {
    return inside_ ? fmt::format(" that opens at {}:{}", inside_->place.line, inside_->place.column)
                   : std::string();
  }

  const JsonText& text_;
  std::size_t consumed_;
  const std::string& token_;
  std::string_view what_;
  const std::optional<JsonOpening>& inside_;
  const std::string& key_;
  Diagnostics& diagnostics_;
};

}  // namespace

bool reportUnreadable(const JsonText& text, Diagnostics& diagnostics) {
  const std::string_view all = text.text();
  if (std::all_of(all.begin(), all.end(), isSpace)) {
    auto& d = diagnostics.error(Code::notJson, text.placeOf(0), "the file is empty");
    d.expected = "an object: { … }";
    return false;
  }
  if (const std::optional<FileKind> kind = kindOfFile(all)) {
    auto& d =
        diagnostics.error(Code::notJson, text.placeOf(0), fmt::format("this is {}, not JSON", kind->what));
    d.expected = "a JSON document in UTF-8";
    d.hint = kind->hint;
    return false;
  }
  if (const std::size_t zero = all.find('\0'); zero != std::string_view::npos) {
    diagnostics.error(Code::notJson, text.placeOf(zero), "a zero byte: this is no UTF-8 text").hint =
        "save the file as UTF-8";
    return false;
  }
  return true;
}

void reportJsonError(const JsonText& text, std::size_t consumed, const std::string& token,
                     std::string_view what, const std::optional<JsonOpening>& inside, const std::string& key,
                     Diagnostics& diagnostics) {
  Reporter(text, consumed, token, what, inside, key, diagnostics).run();
}

}  // namespace weft::base
