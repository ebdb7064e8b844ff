#include "engine/graph/read/lists.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/language/names.h"
#include "engine/graph/read/overlay.h"
#include "engine/graph/read/read_context.h"

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
  explicit Lists(text::Diagnostics& diagnostics) : said_(diagnostics) {}

  void run(JsonValue& root) {
    if (JsonMember* passes = memberOf(root, "passes"))
      for (JsonValue& stanza : passes->value.items) {
        said_.pass = stanzaName(stanza);
        inStanza(stanza);
      }
    said_.pass.clear();
    if (JsonMember* sets = memberOf(root, "sets"))
      for (JsonMember& set : sets->value.members) inStanza(set.value);
    if (JsonMember* inputs = memberOf(root, "inputs")) moveInputs(root, *inputs);
  }

 private:
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
      if (item.is(Type::string) && name.empty())
        said_.error(Code::notAName, item, fmt::format("an item of \"{}\" begins with no name", list.key))
            .hint = fmt::format("write {{ \"name\": \"{}\" }}", item.text);
      if (name.empty()) continue;
      Place place = item.textPlace();  // of the character before the name, as of any key
      if (place.column > 0) place.column += static_cast<std::uint32_t>(name.data() - item.text.data()) - 1;
      add({std::string(name), std::move(place), item, item.begin, item.end});
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

  ReadContext said_;
};

}  // namespace

void writeOutLists(JsonValue& root, text::Diagnostics& diagnostics) {
  if (root.is(Type::object)) Lists(diagnostics).run(root);
}

}  // namespace weft::graph
