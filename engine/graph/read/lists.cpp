// Declared in overlay.h.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "engine/graph/language/names.h"
#include "engine/graph/read/overlay.h"
#include "engine/graph/read/read_context.h"
#include "graph_sentences.h"

namespace weft::graph {

namespace {

using text::Code;
using Type = JsonValue::Type;

// Of a reference, or of a value that is nothing else, without its '@' or '$'; "" when there is none.
std::string_view nameOf(std::string_view text, bool value) {
  text = trimmed(text);
  const bool marked = text.starts_with(value ? '$' : '@');
  if (marked) text.remove_prefix(1);
  const std::string_view name = dottedNameIn(text);
  return value && (!marked || name.size() < text.size()) ? std::string_view() : name;
}

class Lists {
 public:
  Lists(SourceLoader& loader, text::Diagnostics& diagnostics) : loader_(loader), said_(diagnostics) {}

  void run(JsonValue& root) {
    if (JsonMember* passes = memberOf(root, "passes")) {
      inPasses(passes->value);
      said_.pass.clear();
      spread(passes->value.items);
    }
    if (JsonMember* sets = memberOf(root, "sets"))
      for (JsonMember& set : sets->value.members) inStanza(set.value);
    if (JsonMember* inputs = memberOf(root, "inputs")) moveInputs(root, *inputs);
  }

 private:
  void inPasses(JsonValue& passes) {
    for (JsonValue& stanza : passes.items) {
      said_.pass = stanzaName(stanza);
      inStanza(stanza);
      if (JsonMember* members = memberOf(stanza, "passes")) inPasses(members->value);
    }
  }

  // ---- groups ----

  void spread(std::vector<JsonValue>& passes) {
    for (JsonValue& stanza : std::exchange(passes, {})) {
      JsonMember* members = memberOf(stanza, "passes");
      if (!members) {
        passes.push_back(std::move(stanza));
        continue;
      }
      std::vector<JsonValue> made;
      for (JsonValue& member : std::exchange(members->value.items, {})) {
        if (!loader_.mayShare(stanza, member.place)) return;
        if (member.find("passes"))
          said_.error(say::groupWithinGroup, member);
        else
          made.push_back(member.is(Type::object) ? ofGroup(std::move(member), stanza) : member);
      }
      if (stanza.find("after")) std::ranges::reverse(made);  // each goes right behind that place
      std::ranges::move(made, std::back_inserter(passes));
    }
  }

  JsonValue ofGroup(JsonValue stanza, const JsonValue& group) {
    said_.pass = stanzaName(stanza);
    const auto both = [&](const JsonMember& member) {
      said_.error(say::alsoInGroup, member.place, member.key);
    };
    JsonMember together{"passes", group.place, {}};
    together.value.type = Type::object;
    together.value.place = group.place;
    for (const JsonMember& member : group.members) {
      JsonMember* own = memberOf(stanza, member.key);
      if (member.key == "enabled" || member.key == "repeat")
        together.value.members.push_back(member);
      else if (member.key == "use" && own)
        joinNames(own->value, member.value);
      else if ((member.key == "before" || member.key == "after") && own)
        both(*own);
      else if (member.key == "use" || member.key == "before" || member.key == "after")
        stanza.members.push_back(member);
    }
    addSet(stanza, group, both);
    if (!together.value.members.empty()) stanza.members.push_back(std::move(together));
    said_.pass.clear();
    return stanza;
  }

  // Puts names, a string or a list of them, in front of others.
  static void joinNames(JsonValue& own, const JsonValue& before) {
    std::vector<JsonValue> names;
    for (const JsonValue* each : {&before, static_cast<const JsonValue*>(&own)})
      for (const JsonValue& name : stringsOf(*each)) names.push_back(name);
    own.type = Type::array;
    own.items = std::move(names);
  }

  // ---- lists ----

  void inStanza(JsonValue& stanza) {
    for (const char* key : {"read", "write", "modify", "bind", "parameters"})
      if (JsonMember* list = memberOf(stanza, key))
        toObject(*list, [values = list->key == "parameters"](std::string_view text) {
          const std::string_view name = nameOf(text, values);
          return name.substr(name.rfind('.') + 1);
        });
  }

  // `called(text)`: what an item is called. An item of another kind leaves the list to the check of shapes.
  template <class Called>
  void toObject(JsonMember& list, Called&& called) {
    const auto fits = [](const JsonValue& item) { return item.is(Type::string) || item.is(Type::object); };
    if (!list.value.is(Type::array) || !std::ranges::all_of(list.value.items, fits)) return;
    list.value.type = Type::object;
    ReadContext::Seen seen;
    const auto add = [&](JsonMember member) {
      if (said_.checkFresh(seen, member.key, member.place, fmt::format("the item of \"{}\"", list.key)))
        list.value.members.push_back(std::move(member));
    };
    for (const JsonValue& item : std::exchange(list.value.items, {})) {
      for (const JsonMember& member : item.members) add(member);
      const std::string_view name = called(item.text);
      if (item.is(Type::string) && name.empty()) said_.error(say::itemWithoutName, item, list.key, item.text);
      if (name.empty()) continue;
      // At the character before the name, as any key.
      const Place place = item.place.after(static_cast<std::size_t>(name.data() - item.text.data()));
      add({std::string(name), place, item, item.begin, item.end});
    }
  }

  // "specular as linear ?": { … } stands among the resources as "specular": { "inputs": "specular as linear ?", … }.
  void moveInputs(JsonValue& root, JsonMember& inputs) {
    toObject(inputs, [](std::string_view text) { return text; });
    JsonMember* resources = memberOf(root, "resources");
    if (!inputs.value.is(Type::object) || (resources && !resources->value.is(Type::object))) return;
    std::vector<JsonMember> made = std::move(inputs.value.members);
    for (JsonMember& input : made) {
      JsonMember written{"inputs", input.place, {}};
      written.value.type = Type::string;
      written.value.place = input.place;
      written.value.text = std::exchange(input.key, std::string(nameOf(input.key, false)));
      if (input.value.is(Type::string)) input.value.type = Type::object;
      if (input.value.is(Type::object))
        input.value.members.insert(input.value.members.begin(), std::move(written));
      else if (!input.value.is(Type::null))  // by which an overlay takes it away
        said_.wrongType(input.value, fmt::format("the input '{}'", input.key), "an object with \"history\"");
    }
    ReadContext::Seen seen;
    for (const JsonMember& input : made) seen.emplace(input.key, input.place);
    if (!resources) inputs.key = "resources";
    for (JsonMember& member : resources ? resources->value.members : inputs.value.members)
      if (said_.checkFresh(seen, member.key, member.place, "the input or resource"))
        made.push_back(std::move(member));
    (resources ? resources : &inputs)->value.members = std::move(made);
    std::erase_if(root.members, [](const JsonMember& member) { return member.key == "inputs"; });
  }

  SourceLoader& loader_;
  ReadContext said_;
};

}  // namespace

void writeOutLists(JsonValue& root, SourceLoader& loader, text::Diagnostics& diagnostics) {
  if (root.is(Type::object)) Lists(loader, diagnostics).run(root);
}

}  // namespace weft::graph
