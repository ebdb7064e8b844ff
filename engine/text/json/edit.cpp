#include "engine/text/json/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/text/chars.h"

namespace weft::text {

namespace {

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

}  // namespace

JsonEdit::JsonEdit(std::string_view text) : text_(text), tree_(parseJsonTree(text)) {
  Diagnostics said;
  good_ = parseJson(text, nullptr, said) && !said.hasErrors();
}

std::size_t JsonEdit::skipBlank(std::size_t at) const {
  for (;;) {
    const std::size_t end = tree_.behindComment(at);
    if (end == at && (at >= text_.size() || !isSpace(text_[at]))) return at;
    at = std::max(end, at + 1);
  }
}

std::size_t JsonEdit::restOfLine(std::size_t at) const {
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

std::string JsonEdit::putBehind(const std::vector<ByteRange>& elements, std::size_t index,
                                const std::string& added) const {
  const auto ownLine = [&](const ByteRange& e) { return beginsLine(text_, e.begin); };
  const bool lines = std::all_of(elements.begin(), elements.end(), ownLine);
  const ByteRange& before = elements[index];
  const bool last = index + 1 == elements.size();
  std::string out(text_);
  if (!lines) {
    out.insert(before.end, ", " + added);
    return out;
  }
  const std::string newline = text_.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
  const std::string line = newline + std::string(indentOf(text_, before.begin)) + added;
  // A comment behind the element stays with it.
  const std::size_t comma = last ? before.end : skipBlank(before.end) + 1;
  const std::size_t end = restOfLine(comma);
  if (end == comma && text_[end] != '\n' && text_[end] != '\r') {
    out.insert(before.end, "," + line);
  } else {
    out.insert(end, last ? line : line + ",");
    if (last) out.insert(before.end, ",");
  }
  return out;
}

std::string JsonEdit::withValue(const JsonValue& value, std::string_view json) const {
  return std::string(text_).replace(value.begin, value.end - value.begin, json);
}

std::string JsonEdit::withMember(const JsonValue& object, std::string_view key, std::string_view json,
                                 std::string_view after) const {
  const std::string added = fmt::format("{}: {}", quoteJson(key), json);
  if (object.members.empty())
    return std::string(text_).insert(object.begin + 1,
                                     fmt::format(" {}{}", added, text_[object.begin + 1] == '}' ? " " : ""));
  std::vector<ByteRange> elements;
  std::size_t index = object.members.size() - 1;
  for (std::size_t i = 0; i < object.members.size(); ++i) {
    const JsonMember& member = object.members[i];
    elements.push_back({member.begin, member.value.end});
    if (member.key == after) index = i;
  }
  return putBehind(elements, index, added);
}

std::string JsonEdit::withItem(const JsonValue& array, std::string_view json) const {
  if (array.items.empty()) return std::string(text_).insert(array.begin + 1, json);
  std::vector<ByteRange> elements;
  for (const JsonValue& item : array.items) elements.push_back({item.begin, item.end});
  return putBehind(elements, elements.size() - 1, std::string(json));
}

std::string quoteJson(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace weft::text
