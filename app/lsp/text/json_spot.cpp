#include "app/lsp/text/json_spot.h"

#include <algorithm>

namespace weft::app::lsp {

namespace {

using Type = JsonValue::Type;

// Whether the cursor is in the value, which it may leave behind a missing quote or bracket.
bool isIn(const JsonValue& value, std::size_t offset) {
  if (!value.is(Type::object) && !value.is(Type::array) && !value.is(Type::string))
    return rangeOf(value).holds(offset);
  return value.begin < offset && (offset < value.end || (!value.closed && offset <= value.end));
}

}  // namespace

Range rangeOf(const JsonValue& value) {
  return {value.begin, value.end};
}
Range inside(const JsonValue& string) {
  if (!string.is(Type::string)) return rangeOf(string);
  return {string.begin + std::size_t{1}, string.end - std::size_t{string.closed}};
}
Range inside(const JsonMember& key) {
  return {key.begin + std::size_t{1}, key.end - std::size_t{key.closed}};
}

std::string_view textOf(const JsonValue& object, std::string_view key) {
  const JsonValue* const value = object.find(key);
  return value ? std::string_view(value->text) : std::string_view();
}

std::vector<std::string_view> keysOn(const Way& way) {
  std::vector<std::string_view> keys;
  for (std::size_t i = 1; i < way.size(); ++i)
    keys.push_back(way[i].member ? std::string_view(way[i].member->key) : "[]");
  return keys;
}

Spot spotAt(const base::JsonTree& tree, std::size_t offset) {
  Spot spot;
  spot.inComment = std::ranges::any_of(
      tree.comments, [&](const Range& comment) { return comment.begin < offset && offset <= comment.end; });
  for (Step step{&tree.root}; step.value;) {
    spot.way.push_back(step);
    const JsonValue& around = *step.value;
    step = {};
    for (const JsonValue& item : around.items)
      if (!item.is(Type::absent) && isIn(item, offset)) step = {&item};
    for (const JsonMember& member : around.members) {
      spot.inKey = inside(member).holds(offset);
      if (spot.inKey || (member.hasValue && isIn(member.value, offset))) step = {&member.value, &member};
      if (spot.inKey) break;
    }
    if (!spot.inKey) continue;
    spot.way.push_back(step);
    return spot;
  }
  spot.atKey = spot.value().is(Type::object);
  return spot;
}

}  // namespace weft::app::lsp
