#include "engine/base/json/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "engine/base/chars.h"

namespace weft::base {

namespace {

// A text without mistakes, as a tree.
class Edited {
 public:
  explicit Edited(std::string_view text) : text_(text), tree_(parseJsonTree(text)) {
    Diagnostics said;
    good_ = parseJson(text, nullptr, said) && !said.hasErrors();
  }
  const JsonValue* find(std::string_view pointer) const {
    return good_ ? findPointer(tree_.root, pointer) : nullptr;
  }
  std::string putBehind(const std::vector<ByteRange>& elements, std::size_t index,
                        const std::string& added) const;

 private:
  // Behind white space and comments.
  std::size_t skipBlank(std::size_t at) const {
    for (;;) {
      const std::size_t end = tree_.behindComment(at);
      if (end == at && (at >= text_.size() || !isSpace(text_[at]))) return at;
      at = std::max(end, at + 1);
    }
  }
  std::size_t restOfLine(std::size_t at) const;

  const std::string_view text_;
  const JsonTree tree_;
  bool good_ = false;
};

// Where the line of `at` begins, and its white space ends.
std::size_t lineOf(std::string_view text, std::size_t at) {
  const std::size_t before = text.rfind('\n', at == 0 ? 0 : at - 1);
  return before == std::string_view::npos || before >= at ? 0 : before + 1;
}
std::string_view indentOf(std::string_view text, std::size_t at) {
  std::size_t begin = lineOf(text, at);
  if (begin == 0 && text.starts_with(kByteOrderMark)) begin = kByteOrderMark.size();
  std::size_t end = begin;
  while (end < text.size() && (text[end] == ' ' || text[end] == '\t')) ++end;
  return text.substr(begin, end - begin);
}
bool beginsLine(std::string_view text, std::size_t at) {
  return lineOf(text, at) != 0 && lineOf(text, at) + indentOf(text, at).size() == at;
}

// From `at` only blanks and comments until the line ends: that end (before "\r\n" or "\n"), else `at`.
std::size_t Edited::restOfLine(std::size_t at) const {
  std::size_t end = at;
  while (end < text_.size() && text_[end] != '\n') {
    const std::size_t comment = tree_.behindComment(end);
    if (comment == end && !isSpace(text_[end])) return at;
    if (text_.substr(end, comment - end).find('\n') != std::string_view::npos) return at;
    end = std::max(comment, end + 1);
  }
  if (end == text_.size()) return at;
  return end > at && text_[end - 1] == '\r' ? end - 1 : end;
}

// Puts `added` behind element `index` of the elements of a container (of which there is one at least).
std::string Edited::putBehind(const std::vector<ByteRange>& elements, std::size_t index,
                              const std::string& added) const {
  const std::string_view text = text_;
  const auto ownLine = [&](const ByteRange& e) { return beginsLine(text, e.begin); };
  const bool lines = std::all_of(elements.begin(), elements.end(), ownLine);
  const ByteRange& before = elements[index];
  const bool last = index + 1 == elements.size();
  std::string out(text);
  if (!lines) {
    out.insert(before.end, ", " + added);
    return out;
  }
  const std::string newline = text.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
  const std::string line = newline + std::string(indentOf(text, before.begin)) + added;
  // A comment behind the element stays with it.
  const std::size_t comma = last ? before.end : skipBlank(before.end) + 1;
  const std::size_t end = restOfLine(comma);
  if (end == comma && text[end] != '\n' && text[end] != '\r') {
    out.insert(before.end, "," + line);
  } else {
    out.insert(end, last ? line : line + ",");
    if (last) out.insert(before.end, ",");
  }
  return out;
}

}  // namespace

const JsonValue* findPointer(const JsonValue& root, std::string_view pointer) {
  const JsonValue* at = &root;
  while (at && !pointer.empty()) {
    pointer.remove_prefix(1);
    std::string key(pointer.substr(0, pointer.find('/')));
    pointer.remove_prefix(key.size());
    if (at->is(JsonValue::Type::array)) {
      std::size_t index = at->items.size();
      std::from_chars(key.data(), key.data() + key.size(), index);
      at = index < at->items.size() ? &at->items[index] : nullptr;
      continue;
    }
    for (std::size_t tilde = key.find('~'); tilde != std::string::npos; tilde = key.find('~', tilde + 1))
      key.replace(tilde, 2, key.substr(tilde, 2) == "~1" ? "/" : "~");
    at = at->find(key);
  }
  return at;
}

std::optional<std::string> replaceValue(std::string_view text, std::string_view pointer,
                                        std::string_view json) {
  const Edited edited(text);
  const JsonValue* value = edited.find(pointer);
  if (!value) return std::nullopt;
  return std::string(text.substr(0, value->begin)).append(json).append(text.substr(value->end));
}

std::optional<std::string> insertMember(std::string_view text, std::string_view pointer, std::string_view key,
                                        std::string_view json, std::string_view after) {
  const Edited edited(text);
  const JsonValue* object = edited.find(pointer);
  if (!object || !object->is(JsonValue::Type::object) || object->find(key)) return std::nullopt;
  const std::string added = fmt::format("{}: {}", quoteJson(key), json);
  if (object->members.empty())
    return std::string(text).insert(object->begin + 1,
                                    fmt::format(" {}{}", added, text[object->begin + 1] == '}' ? " " : ""));
  std::vector<ByteRange> elements;
  std::size_t index = object->members.size() - 1;
  for (std::size_t i = 0; i < object->members.size(); ++i) {
    const JsonMember& member = object->members[i];
    elements.push_back({member.begin, member.value.end});
    if (member.key == after) index = i;
  }
  return edited.putBehind(elements, index, added);
}

std::optional<std::string> appendItem(std::string_view text, std::string_view pointer,
                                      std::string_view json) {
  const Edited edited(text);
  const JsonValue* array = edited.find(pointer);
  if (!array || !array->is(JsonValue::Type::array)) return std::nullopt;
  if (array->items.empty()) return std::string(text).insert(array->begin + 1, std::string(json));
  std::vector<ByteRange> elements;
  for (const JsonValue& item : array->items) elements.push_back({item.begin, item.end});
  return edited.putBehind(elements, elements.size() - 1, std::string(json));
}

std::string quoteJson(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace weft::base
