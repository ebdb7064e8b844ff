// Passes that are "like" others. Declared in spelling.h.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "engine/graph/edit/spelling.h"
#include "engine/text/json/edit.h"

namespace weft::graph {

namespace {

using text::JsonMember;
using text::JsonTree;
using text::JsonValue;
using Type = JsonValue::Type;

constexpr std::size_t kMaxWritten = std::size_t{16}
                                    << 20;  // bytes: each pass may be like one that is twice as long

// An object, and the text that it stands in.
struct Written {
  std::string_view text;
  const JsonTree& tree;
  const JsonValue& object;

  std::string_view of(std::size_t begin, std::size_t end) const { return text.substr(begin, end - begin); }
  // What stands between two members: without the comma, with the comments.
  std::string between(std::size_t begin, std::size_t end) const {
    std::string all(of(begin, end));
    for (std::size_t at = begin; at < end; ++at)
      if (const std::size_t behind = tree.behindComment(at); behind > at)
        at = behind - 1;
      else if (text[at] == ',')
        return all.erase(at - begin, 1);
    return all;
  }
};

// `own` over what it is like: objects merge, null takes away, anything else replaces. What is taken over stands where "like" does,
// else first. `other` is the name of the other pass, `group` the key of the object.
std::string laidOver(const Written& own, const Written& other, const std::string& name,
                     std::string_view group) {
  constexpr std::string_view kOwn[] = {"name", "before", "after", "remove"};
  constexpr std::string_view kNothing = "{}";
  static const JsonTree nothing = text::parseJsonTree(kNothing);
  std::vector<std::string> taken, all;
  for (const JsonMember& member : other.object.members) {
    if (own.object.find(member.key) ||
        (group.empty() && std::ranges::find(kOwn, member.key) != std::end(kOwn)))
      continue;
    std::string value(other.of(member.value.begin, member.value.end));
    if (group == "parameters" && member.value.is(Type::object))
      value = fmt::format("\"${}.{}\"", name, member.key);  // a parameter is declared once
    else if (group.empty() && member.key == "parameters")
      value = laidOver({kNothing, nothing, nothing.root}, {other.text, other.tree, member.value}, name,
                       member.key);
    taken.push_back(fmt::format("{}: {}", text::quoteJson(member.key), value));
  }
  if (!group.empty()) all = taken;
  std::size_t behind = own.object.begin + 1;
  for (const JsonMember& member : own.object.members) {
    const std::string before = own.between(std::exchange(behind, member.value.end), member.begin);
    const JsonValue* below = other.object.find(member.key);
    if (group.empty() && member.key == "like") {
      if (!taken.empty()) all.push_back(before + fmt::format("{}", fmt::join(taken, ", ")));
    } else if (below && below->is(Type::object) && member.value.is(Type::object)) {
      const std::string held =
          laidOver({own.text, own.tree, member.value}, {other.text, other.tree, *below}, name, member.key);
      if (held.find('"') != std::string::npos)
        all.push_back(before + std::string(own.of(member.begin, member.value.begin)) + held);
    } else if (!member.value.is(Type::null)) {
      all.push_back(before + std::string(own.of(member.begin, member.value.end)));
    }
  }
  return fmt::format("{{ {}{}", fmt::join(all, ","), own.between(behind, own.object.end));
}

}  // namespace

std::string withWholePasses(std::string_view text) {
  std::string out(text);
  const JsonTree tree = text::parseJsonTree(text);
  const JsonValue* passes = tree.root.find("passes");
  if (!passes || text.find("\"like\"") == std::string_view::npos) return out;
  std::map<std::string, std::string> whole;  // passes above, by name
  std::size_t written = 0, grown = 0;
  for (const JsonValue& stanza : passes->items) {
    const JsonValue *name = stanza.find("name"), *like = stanza.find("like");
    std::string made(text.substr(stanza.begin, stanza.end - stanza.begin));
    const auto above = like ? whole.find(like->text) : whole.end();
    if (above != whole.end()) {
      const JsonTree other = text::parseJsonTree(above->second);
      made = laidOver({text, tree, stanza}, {above->second, other, other.root}, like->text, "");
      if (written += made.size(); written > kMaxWritten) return std::string(text);
      out.replace(stanza.begin + grown, stanza.end - stanza.begin, made);
      grown += made.size() - (stanza.end - stanza.begin);
    }
    if (name && (above != whole.end() || stanza.find("type"))) whole.try_emplace(name->text, std::move(made));
  }
  return out;
}

}  // namespace weft::graph
