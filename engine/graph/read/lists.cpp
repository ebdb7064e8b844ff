#include "engine/graph/read/lists.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

bool isListOfNames(const JsonValue& value) {
  return value.is(Type::array) && std::ranges::all_of(value.items, [](const JsonValue& item) {
           return item.is(Type::string) || item.is(Type::object);
         });
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
    moveInputs(root);
  }

 private:
  void inStanza(JsonValue& stanza) {
    for (const char* key : {"read", "write", "modify", "bind", "parameters"})
      if (JsonMember* list = memberOf(stanza, key)) {
        const bool values = list->key == "parameters";
        toObject(list->value, key, [&](std::string_view text) {
          const std::string_view name = nameOf(text, values);
          return name.substr(name.rfind('.') + 1);
        });
      }
  }

  // `called(text)`: what an item is called.
  template <class Called>
  void toObject(JsonValue& list, std::string_view key, Called&& called) {
    if (!isListOfNames(list)) return;
    const std::vector<JsonValue> items = std::move(list.items);
    list.items.clear();
    list.type = Type::object;
    ReadContext::Seen seen;
    const auto add = [&](JsonMember member) {
      const auto [before, fresh] = seen.try_emplace(member.key, member.place);
      if (fresh)
        list.members.push_back(std::move(member));
      else
        said_.error(Code::duplicateName, member.place, fmt::format("\"{}\" has '{}' twice", key, member.key))
            .hint = fmt::format("call one otherwise, {{ \"other\": … }}; the first stands at {}:{}",
                                before->second.line, before->second.column);
    };
    for (const JsonValue& item : items) {
      for (const JsonMember& member : item.members) add(member);
      if (item.is(Type::object)) continue;
      if (const std::string_view name = called(item.text); !name.empty()) {
        Place place = item.textPlace();  // of the name, but for the character before it, as of any key
        if (place.column > 0) place.column += static_cast<std::uint32_t>(name.data() - item.text.data()) - 1;
        add({std::string(name), std::move(place), item, item.begin, item.end});
      } else
        said_.error(Code::notAName, item, fmt::format("\"{}\" in \"{}\" begins with no name", item.text, key))
            .hint = fmt::format("write {{ \"name\": \"{}\" }}", item.text);
    }
  }

  // ---- inputs ----

  // To the front of "resources", which is there then.
  void moveInputs(JsonValue& root) {
    if (JsonMember* resources = memberOf(root, "resources")) mendOldInputs(resources->value);
    const JsonMember* const found = memberOf(root, "inputs");
    if (!found) return;
    JsonMember inputs = *found;
    toObject(inputs.value, "inputs", [](std::string_view text) { return text; });
    JsonMember* resources = memberOf(root, "resources");
    if (!inputs.value.is(Type::object) || (resources && !resources->value.is(Type::object))) return;
    std::erase_if(root.members, [](const JsonMember& member) { return member.key == "inputs"; });
    resources = memberOf(root, "resources");
    if (!resources) {
      resources = &root.members.emplace_back(inputs);
      resources->key = "resources";
      resources->value.members.clear();
    }
    std::vector<JsonMember> made;
    for (JsonMember& member : inputs.value.members) made.push_back(asResource(member));
    for (JsonMember& member : resources->value.members) {
      if (const auto input = std::ranges::find(made, member.key, &JsonMember::key); input != made.end())
        said_.error(Code::duplicateName, member.place, fmt::format("'{}' is an input, too", member.key))
            .hint =
            fmt::format("rename one; the input stands at {}:{}", input->place.line, input->place.column);
      else
        made.push_back(std::move(member));
    }
    resources->value.members = std::move(made);
  }

  // "specular as linear ?": { … }
  JsonMember asResource(const JsonMember& input) {
    JsonMember made = input;
    made.key = nameOf(input.key, false);
    if (made.value.is(Type::string)) made.value.type = Type::object;
    if (made.value.is(Type::object))
      setInput(made.value, input.key, input);
    else if (!made.value.is(Type::null))  // by which an overlay takes it away
      said_.wrongType(made.value, fmt::format("the input '{}'", made.key), "an object with \"history\"");
    return made;
  }

  static void setInput(JsonValue& resource, std::string text, const JsonMember& key) {
    JsonValue said;
    said.type = Type::string;
    said.text = std::move(text);
    said.place = key.place;
    resource.members.insert(resource.members.begin(), {"input", key.place, std::move(said)});
  }

  // { "input": "texture", "optional": true } among the resources, as it was written once.
  void mendOldInputs(JsonValue& resources) {
    Place first;
    std::vector<std::string> all;
    for (JsonMember& member : resources.members) {
      const JsonValue* input = member.value.find("input");
      if (!input) continue;
      if (all.empty()) first = memberOf(member.value, "input")->place;
      const JsonValue* optional = member.value.find("optional");
      all.push_back(member.key + (optional && optional->flag ? " ?" : ""));
      std::erase_if(member.value.members,
                    [](const JsonMember& each) { return each.key == "input" || each.key == "optional"; });
      setInput(member.value, all.back(), member);
    }
    if (!all.empty())
      said_.error(Code::unknownKey, first, "inputs have a list of their own, beside \"resources\"").hint =
          fmt::format("write \"inputs\": [\"{}\"]; `weft format` does", fmt::join(all, "\", \""));
  }

  ReadContext said_;
};

}  // namespace

void writeOutLists(JsonValue& root, text::Diagnostics& diagnostics) {
  if (root.is(Type::object)) Lists(diagnostics).run(root);
}

}  // namespace weft::graph
