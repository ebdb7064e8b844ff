#include "engine/base/json/dom.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "engine/base/chars.h"
#include "engine/base/files/text_file.h"
#include "engine/base/json/errors.h"
#include "engine/base/limit_report.h"

namespace weft::base {

namespace {

// The input adapter: nlohmann's lexer pulls single characters through it, and it counts them. The lexer is
// never ahead of the token it reports, except by the one character that ended a number.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t* consumed) : at_(at), consumed_(consumed) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*consumed_;
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at_ == b.at_; }
  friend bool operator!=(const CountingIterator& a, const CountingIterator& b) { return a.at_ != b.at_; }

 private:
  const char* at_;
  std::size_t* consumed_;
};

constexpr bool isNumberChar(char c) {
  return isDigit(c) || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
}

// Receives nlohmann's events and builds the tree. Every handler returns false to stop after an error was
// reported.
class Builder {
 public:
  Builder(const JsonText& text, const std::string* file, const std::size_t& consumed,
          Diagnostics& diagnostics)
      : text_(text),
        consumed_(consumed),
        diagnostics_(diagnostics),
        mostValues_(limitFor(Limit::json_values, file)),
        mostOfName_(limitFor(Limit::name_bytes, file)) {}

  JsonValue takeRoot() { return std::move(root_); }

  bool null() { return add(JsonValue::Type::null, consumed_ - 4) != nullptr; }
  bool boolean(bool flag) {
    JsonValue* value = add(JsonValue::Type::boolean, consumed_ - (flag ? 4 : 5));
    if (!value) return false;
    value->flag = flag;
    return true;
  }
  bool number_integer(std::int64_t number) { return addNumber(static_cast<double>(number), true); }
  bool number_unsigned(std::uint64_t number) { return addNumber(static_cast<double>(number), true); }
  bool number_float(double number, const std::string& written) {
    return addNumber(number, written.find_first_of(".eE") == std::string::npos);
  }
  bool string(std::string& text) {
    JsonValue* value = add(JsonValue::Type::string, text_.startOfString(consumed_));
    if (!value) return false;
    value->text = text;  // a copy as long as the text: the lexer's own has room for the longest so far
    return true;
  }
  bool binary(std::vector<std::uint8_t>&) { return false; }
  bool key(std::string& key) {
    key_ = key;
    keyOffset_ = text_.startOfString(consumed_);
    if (key_.size() <= mostOfName_) return true;
    reportLimit(diagnostics_, Limit::name_bytes, text_.placeOf(keyOffset_), "a key is too long").found =
        fmt::format("{} bytes", key_.size());
    return false;
  }
  bool start_object(std::size_t) { return open(JsonValue::Type::object); }
  bool start_array(std::size_t) { return open(JsonValue::Type::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception& exception) {
    std::optional<JsonOpening> inside;
    if (!open_.empty()) inside = {open_.back()->is(JsonValue::Type::object), open_.back()->place};
    reportJsonError(text_, consumed_, token, exception.what(), inside, key_, diagnostics_);
    return false;
  }

 private:
  bool addNumber(double number, bool whole) {
    std::size_t start = consumed_;
    if (start > 0 && !isDigit(text_.at(start - 1))) --start;  // the character that ended it
    while (start > 0 && isNumberChar(text_.at(start - 1))) --start;
    JsonValue* value = add(JsonValue::Type::number, start);
    if (!value) return false;
    value->number = number;
    value->whole = whole;
    return true;
  }

  // The new value, at its place in the tree; a dropped duplicate is built all the same, aside. Null after a
  // report.
  JsonValue* add(JsonValue::Type type, std::size_t offset) {
    if (++count_ > mostValues_) {
      reportLimit(diagnostics_, Limit::json_values, text_.placeOf(offset), "the file has too many values");
      return nullptr;
    }
    JsonValue* value = &root_;
    if (!open_.empty()) {
      JsonValue& parent = *open_.back();
      if (parent.is(JsonValue::Type::array)) {
        value = &parent.items.emplace_back();
        value->pointer = {containers_.back(), containers_.back()->add()};
      } else {
        value = addMember(parent);
      }
    }
    value->type = type;
    value->place = text_.placeOf(offset);
    return value;
  }

  JsonValue* addMember(JsonValue& object) {
    const Place place = text_.placeOf(keyOffset_);
    const JsonPointer pointer(containers_.back(), containers_.back()->add(key_));
    const auto [before, fresh] = keys_.back().try_emplace(key_, place);
    if (!fresh) {
      auto& d = diagnostics_.error(Code::duplicateKey, place,
                                   fmt::format("the key \"{}\" appears twice in one object", key_));
      d.pointer = pointer;
      d.hint =
          fmt::format("remove one; the first stands at {}:{}", before->second.line, before->second.column);
      dropped_.push_back(std::make_unique<JsonValue>());
      return dropped_.back().get();
    }
    JsonMember& member = object.members.emplace_back();
    member.key = key_;
    member.place = place;
    member.value.pointer = pointer;
    return &member.value;
  }

  bool open(JsonValue::Type type) {
    const std::size_t offset = consumed_ - 1;
    if (open_.size() >= kMaxJsonDepth) {
      diagnostics_
          .error(Code::nestedTooDeeply, text_.placeOf(offset),
                 fmt::format("objects and arrays are nested more than {} levels deep", kMaxJsonDepth))
          .hint = "look for a bracket that is never closed";
      return false;
    }
    JsonValue* value = add(type, offset);
    if (!value) return false;
    open_.push_back(value);
    keys_.emplace_back();
    containers_.push_back(
        std::make_shared<JsonPointer::Container>(value->pointer, type == JsonValue::Type::object));
    return true;
  }

  bool close() {
    // Large ones keep no room for more: it would be a quarter of the memory of a large file.
    JsonValue& closed = *open_.back();
    if (closed.members.size() > 64) closed.members.shrink_to_fit();
    if (closed.items.size() > 64) closed.items.shrink_to_fit();
    open_.pop_back();
    keys_.pop_back();
    containers_.pop_back();
    return true;
  }

  const JsonText& text_;
  const std::size_t& consumed_;
  Diagnostics& diagnostics_;
  const std::uint64_t mostValues_, mostOfName_;
  JsonValue root_;
  std::vector<JsonValue*>
      open_;  // ancestors; each is the last child of the one before, so none of them moves
  std::vector<std::unordered_map<std::string, Place>> keys_;  // parallel to open_: where each key first stood
  std::vector<std::shared_ptr<JsonPointer::Container>> containers_;  // parallel to open_
  std::vector<std::unique_ptr<JsonValue>> dropped_;
  std::string key_;
  std::size_t keyOffset_ = 0;
  std::size_t count_ = 0;
};

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

std::optional<JsonValue> parseJson(std::string_view text, const std::shared_ptr<const std::string>& file,
                                   Diagnostics& diagnostics) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  if (text.size() > limitFor(Limit::json_bytes, file.get())) {
    reportTooLarge({file, 0, 0}, text.size(), diagnostics);
    return std::nullopt;
  }
  const JsonText positions(text, file);
  if (!reportUnreadable(positions, diagnostics)) return std::nullopt;
  std::size_t consumed = 0;
  Builder builder(positions, file.get(), consumed, diagnostics);
  const bool good = nlohmann::json::sax_parse(CountingIterator(text.data(), &consumed),
                                              CountingIterator(text.data() + text.size(), &consumed),
                                              &builder, nlohmann::json::input_format_t::json, true, true);
  if (!good) return std::nullopt;
  return builder.takeRoot();
}

const char* nameOf(JsonValue::Type type) {
  static constexpr const char* kNames[] = {"null",     "a boolean", "a number",
                                           "a string", "an array",  "an object"};
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

}  // namespace weft::base
