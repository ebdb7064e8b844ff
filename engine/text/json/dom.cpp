#include "engine/text/json/dom.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "engine/text/chars.h"
#include "engine/text/files/file.h"
#include "engine/text/limits.h"
#include "engine/text/printable.h"
#include "text_sentences.h"

namespace weft::text {

namespace {

using Type = JsonValue::Type;

// From so many keys on they are found by a table.
constexpr std::size_t kManyKeys = 24;

// Characters that mean themselves in a string: ASCII but for control characters, quotes and backslashes.
constexpr bool isPlain(char c) {
  return c >= ' ' && c != '"' && c != '\\';
}

bool isOneOf(char c, std::string_view all) {
  return all.find(c) != std::string_view::npos;
}

// Reads a text by recursive descent. With diagnostics it reports the first mistake of grammar and passes over the rest; without
// it recovers, and passes over what it does not understand.
class Parser {
 public:
  Parser(std::string_view text, FileName file, Diagnostics* diagnostics, std::vector<ByteRange>* comments)
      : text_(text), file_(file), diagnostics_(diagnostics), comments_(comments) {
    rewind();
  }

  // False after a mistake of grammar.
  bool run(JsonValue& root) {
    blank();
    value(root);
    blank();
    if (!ends())
      unexpected("the end of the file", "a file holds one object; a bracket too many may close it");
    return !failed_;
  }

 private:
  bool ends() const { return at_ >= text_.size(); }
  char now() const { return ends() ? '\0' : text_[at_]; }
  void skip() { at_ = std::min(at_ + 1, text_.size()); }

  void rewind() {
    line_ = 1;
    lineStart_ = first_;
    lineEnd_ = std::min(text_.find('\n', first_), text_.size());
  }

  Place placeAt(std::size_t at) {
    if (!diagnostics_) return {};
    if (at < lineStart_) rewind();
    for (; lineEnd_ < at; ++line_) {
      lineStart_ = lineEnd_ + 1;
      lineEnd_ = std::min(text_.find('\n', lineStart_), text_.size());
    }
    return {file_, line_, static_cast<std::uint32_t>(at - lineStart_ + 1)};
  }

  // Reports the first mistake and passes over the rest of the text.
  template <class... Args>
  void fail(Saying<Args...> what, std::size_t at, Args&&... args) {
    if (!diagnostics_ || failed_) return;
    diagnostics_->error<Args...>(what, placeAt(at), std::forward<Args>(args)...);
    failed_ = true;
    at_ = text_.size();
  }

  // Behind all that stands together at `at`; there when it is punctuation.
  std::size_t endOfWord(std::size_t at) const {
    while (at < text_.size() && !isSpace(text_[at]) && !isOneOf(text_[at], ",:]}[{\"/")) ++at;
    return at;
  }

  void unexpected(const std::string& expected, std::string hint) {
    if (ends()) return endsEarly();
    const std::size_t end = now() == '"' ? text_.find_first_of("\"\r\n", at_ + 1) + 1 : endOfWord(at_);
    const std::string_view found = text_.substr(at_, end > at_ ? end - at_ : 1);
    fail(say::unexpected, at_, found, expected, hint);
  }

  std::string openContainer() {
    const Place place = placeAt(open_.back());
    return fmt::format("the {} that opens at {}:{}", text_[open_.back()] == '{' ? "object" : "array",
                       place.line, place.column);
  }

  void endsEarly() {
    std::size_t end = text_.size();
    while (end > first_ && isSpace(text_[end - 1])) --end;
    if (open_.empty())
      fail(say::holdsNoValue, end);
    else
      fail(say::endsInside, end, openContainer());
  }

  // ---- white space and comments ----

  void blank() {
    do {
      while (isSpace(now())) ++at_;
    } while (comment());
  }

  bool comment() {
    const std::size_t begin = at_;
    const std::string_view rest = text_.substr(begin);
    const bool line = rest.starts_with("//");
    if (!line && !rest.starts_with("/*")) return false;
    std::size_t end = line ? text_.find_first_of("\r\n", begin) : text_.find("*/", begin + 2);
    const bool open = !line && end == std::string_view::npos;
    if (open)
      end = text_.find('\n', begin);
    else if (!line)
      end += 2;
    at_ = std::min(end, text_.size());
    if (comments_) comments_->push_back({begin, at_});
    if (open) fail(say::openComment, begin);
    return true;
  }

  // ---- values ----

  void value(JsonValue& out) {
    out.place = placeAt(at_);
    out.begin = static_cast<std::uint32_t>(at_);
    const bool container = now() == '{' || now() == '[';
    if (++count_ > raised(kMaxValues))
      fail(say::tooManyValues, at_, raised(kMaxValues), hintToRaise(kMaxValues));
    if (ends() || isOneOf(now(), "}],:")) {
      out.type = Type::absent;
      unexpected("a value", "add a value, or remove the comma before it");
    } else if (container && open_.size() >= kMaxJsonDepth) {
      out.type = Type::absent;
      fail(say::nestedTooDeeply, at_, kMaxJsonDepth);
    } else {
      container ? members(out) : scalar(out);
    }
    out.end = static_cast<std::uint32_t>(at_);
  }

  void members(JsonValue& out) {
    const bool object = now() == '{';
    out.type = object ? Type::object : Type::array;
    out.closed = false;
    open_.push_back(at_++);
    std::unordered_map<std::string, std::size_t> keys;
    bool first = true, comma = false;
    for (;;) {
      blank();
      const bool closes = now() == '}' || now() == ']';
      // A bracket of the other kind closes a container further out; this one was left open.
      out.closed = closes && (now() == '}') == object;
      if (closes ? comma || !out.closed : ends() || (!first && !comma)) expectElement(object, first || comma);
      if (closes || ends()) break;
      const std::size_t begin = at_;
      object ? member(out, keys) : value(out.items.emplace_back());
      blank();
      comma = now() == ',';
      if (comma || at_ == begin) skip();  // a byte that cannot stand here is passed over
      first = false;
    }
    if (out.closed) skip();
    open_.pop_back();
    // Large ones keep no room for more: it would be a quarter of the memory of a large file.
    if (out.members.size() > 64) out.members.shrink_to_fit();
    if (out.items.size() > 64) out.items.shrink_to_fit();
  }

  // Reports what stands where an element, or else a comma, is expected.
  void expectElement(bool object, bool element) {
    if (!element)
      unexpected(object ? "',' or '}'" : "',' or ']'",
                 "a comma, a quote or a bracket is missing before it, in " + openContainer());
    else
      unexpected(object ? "a key in double quotes" : "a value",
                 now() == '\'' || now() == '\xE2' ? "write it in double quotes, \"like this\""
                 : now() == '#'                   ? "a comment begins with //"
                 : now() == '{' || now() == '['
                     ? "a quote or a bracket is missing before it, in " + openContainer()
                     : "no comma may follow the last; keys are strings");
  }

  void member(JsonValue& object, std::unordered_map<std::string, std::size_t>& keys) {
    JsonValue dropped;
    if (now() != '"') {
      expectElement(true, true);
      return value(dropped);
    }
    JsonMember read;
    read.place = placeAt(at_);
    read.begin = static_cast<std::uint32_t>(at_);
    string(read.key, read.closed);
    read.end = static_cast<std::uint32_t>(at_);
    if (read.key.size() > kMaxNameBytes) fail(say::keyTooLong, read.begin, read.key.size(), kMaxNameBytes);
    blank();
    read.hasValue = now() == ':';
    if (!read.hasValue) unexpected("':'", "write ':' between a key and its value");
    if (const JsonMember* before = diagnostics_ ? findKey(object, read.key, keys) : nullptr;
        before && !failed_) {
      diagnostics_->error(say::duplicateKey, read.place, read.key, before->place.line, before->place.column);
      skip();
      blank();
      return value(dropped);
    }
    JsonValue& out = object.members.emplace_back(std::move(read)).value;
    if (!object.members.back().hasValue) {
      out.type = Type::absent;
      out.begin = out.end = object.members.back().end;
      return;
    }
    const std::size_t behind = ++at_;
    blank();
    value(out);
    if (out.is(Type::absent)) out.begin = static_cast<std::uint32_t>(behind);
  }

  // Null for a key that is new.
  static const JsonMember* findKey(const JsonValue& object, const std::string& key,
                                   std::unordered_map<std::string, std::size_t>& keys) {
    const std::vector<JsonMember>& members = object.members;
    if (members.size() < kManyKeys) {
      const auto found = std::ranges::find(members, key, &JsonMember::key);
      return found == members.end() ? nullptr : &*found;
    }
    for (std::size_t i = keys.size(); i < members.size(); ++i) keys.emplace(members[i].key, i);
    const auto found = keys.find(key);
    return found == keys.end() ? nullptr : &members[found->second];
  }

  // A string, a number or a word.
  void scalar(JsonValue& out) {
    if (now() == '"') {
      out.type = Type::string;
      return string(out.text, out.closed);
    }
    const std::size_t begin = at_, end = endOfWord(begin);
    if (isDigit(now()) || now() == '-') {
      number(out);
    } else {
      while (isIdentChar(now())) ++at_;
      const std::string_view word = text_.substr(begin, at_ - begin);
      out.flag = word == "true";
      out.type = out.flag || word == "false" ? Type::boolean : word == "null" ? Type::null : Type::broken;
    }
    if (failed_) return;
    if (at_ != end) out.type = Type::broken;
    if (end == begin) out.type = Type::absent;
    at_ = end;
    if (out.is(Type::broken) || out.is(Type::absent))
      fail(say::notJsonValue, begin, text_.substr(begin, std::max<std::size_t>(end - begin, 1)));
  }

  void number(JsonValue& out) {
    const std::string_view word = text_.substr(at_, endOfWord(at_) - at_),
                           digits = word.substr(now() == '-' ? 1 : 0);
    const std::size_t point = word.find('.');
    const auto isDigitAt = [](std::string_view of, std::size_t at) {
      return at < of.size() && isDigit(of[at]);
    };
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out.number);
    // What JSON does not have: "-inf", "007", "1." and "1.e3".
    const bool good = end == word.data() + word.size() && isDigitAt(digits, 0) &&
                      !(digits[0] == '0' && isDigitAt(digits, 1)) &&
                      (point == word.npos || isDigitAt(word, point + 1));
    out.whole = word.find_first_of(".eE") == word.npos;
    out.type = good ? Type::number : Type::broken;
    out.number += 0.0;  // no -0
    const std::size_t begin = at_;
    at_ += word.size();
    if (good && error != std::errc()) fail(say::numberTooLarge, begin, word);
  }

  void string(std::string& out, bool& closed) {
    const std::size_t begin = at_++;
    bool escapes = false;
    for (;;) {
      while (!ends() && isPlain(text_[at_])) ++at_;
      if (ends() || isOneOf(now(), "\"\r\n")) break;
      const Character c = firstCharacterOf(text_.substr(at_));
      if (!c.good) fail(say::notUtf8, at_, c.value);
      if (c.value < ' ') fail(say::controlCharacter, at_);
      const bool escape = now() == '\\';
      escapes = escapes || escape;
      at_ = std::min(at_ + c.bytes, text_.size());
      if (escape && isOneOf(now(), "\"\\")) ++at_;
    }
    closed = now() == '"';
    out = text_.substr(begin + 1, at_ - begin - 1);
    if (closed) ++at_;
    if (!closed)
      fail(say::openString, begin);
    else if (escapes)
      resolve(out, begin);
  }

  void resolve(std::string& out, std::size_t begin) {
    try {
      out = nlohmann::ordered_json::parse(text_.substr(begin, at_ - begin)).get<std::string>();
    } catch (const nlohmann::ordered_json::parse_error& error) {
      fail(say::unknownEscape, text_.rfind('\\', begin + error.byte - 1));
    }
  }

  const std::string_view text_;
  const FileName file_;
  Diagnostics* const diagnostics_;  // null: mistakes are passed over
  std::vector<ByteRange>* const comments_;
  // Behind a byte order mark.
  const std::size_t first_ = text_.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  std::size_t at_ = first_;
  std::uint32_t line_ = 1;  // of the last place
  std::size_t lineStart_ = 0, lineEnd_ = 0;
  bool failed_ = false;
  std::vector<std::size_t> open_;  // brackets around at_
  std::uint64_t count_ = 0;
};

// valueAt(), and the pointer to there.
const JsonValue& descend(const JsonValue& value, std::size_t at, std::string* pointer) {
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    if (at < value.items[i].begin || at >= value.items[i].end) continue;
    if (pointer) *pointer += fmt::format("/{}", i);
    return descend(value.items[i], at, pointer);
  }
  for (const JsonMember& member : value.members) {
    if (at < member.begin || at >= member.value.end) continue;
    if (pointer) *pointer += '/';
    for (const char c : pointer ? member.key : std::string())
      *pointer += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return descend(member.value, at, pointer);
  }
  return value;
}

}  // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
  for (const JsonMember& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}

std::size_t JsonTree::behindComment(std::size_t at) const {
  const auto found = std::ranges::lower_bound(comments, at, {}, &ByteRange::begin);
  return found != comments.end() && found->begin == at ? found->end : at;
}

JsonTree parseJsonTree(std::string_view text) {
  JsonTree tree;
  Parser(text, {}, nullptr, &tree.comments).run(tree.root);
  return tree;
}

std::optional<JsonValue> parseJson(std::string_view text, FileName file, Diagnostics& diagnostics) {
  const std::size_t mark = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  if (text.size() - mark > raised(kMaxTextBytes)) {
    reportTooLarge({file, 0, 0}, text.size() - mark, diagnostics);
    return std::nullopt;
  }
  std::optional<JsonValue> root(std::in_place);
  if (!Parser(text, file, &diagnostics, nullptr).run(*root)) root.reset();
  return root;
}

std::size_t offsetOf(std::string_view text, const Place& place) {
  std::size_t at = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  for (std::uint32_t line = 1; line < place.line && at < text.size(); ++line)
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  return std::min(at + (place.column > 0 ? place.column - 1 : 0), text.size());
}

const JsonValue& valueAt(const JsonValue& root, std::size_t at) {
  return descend(root, at, nullptr);
}

std::string pointerAt(const JsonValue& root, std::size_t at) {
  std::string pointer;
  descend(root, at, &pointer);
  return pointer;
}

const char* nameOf(JsonValue::Type type) {
  static constexpr const char* kNames[] = {"null",     "a boolean", "a number", "a string",
                                           "an array", "an object", "no value", "nothing"};
  return kNames[static_cast<int>(type)];
}

std::string describe(const JsonValue& value) {
  if (value.is(Type::boolean)) return value.flag ? "true" : "false";
  if (value.is(Type::number)) return fmt::format("the number {}", value.number);
  if (value.is(Type::array)) return fmt::format("an array of length {}", value.items.size());
  return value.is(Type::string) ? fmt::format("the string \"{}\"", shortened(value.text))
                                : nameOf(value.type);
}

}  // namespace weft::text
