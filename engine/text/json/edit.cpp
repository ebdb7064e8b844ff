#include "engine/text/json/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

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
  good_ = parseJson(text, {}, said) && !said.hasErrors();
}

std::string JsonEdit::putBehind(const std::vector<ByteRange>& elements, std::size_t index,
                                const std::string& added) const {
  const auto ownLine = [&](const ByteRange& e) { return beginsLine(text_, e.begin); };
  const bool lines = std::all_of(elements.begin(), elements.end(), ownLine);
  const ByteRange& before = elements[index];
  std::string out(text_);
  if (!lines) return out.insert(before.end, ", " + added);
  const std::string newline = text_.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
  const std::string line = newline + std::string(indentOf(text_, before.begin)) + added;
  // Behind the element, its comma and the comments in its line, which stay with it.
  std::size_t end = before.end;
  bool comma = false;
  for (;;) {
    const char c = end < text_.size() ? text_[end] : '\0';
    const std::size_t comment = tree_.behindComment(end);
    if (comment > end && text_.substr(end, comment - end).find('\n') == std::string_view::npos)
      end = comment;
    else if (c == ' ' || c == '\t' || (c == ',' && !comma))
      ++end;
    else
      break;
    comma = comma || c == ',';
  }
  const bool last = index + 1 == elements.size();
  if (end == text_.size() || (text_[end] != '\n' && text_[end] != '\r') || comma == last)
    return out.insert(before.end, "," + line);
  out.insert(end, last ? line : line + ",");
  return last ? out.insert(before.end, ",") : out;
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
  return dumpJson(text, -1, false);
}

std::string dumpJson(const nlohmann::ordered_json& json, int indent, bool ascii) {
  return json.dump(indent, ' ', ascii, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::ordered_json loadJson(std::string_view text) {
  return nlohmann::ordered_json::parse(text, nullptr, false);
}

}  // namespace weft::text
