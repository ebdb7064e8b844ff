#include "engine/graph/read/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <unordered_map>

#include "engine/graph/language/suffix.h"
#include "engine/graph/read/read_context.h"
#include "engine/text/limits.h"
#include "engine/text/nearest.h"

namespace weft::graph {

using text::Code;
using Type = JsonValue::Type;

JsonMember* memberOf(JsonValue& object, std::string_view key) {
  const auto found = std::ranges::find(object.members, key, &JsonMember::key);
  return found == object.members.end() ? nullptr : &*found;
}

std::uint64_t valuesOf(const JsonValue& value) {
  std::uint64_t count = 1;
  for (const JsonValue& item : value.items) count += valuesOf(item);
  for (const JsonMember& member : value.members) count += valuesOf(member.value);
  return count;
}

std::string_view kindOf(const JsonValue& resource) {
  if (!resource.is(Type::object)) return "alternatives";
  for (const std::string_view kind : {"texture", "buffer", "import", "input"})
    if (const JsonValue* value = resource.find(kind); value && !value->is(Type::null)) return kind;
  return "";
}

std::string includePrefix(const JsonValue& stanza) {
  if (const JsonValue* as = stanza.find("as")) return as->text;
  const JsonValue* include = stanza.find("include");
  return include ? std::filesystem::path(include->text).stem().string() : std::string();
}

std::string stanzaName(const JsonValue& stanza) {
  const JsonValue* name = stanza.find("name");
  return name ? name->text : includePrefix(stanza);
}

std::string hintForKey(const JsonValue& object, std::string_view key) {
  std::vector<std::string> keys;
  for (const JsonMember& member : object.members) keys.push_back(member.key);
  const std::string hint = suffixHint(key, keys);
  return hint.empty() ? "leave it out" : hint;
}

void Merge::run(JsonValue& into, const JsonMember& over) const {
  JsonMember* there = memberOf(into, over.key);
  if (over.value.is(Type::null) && !keepsNull) {
    if (there)
      into.members.erase(into.members.begin() + (there - into.members.data()));
    else
      nothingThere(into, over);
    return;
  }
  if (!there) there = &into.members.emplace_back(over.key, over.place);
  if (!over.value.is(Type::object)) {
    *there = over;
    return;
  }
  if (!there->value.is(Type::object)) {
    *there = over;
    there->value.members.clear();
  }
  if (takesPlace) {
    there->place = over.place;
    there->value.place = over.value.place;
  }
  for (const JsonMember& member : over.value.members) run(there->value, member);
}

namespace {

std::string_view passName(const JsonValue& stanza) {
  const JsonValue* name = stanza.find("include") ? nullptr : stanza.find("name");
  return name && name->is(Type::string) ? std::string_view(name->text) : std::string_view();
}

// W027, with what was meant.
void reportLikeNothing(const std::vector<JsonValue>& stanzas, std::size_t index, const JsonValue& like,
                       ReadContext& said) {
  auto& d =
      said.error(Code::likeNothing, like,
                 fmt::format("no pass above has the name '{}', which '{}' is like", like.text, said.pass));
  d.expected = "the name of a pass above it in this file";
  std::vector<std::string> names;
  for (std::size_t i = 0; i < index; ++i)
    if (const std::string_view name = passName(stanzas[i]); !name.empty()) names.emplace_back(name);
  d.hint = text::nearestHint(like.text, names);
}

// `other` with `stanza` over it.
JsonValue mergeLike(const JsonValue& other, const JsonValue& stanza, const JsonValue& like,
                    ReadContext& said) {
  JsonValue made = other;
  made.place = stanza.place;
  // A parameter is declared once: who is like its pass takes the value.
  if (JsonMember* parameters = memberOf(made, "parameters"))
    for (JsonMember& member : parameters->value.members)
      if (member.value.is(Type::object)) {
        member.value = like;
        member.value.text = fmt::format("${}.{}", like.text, member.key);
      }
  // With another shader, a slot, parameter or define of the other that does not fit is a mistake of this pass, at its "like".
  if (stanza.find("shader"))
    for (const char* group : {"read", "write", "modify", "parameters", "defines"})
      if (JsonMember* names = memberOf(made, group))
        for (JsonMember& member : names->value.members) member.place = like.place;
  const Merge merge{.takesPlace = true, .nothingThere = [&](const JsonValue& into, const JsonMember& over) {
                      if (over.place.file != stanza.place.file)
                        return;  // an overlay's may be about what the stanza itself says
                      said.error(Code::nothingToChange, over.place,
                                 fmt::format("null takes \"{}\" away, which is not there", over.key))
                          .hint = hintForKey(into, over.key);
                    }};
  for (const JsonMember& member : stanza.members) merge.run(made, member);
  return made;
}

}  // namespace

std::vector<const JsonValue*> writeOut(const std::vector<JsonValue>& stanzas, std::deque<JsonValue>& made,
                                       text::Diagnostics& diagnostics) {
  ReadContext said(diagnostics);
  std::vector<const JsonValue*> whole;
  std::unordered_map<std::string_view, const JsonValue*> above;  // written out, by name
  std::uint64_t values = 0;
  for (std::size_t i = 0; i < stanzas.size(); ++i) {
    const JsonValue& stanza = stanzas[i];
    const JsonValue* like =
        stanza.is(Type::object) && !stanza.find("include") ? stanza.find("like") : nullptr;
    const JsonValue* out = &stanza;
    if (like) {
      out = nullptr;
      said.pass = passName(stanza);
      const auto found = above.find(like->text);
      const bool named = said.expect(*like, Type::string, "\"like\"");
      if (named && found == above.end()) reportLikeNothing(stanzas, i, *like, said);
      if (named && found != above.end() && found->second) {
        values += valuesOf(*found->second);
        if (values > text::raised(text::kMaxValues)) {
          text::reportLimit(diagnostics, like->place, "passes that are like others hold too many values",
                            text::kMaxValues, "values");
          whole.resize(stanzas.size(), nullptr);
          return whole;
        }
        out = &made.emplace_back(mergeLike(*found->second, stanza, *like, said));
      }
    }
    if (const std::string_view name = passName(stanza); !name.empty()) above.try_emplace(name, out);
    whole.push_back(out);
  }
  return whole;
}

}  // namespace weft::graph
