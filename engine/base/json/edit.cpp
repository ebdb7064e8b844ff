#include "engine/base/json/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/base/chars.h"

namespace weft::base {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::size_t offsetOf(std::string_view text, const Place& place) {
  std::size_t at = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  for (std::uint32_t line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
  return at + place.column - 1;
}

// Behind the string that opens at `at`.
std::size_t endOfString(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

// Behind the comment that opens at `at`; `at` when none does.
std::size_t endOfComment(std::string_view text, std::size_t at) {
  if (text.substr(at, 2) == "//") return std::min(text.find('\n', at), text.size());
  if (text.substr(at, 2) != "/*") return at;
  const std::size_t close = text.find("*/", at + 2);
  return close == std::string_view::npos ? text.size() : close + 2;
}

std::size_t endOfValue(std::string_view text, std::size_t at) {
  if (text[at] == '"') return endOfString(text, at);
  if (text[at] != '{' && text[at] != '[') {
    while (at < text.size() && (isDigit(text[at]) || (text[at] >= 'a' && text[at] <= 'z') ||
                                text[at] == 'E' || text[at] == '+' || text[at] == '-' || text[at] == '.'))
      ++at;
    return at;
  }
  int depth = 0;
  while (at < text.size()) {
    if (const std::size_t end = endOfComment(text, at); end != at) {
      at = end;
    } else if (text[at] == '"') {
      at = endOfString(text, at);
    } else {
      depth += text[at] == '{' || text[at] == '[' ? 1 : text[at] == '}' || text[at] == ']' ? -1 : 0;
      ++at;
      if (depth == 0) return at;
    }
  }
  return at;
}

// Behind white space and comments.
std::size_t skipBlank(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    const std::size_t end = endOfComment(text, at);
    if (end != at)
      at = end;
    else if (std::string_view(" \t\r\n").find(text[at]) != std::string_view::npos)
      ++at;
    else
      break;
  }
  return at;
}

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
std::size_t restOfLine(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && text[end] != '\n') {
    const std::size_t comment = endOfComment(text, end);
    if (comment != end) {
      if (text.substr(end, comment - end).find('\n') != std::string_view::npos) return at;
      end = comment;
    } else if (text[end] == ' ' || text[end] == '\t' || text[end] == '\r') {
      ++end;
    } else {
      return at;
    }
  }
  if (end == text.size()) return at;
  return end > at && text[end - 1] == '\r' ? end - 1 : end;
}

// Puts `added` behind element `index` of the elements of a container (of which there is one at least).
std::string putBehind(std::string_view text, const std::vector<ByteRange>& elements, std::size_t index,
                      const std::string& added) {
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
  const std::size_t comma = last ? before.end : skipBlank(text, before.end) + 1;
  const std::size_t end = restOfLine(text, comma);
  if (end == comma && text[end] != '\n' && text[end] != '\r') {
    out.insert(before.end, "," + line);
  } else {
    out.insert(end, last ? line : line + ",");
    if (last) out.insert(before.end, ",");
  }
  return out;
}

std::optional<JsonValue> parseText(std::string_view text) {
  Diagnostics ignored;
  auto root = parseJson(text, nullptr, ignored);
  return ignored.hasErrors() ? std::nullopt : std::move(root);
}

}  // namespace

const JsonValue* findPointer(const JsonValue& root, std::string_view pointer) {
  if (root.pointer == pointer) return &root;
  const auto leads = [&](const JsonValue& child) {
    const std::string own = child.pointer.text();
    return pointer.starts_with(own) && (pointer.size() == own.size() || pointer[own.size()] == '/');
  };
  for (const JsonValue& item : root.items)
    if (leads(item)) return findPointer(item, pointer);
  for (const JsonMember& member : root.members)
    if (leads(member.value)) return findPointer(member.value, pointer);
  return nullptr;
}

ByteRange rangeOf(std::string_view text, const JsonValue& value) {
  const std::size_t begin = offsetOf(text, value.place);
  return {begin, endOfValue(text, begin)};
}

std::optional<std::string> replaceValue(std::string_view text, std::string_view pointer,
                                        std::string_view json) {
  const auto root = parseText(text);
  const JsonValue* value = root ? findPointer(*root, pointer) : nullptr;
  if (!value) return std::nullopt;
  const ByteRange range = rangeOf(text, *value);
  return std::string(text.substr(0, range.begin)).append(json).append(text.substr(range.end));
}

std::optional<std::string> insertMember(std::string_view text, std::string_view pointer, std::string_view key,
                                        std::string_view json, std::string_view after) {
  const auto root = parseText(text);
  const JsonValue* object = root ? findPointer(*root, pointer) : nullptr;
  if (!object || !object->is(JsonValue::Type::object) || object->find(key)) return std::nullopt;
  const std::string added = fmt::format("{}: {}", quoteJson(key), json);
  if (object->members.empty()) {
    const ByteRange range = rangeOf(text, *object);
    return std::string(text).insert(range.begin + 1,
                                    fmt::format(" {}{}", added, text[range.begin + 1] == '}' ? " " : ""));
  }
  std::vector<ByteRange> elements;
  std::size_t index = object->members.size() - 1;
  for (std::size_t i = 0; i < object->members.size(); ++i) {
    const JsonMember& member = object->members[i];
    elements.push_back({offsetOf(text, member.place), rangeOf(text, member.value).end});
    if (member.key == after) index = i;
  }
  return putBehind(text, elements, index, added);
}

std::optional<std::string> appendItem(std::string_view text, std::string_view pointer,
                                      std::string_view json) {
  const auto root = parseText(text);
  const JsonValue* array = root ? findPointer(*root, pointer) : nullptr;
  if (!array || !array->is(JsonValue::Type::array)) return std::nullopt;
  if (array->items.empty()) {
    const ByteRange range = rangeOf(text, *array);
    return std::string(text).insert(range.begin + 1, std::string(json));
  }
  std::vector<ByteRange> elements;
  for (const JsonValue& item : array->items) elements.push_back(rangeOf(text, item));
  return putBehind(text, elements, elements.size() - 1, std::string(json));
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
