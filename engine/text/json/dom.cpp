#include "engine/text/json/dom.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <unordered_map>

#include "engine/text/characters.h"
#include "engine/text/chars.h"
#include "engine/text/files/text_file.h"
#include "engine/text/limits.h"

namespace weft::text {

namespace {

using Type = JsonValue::Type;

// From so many keys on they are found by a table.
constexpr std::size_t kManyKeys = 24;

// Characters that stand for themselves in a string: ASCII but for control characters, quotes and backslashes.
constexpr bool isPlain(char c) {
  return c >= ' ' && c != '"' && c != '\\';
}

void appendUtf8(std::uint32_t value, std::string& out) {
  const auto add = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  const auto rest = [&](int shift) { add(0x80 | (value >> shift & 0x3F)); };
  if (value < 0x80) return add(value);
  if (value < 0x800) {
    add(0xC0 | value >> 6);
  } else if (value < 0x10000) {
    add(0xE0 | value >> 12);
    rest(6);
  } else {
    add(0xF0 | value >> 18);
    rest(12);
    rest(6);
  }
  rest(0);
}

// Finite, or infinite where the number is too large for a double.
double numberOf(std::string_view written) {
  double number = 0;
  const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), number);
  if (error != std::errc::result_out_of_range) return number + 0.0;  // no -0
  const std::size_t exponent = written.find_first_of("eE");
  const bool small = exponent != std::string_view::npos && written.substr(exponent + 1).starts_with('-');
  return small ? 0 : std::numeric_limits<double>::infinity();
}

// Reads a text by recursive descent. With diagnostics it stops at the first mistake of grammar and reports it; without it
// recovers, and passes over what it does not understand.
class Parser {
 public:
  Parser(std::string_view text, std::shared_ptr<const std::string> file, Diagnostics* diagnostics,
         std::vector<ByteRange>* comments)
      : text_(text),
        file_(std::move(file)),
        diagnostics_(diagnostics),
        comments_(comments),
        first_(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0),
        at_(first_),
        lineStart_(first_) {}

  // False when it stopped.
  bool run(JsonValue& root) {
    if (!tolerant() && !isText()) return false;
    blank();
    if (!stopped_) value(root);
    if (!stopped_) blank();
    if (!stopped_ && !ends()) unexpected(Wanted::end);
    return !stopped_;
  }

 private:
  // What the grammar wants where something else stands.
  enum class Wanted : std::uint8_t { value, key, colon, comma, end };

  bool tolerant() const { return !diagnostics_; }
  bool ends() const { return at_ >= text_.size(); }
  char now() const { return ends() ? '\0' : text_[at_]; }
  char before(std::size_t at) const { return at > 0 ? text_[at - 1] : '\0'; }

  // Of a byte in the line that is being read.
  Place placeHere(std::size_t at) const {
    if (tolerant()) return {};
    return {file_, line_, static_cast<std::uint32_t>(at - lineStart_ + 1)};
  }
  Place placeOf(std::size_t at) const {
    const std::string_view front = text_.substr(first_, at - first_);
    const std::size_t end = front.rfind('\n');
    return {file_, static_cast<std::uint32_t>(std::ranges::count(front, '\n')) + 1,
            static_cast<std::uint32_t>(front.size() - (end == std::string_view::npos ? 0 : end + 1) + 1)};
  }

  // ---- reports ----

  // Reports the first mistake of grammar, and stops.
  void stop(std::size_t at, std::string message, std::string hint, std::string expected = {}) {
    auto& d = diagnostics_->error(Code::notJson, placeOf(at), std::move(message));
    d.hint = std::move(hint);
    d.expected = std::move(expected);
    stopped_ = true;
  }

  std::string printed(std::size_t from, std::size_t to) const {
    std::string out(text_.substr(from, to - from));
    for (char& c : out)
      if (c < ' ' || c == '\x7F') c = '?';
    return out;
  }

  // The word or number that begins at `at`; a single character when it is neither.
  std::string wordAt(std::size_t at) const {
    std::size_t end = at;
    while (end < text_.size() && (isIdentChar(text_[end]) || isOneOf(text_[end], ".-+"))) ++end;
    return printed(at, std::max(end, std::min(at + 1, text_.size())));
  }

  static bool isOneOf(char c, std::string_view all) { return all.find(c) != std::string_view::npos; }

  // False after a report of a text that is none.
  bool isText() {
    const std::string_view all = text_.substr(first_);
    if (std::ranges::all_of(all, isSpace))
      stop(first_, "the file is empty", "", "an object: { … }");
    else if (const std::size_t zero = text_.find('\0'); zero != std::string_view::npos)
      stop(zero, "a zero byte: this is no text, or not in UTF-8", "name a JSON file, or save it as UTF-8");
    return !stopped_;
  }

  bool isObject() const { return text_[open_.back()] == '{'; }
  std::string placeOfOpening() const {
    const Place place = placeOf(open_.back());
    return fmt::format("{}:{}", place.line, place.column);
  }

  // Reports what stands at at_ where something else is wanted.
  void unexpected(Wanted wanted) {
    if (tolerant()) return;
    if (ends()) return stopAtEnd();
    const std::size_t begin = at_;
    if (isOneOf(now(), "{}[],:")) {
      ++at_;
    } else {
      JsonValue token;
      scalar(token, wanted == Wanted::key);
      if (stopped_) return;
    }
    const std::string found = printed(begin, at_);
    const bool closing = found == "}" || found == "]";
    switch (wanted) {
      case Wanted::end:
        return stop(begin, fmt::format("'{}' follows the end of the document", found),
                    closing ? "one bracket too many closes here or before" : "a file holds one object",
                    "the end of the file");
      case Wanted::key:
        return stop(begin, fmt::format("'{}' where a key is expected", found),
                    found == "}" ? "remove the comma before it" : "keys are strings in double quotes",
                    "a key in double quotes");
      case Wanted::colon:
        return stop(begin, fmt::format("'{}' follows the key \"{}\"", found, *key_),
                    "write ':' between a key and its value", "':'");
      case Wanted::comma:
        return stop(
            begin,
            fmt::format("'{}' follows a value of the {} that opens at {}", found,
                        isObject() ? "object" : "array", placeOfOpening()),
            closing || found == ":" ? "a bracket or a comma is missing before it" : "put a comma before it",
            isObject() ? "',' or '}'" : "',' or ']'");
      case Wanted::value:
        return stop(begin, fmt::format("'{}' where a value is expected", found),
                    closing ? "remove the comma before it, or add a value" : "", "a value");
    }
  }

  void stopAtEnd() {
    std::size_t end = text_.size();
    while (end > first_ && isSpace(text_[end - 1])) --end;
    if (open_.empty())
      return stop(end, "the file holds no value", "a document is one object: { … }", "an object");
    stop(end,
         fmt::format("the file ends inside the {} that opens at {}", isObject() ? "object" : "array",
                     placeOfOpening()),
         fmt::format("close it with '{}'", isObject() ? '}' : ']'));
  }

  // Reports the word or character at `at`, which no value begins with.
  void stopAtWord(std::size_t at, bool asKey) {
    if (isIdentChar(text_[at]))
      while (isIdentChar(before(at))) --at;
    const std::string_view rest = text_.substr(at);
    const std::string found = wordAt(at);
    if (at > 0 && at == stringEnd_)
      return stop(stringBegin_,
                  fmt::format("the string '{}' ends before '{}'", printed(stringBegin_, at), found),
                  "a '\"' is missing in it, or one is too many");
    if (static_cast<unsigned char>(text_[at]) >= 0x80)
      return stop(at, describeStray(rest), "outside of strings a graph is plain ASCII, in a file in UTF-8");
    if (asKey && isIdentStart(found[0]))
      return stop(at, fmt::format("the key '{}' has no quotes", found), fmt::format("write \"{}\"", found),
                  "a key in double quotes");
    std::string hint = "values are numbers, true, false, null, \"strings\", [arrays] and {objects}";
    if (found == "'") hint = "strings stand in double quotes";
    if (found[0] == '#') hint = "comments are // to the end of the line and /* … */";
    stop(at, fmt::format("'{}' is not a JSON value", found), hint);
  }

  // ---- white space and comments ----

  void blank() {
    while (!ends()) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
        lineStart_ = ++at_;
      } else if (isSpace(c)) {
        ++at_;
      } else if (c != '/' || !comment()) {
        return;
      }
    }
  }

  bool comment() {
    const std::size_t begin = at_;
    const char kind = begin + 1 < text_.size() ? text_[begin + 1] : '\0';
    if (kind != '/' && kind != '*') {
      if (!tolerant())
        stop(begin, "a '/' that begins no comment", "comments are // to the end of the line and /* … */");
      return false;
    }
    std::size_t end = kind == '*' ? text_.find("*/", begin + 2) : text_.find_first_of("\r\n", begin);
    if (kind == '*' && end != std::string_view::npos) {
      end += 2;
    } else if (kind == '*') {
      if (!tolerant()) {
        stop(begin, "the comment that opens here is never closed",
             "comments are // to the end of the line and /* … */");
        return false;
      }
      end = text_.find('\n', begin);
    }
    at_ = std::min(end, text_.size());
    for (std::size_t i = begin; i < at_; ++i)
      if (text_[i] == '\n') {
        ++line_;
        lineStart_ = i + 1;
      }
    if (comments_) comments_->push_back({begin, at_});
    return true;
  }

  // ---- values ----

  void value(JsonValue& out) {
    const char c = now();
    if (ends() || isOneOf(c, "}],:")) {
      out.type = Type::absent;
      out.begin = out.end = static_cast<std::uint32_t>(at_);
      return unexpected(Wanted::value);
    }
    out.place = placeHere(at_);
    out.begin = static_cast<std::uint32_t>(at_);
    const bool container = c == '{' || c == '[';
    if (container && open_.size() >= kMaxJsonDepth) {
      stopped_ = !tolerant();
      out.type = Type::absent;
      if (stopped_)
        diagnostics_
            ->error(Code::nestedTooDeeply, out.place,
                    fmt::format("objects and arrays are nested more than {} levels deep", kMaxJsonDepth))
            .hint = "look for a bracket that is never closed";
    } else if (++count_ > raised(kMaxValues) && !tolerant()) {
      stopped_ = true;
      reportLimit(*diagnostics_, out.place, "the file has too many values", kMaxValues, "values");
    } else if (container) {
      members(out);
    } else {
      scalar(out, false);
    }
    out.end = static_cast<std::uint32_t>(at_);
  }

  void members(JsonValue& out) {
    const bool object = now() == '{';
    out.type = object ? Type::object : Type::array;
    out.closed = false;
    open_.push_back(at_++);
    std::unordered_map<std::string, std::size_t> keys;
    const Wanted element = object ? Wanted::key : Wanted::value;
    bool first = true, comma = true;  // whether an element may stand here
    for (;;) {
      blank();
      if (ends() && !stopped_) unexpected(element);
      if (stopped_ || ends()) break;
      if (now() == '}' || now() == ']') {
        // A bracket of the other kind closes a container further out; this one was left open.
        out.closed = (now() == '}') == object;
        if (!out.closed || (comma && !first)) unexpected(comma ? element : Wanted::comma);
        if (out.closed && !stopped_) ++at_;
        break;
      }
      if (!comma) unexpected(Wanted::comma);
      const std::size_t begin = at_;
      if (!stopped_) object ? member(out, keys) : item(out);
      if (!stopped_) blank();
      if (stopped_) break;
      comma = now() == ',';
      if (comma || at_ == begin) ++at_;  // a byte that cannot stand here is passed over
      first = false;
    }
    open_.pop_back();
    // Large ones keep no room for more: it would be a quarter of the memory of a large file.
    if (out.members.size() > 64) out.members.shrink_to_fit();
    if (out.items.size() > 64) out.items.shrink_to_fit();
  }

  void item(JsonValue& array) { value(array.items.emplace_back()); }

  void member(JsonValue& object, std::unordered_map<std::string, std::size_t>& keys) {
    JsonValue dropped;
    if (now() != '"') {
      unexpected(Wanted::key);
      return stopped_ ? void() : value(dropped);
    }
    JsonMember read;
    read.place = placeHere(at_);
    read.begin = static_cast<std::uint32_t>(at_);
    string(read.key, read.closed);
    read.end = static_cast<std::uint32_t>(at_);
    if (!stopped_ && !tolerant() && read.key.size() > kMaxNameBytes) {
      stopped_ = true;
      auto& d = diagnostics_->error(Code::limitExceeded, read.place, "a key is too long");
      d.expected = fmt::format("at most {} bytes", kMaxNameBytes);
      d.found = fmt::format("{} bytes", read.key.size());
    }
    if (!stopped_) blank();
    if (stopped_) return;
    read.hasValue = now() == ':';
    if (!read.hasValue) {
      key_ = &read.key;
      unexpected(Wanted::colon);
      if (stopped_) return;
    }
    if (!tolerant()) {
      if (const JsonMember* before = findKey(object, read.key, keys)) {
        auto& d = diagnostics_->error(Code::duplicateKey, read.place,
                                      fmt::format("the key \"{}\" appears twice in one object", read.key));
        d.hint =
            fmt::format("remove one; the first stands at {}:{}", before->place.line, before->place.column);
        ++at_;
        blank();
        return stopped_ ? void() : value(dropped);
      }
    }
    JsonValue& out = object.members.emplace_back(std::move(read)).value;
    if (!object.members.back().hasValue) {
      out.type = Type::absent;
      out.begin = out.end = object.members.back().end;
      return;
    }
    const std::size_t behind = ++at_;
    blank();
    if (stopped_) return;
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
  void scalar(JsonValue& out, bool asKey) {
    if (now() == '"') {
      out.type = Type::string;
      return string(out.text, out.closed);
    }
    const std::size_t begin = at_;
    std::size_t end = begin;  // of all that stands together here
    while (end < text_.size() && !isSpace(text_[end]) && !isOneOf(text_[end], ",:]}[{\"/")) ++end;
    if (isDigit(now()) || now() == '-') {
      number(out);
    } else {
      while (isIdentChar(now())) ++at_;
      const std::string_view word = text_.substr(begin, at_ - begin);
      out.flag = word == "true";
      out.type = out.flag || word == "false" ? Type::boolean : word == "null" ? Type::null : Type::broken;
      if (out.is(Type::broken) && !tolerant()) return stopAtWord(begin, asKey);
    }
    if (!tolerant() || (at_ == end && at_ > begin)) return;
    out.type = end == begin ? Type::absent : Type::broken;
    at_ = end;
  }

  void number(JsonValue& out) {
    const std::size_t begin = at_;
    const auto digits = [&] {
      const std::size_t from = at_;
      while (isDigit(now())) ++at_;
      return at_ > from;
    };
    if (now() == '-') ++at_;
    bool good = true;
    if (now() == '0')
      ++at_;
    else
      good = digits();
    out.whole = true;
    if (good && now() == '.') {
      ++at_;
      out.whole = false;
      good = digits();
    }
    if (good && (now() == 'e' || now() == 'E')) {
      ++at_;
      out.whole = false;
      if (now() == '+' || now() == '-') ++at_;
      good = digits();
    }
    out.type = good ? Type::number : Type::broken;
    const std::string_view written = text_.substr(begin, at_ - begin);
    if (good) out.number = numberOf(written);
    if (tolerant()) return;
    if (!good)
      stop(begin, fmt::format("'{}' is not a number", wordAt(begin)),
           "digits are needed before and after the point, and after 'e'");
    else if (out.number > std::numeric_limits<double>::max() ||
             out.number < std::numeric_limits<double>::lowest())
      stop(begin, fmt::format("the number {} is too large", written), "the largest is about 1.8e308");
  }

  void string(std::string& out, bool& closed) {
    stringBegin_ = at_++;
    closed = false;
    for (;;) {
      const std::size_t run = at_;
      while (at_ < text_.size() && isPlain(text_[at_])) ++at_;
      out.append(text_, run, at_ - run);
      if (ends()) {
        if (!tolerant())
          stop(stringBegin_, "the string that opens here is never closed", "close it with '\"'");
        return;
      }
      const char c = text_[at_];
      if (c == '"') {
        closed = true;
        stringEnd_ = ++at_;
        return;
      }
      if (c == '\n' || c == '\r') {
        if (!tolerant())
          stop(stringBegin_, "the string that opens here is not closed on its line",
               "close it with '\"'; a line break inside a string is written \\n");
        return;
      }
      if (c == '\\')
        escape(out);
      else
        otherCharacter(out);
      if (stopped_) return;
    }
  }

  // Beyond ASCII, or a control character.
  void otherCharacter(std::string& out) {
    const Character c = firstCharacterOf(text_.substr(at_));
    if (!tolerant() && !c.good)
      return stop(at_, fmt::format("the byte 0x{:02X} is not UTF-8", c.value), "save the file as UTF-8");
    if (!tolerant() && c.value < ' ')
      return stop(at_, fmt::format("a control character (U+{:04X}) inside a string", c.value),
                  c.value == '\t' ? "write a tab as \\t" : fmt::format("write it as \\u{:04x}", c.value));
    out.append(text_, at_, c.bytes);
    at_ += c.bytes;
  }

  void escape(std::string& out) {
    constexpr std::string_view kLetters = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
    const std::size_t begin = at_++;
    if (ends()) return;
    if (const std::size_t letter = kLetters.find(now()); letter != std::string_view::npos) {
      out += kMeanings[letter];
      ++at_;
    } else if (now() == 'u') {
      ++at_;
      std::uint32_t unit = hexDigits();
      if (stopped_) return;
      if (unit >= 0xD800 && unit < 0xDC00 && text_.substr(at_, 2) == "\\u") {
        at_ += 2;
        const std::uint32_t low = hexDigits();
        if (stopped_) return;
        unit = low >= 0xDC00 && low < 0xE000 ? 0x10000 + ((unit - 0xD800) << 10) + (low - 0xDC00) : unit;
      }
      if (!tolerant() && unit >= 0xD800 && unit < 0xE000)
        return stop(begin, "half of a surrogate pair in a string",
                    "write the character itself instead of \\u…");
      appendUtf8(unit, out);
    } else if (!tolerant()) {
      stop(begin, fmt::format("unknown escape '{}' in a string", printed(begin, begin + 2)),
           "write '/' in paths, '\\\\' for a backslash; others are \\\" \\n \\r \\t \\b \\f \\/ \\uXXXX");
    }
  }

  std::uint32_t hexDigits() {
    std::uint32_t value = 0;
    const std::string_view four = text_.substr(at_, 4);
    const auto [end, error] = std::from_chars(four.data(), four.data() + four.size(), value, 16);
    const auto read = static_cast<std::size_t>(end - four.data());
    if (read < 4 && !tolerant())
      stop(std::min(at_ + read, text_.size() - 1), "'\\u' needs four hexadecimal digits",
           "write it as \\u00e9, or the character itself");
    at_ += read;
    return value;
  }

  const std::string_view text_;
  const std::shared_ptr<const std::string> file_;
  Diagnostics* const diagnostics_;  // null: tolerant
  std::vector<ByteRange>* const comments_;
  const std::size_t first_;  // behind a byte order mark
  std::size_t at_, lineStart_;
  std::uint32_t line_ = 1;
  bool stopped_ = false;                         // after a report
  std::vector<std::size_t> open_;                // brackets around at_
  const std::string* key_ = nullptr;             // that has no colon
  std::size_t stringBegin_ = 0, stringEnd_ = 0;  // of the last string
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

Place JsonValue::textPlace() const {
  Place inner = place;
  ++inner.column;
  return inner;
}

std::size_t JsonTree::behindComment(std::size_t at) const {
  const auto found = std::ranges::lower_bound(comments, at, {}, &ByteRange::begin);
  return found != comments.end() && found->begin == at ? found->end : at;
}

JsonTree parseJsonTree(std::string_view text) {
  JsonTree tree;
  Parser(text, nullptr, nullptr, &tree.comments).run(tree.root);
  return tree;
}

std::optional<JsonValue> parseJson(std::string_view text, const std::shared_ptr<const std::string>& file,
                                   Diagnostics& diagnostics) {
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

PointerScope::~PointerScope() {
  const auto isHere = [&](const Diagnostic& d) {
    return d.pointer.empty() && d.place.line > 0 && d.place.file && *d.place.file == file_;
  };
  if (std::ranges::none_of(diagnostics_.items(), isHere)) return;
  const JsonTree tree = parseJsonTree(text_);
  Diagnostics located;
  for (Diagnostic d : diagnostics_.items()) {
    if (isHere(d)) d.pointer = pointerAt(tree.root, offsetOf(text_, d.place.inFile()));
    located.add(std::move(d));
  }
  diagnostics_ = std::move(located);
}

const char* nameOf(JsonValue::Type type) {
  static constexpr const char* kNames[] = {"null",     "a boolean", "a number", "a string",
                                           "an array", "an object", "no value", "nothing"};
  return kNames[static_cast<int>(type)];
}

std::string describe(const JsonValue& value) {
  switch (value.type) {
    case JsonValue::Type::boolean:
      return value.flag ? "true" : "false";
    case JsonValue::Type::number:
      return fmt::format("the number {}", value.number);
    case JsonValue::Type::string: {
      constexpr std::size_t kMost = 60;
      if (value.text.size() <= kMost) return fmt::format("the string \"{}\"", value.text);
      std::size_t end = kMost;  // not inside a UTF-8 sequence
      while (end > 0 && (static_cast<unsigned char>(value.text[end]) & 0xC0) == 0x80) --end;
      return fmt::format("the string \"{}…\"", std::string_view(value.text).substr(0, end));
    }
    default:
      return nameOf(value.type);
  }
}

}  // namespace weft::text
