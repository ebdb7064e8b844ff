#include "engine/graph/edit/spelling.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "engine/graph/language/names.h"
#include "engine/text/json/dom.h"
#include "engine/text/json/edit.h"

namespace weft::graph {

namespace {

using text::JsonMember;
using text::JsonValue;
using Type = JsonValue::Type;

// One walk over a text, whose changes are made at its end.
class Rewriter {
 public:
  explicit Rewriter(std::string_view text) : text_(text), tree_(text::parseJsonTree(text)) {
    if (const JsonValue* resources = tree_.root.find("resources"))
      for (const JsonMember& member : resources->members) {
        names_.insert(member.key);
        if (isOptional(member)) optional_.insert(member.key);
      }
  }

  std::string withSlots() {
    if (const JsonValue* passes = tree_.root.find("passes"))
      for (const JsonValue& stanza : passes->items)
        for (const char* group : {"read", "modify"})
          if (const JsonValue* slots = stanza.find(group)) {
            for (const JsonMember& slot : slots->members) mendSlot(stanza, slot);
            for (const JsonValue& item : slots->items)
              for (const JsonMember& slot : item.members) mendSlot(stanza, slot);
          }
    addLists();
    return edited();
  }

  std::string withInputs() {
    const auto section = std::ranges::find(tree_.root.members, "resources", &JsonMember::key);
    if (section == tree_.root.members.end()) return std::string(text_);
    const JsonValue& resources = section->value;
    std::vector<std::string> inputs, others;
    std::size_t behind = resources.begin + 1;
    for (const JsonMember& member : resources.members) {
      const std::size_t from = std::exchange(behind, member.value.end);
      // What stands in front of it, but for the comma.
      std::string text(text_.substr(from, member.begin - from));
      if (const std::size_t comma = text.find(','); comma < text.find('/')) text.erase(comma, 1);
      const JsonValue* input = member.value.find("input");
      const bool moves = input && input->is(Type::string);
      text += moves ? inputText(member) : text_.substr(member.begin, member.value.end - member.begin);
      (moves ? inputs : others).push_back(std::move(text));
    }
    if (inputs.empty()) return std::string(text_);
    std::string made = fmt::format("\"inputs\": [{}\n]", fmt::join(inputs, ","));
    if (!others.empty())
      made += fmt::format(",\n\"resources\": {{{}{}", fmt::join(others, ","),
                          text_.substr(behind, resources.end - behind));
    edits_[section->begin] = {resources.end, std::move(made)};
    return edited();
  }

 private:
  static bool isOptional(const JsonMember& resource) {
    const JsonValue* optional = resource.value.find("optional");
    return resource.value.find("input") && optional && optional->flag;
  }

  std::string inputText(const JsonMember& member) const {
    const std::string name = text::quoteJson(member.key + (isOptional(member) ? " ?" : ""));
    std::vector<std::string_view> rest;
    for (const JsonMember& each : member.value.members)
      if (each.key != "input" && each.key != "optional")
        rest.push_back(text_.substr(each.begin, each.value.end - each.begin));
    return rest.empty() ? name : fmt::format("{{ {}: {{ {} }} }}", name, fmt::join(rest, ", "));
  }

  void mendSlot(const JsonValue& stanza, const JsonMember& slot) {
    if (!slot.value.is(Type::string)) return;
    std::string_view ref = trimmed(slot.value.text);
    const bool may = ref.ends_with('?');
    if (may) ref = trimmed(ref.substr(0, ref.size() - 1));
    const std::string name(dottedNameIn(ref));
    const std::size_t at = ref.find(" if ");
    if (at != std::string_view::npos && !name.empty() && !stanza.find("repeat")) {
      const std::string& list =
          listFor(fmt::format("{} if {}", name, trimmed(ref.substr(at + 4))), stanza, slot);
      put(slot.value, list + std::string(ref.substr(name.size(), at - name.size())) + (may ? " ?" : ""));
    } else if (may && at == std::string_view::npos && optional_.contains(name)) {
      put(slot.value, std::string(ref));
    }
  }
  void put(const JsonValue& value, const std::string& ref) {
    edits_[value.begin] = {value.end, text::quoteJson(ref)};
  }

  // The name of the list of this one alternative: that of the slot, if it is free.
  const std::string& listFor(const std::string& alternative, const JsonValue& stanza,
                             const JsonMember& slot) {
    const auto known = std::ranges::find(lists_, alternative, &std::pair<std::string, std::string>::first);
    if (known != lists_.end()) return known->second;
    const JsonValue* pass = stanza.find("name");
    std::string name = names_.contains(slot.key) && pass ? pass->text + "_" + slot.key : slot.key;
    while (!names_.insert(name).second) name += "_";
    return lists_.emplace_back(alternative, std::move(name)).second;
  }

  void addLists() {
    std::string all;
    for (const auto& [alternative, name] : lists_)
      all += fmt::format("{}{}: [{}]", all.empty() ? "" : ",\n", text::quoteJson(name),
                         text::quoteJson(alternative));
    if (all.empty()) return;
    const JsonValue* resources = tree_.root.find("resources");
    const auto passes = std::ranges::find(tree_.root.members, "passes", &JsonMember::key);
    if (!resources) {
      edits_[passes->begin] = {passes->begin, fmt::format("\"resources\": {{ {} }},\n", all)};
    } else {
      const bool first = resources->members.empty();
      const std::size_t at = first ? resources->begin + 1 : resources->members.back().value.end;
      edits_[at] = {at, (first ? "" : ",\n") + all};
    }
  }

  std::string edited() const {
    std::string out(text_);
    for (auto edit = edits_.rbegin(); edit != edits_.rend(); ++edit)
      out.replace(edit->first, edit->second.first - edit->first, edit->second.second);
    return out;
  }

  std::string_view text_;
  text::JsonTree tree_;
  std::set<std::string> names_, optional_;                  // of resources; of optional inputs
  std::vector<std::pair<std::string, std::string>> lists_;  // "specular if $x", the name of the list
  std::map<std::size_t, std::pair<std::size_t, std::string>> edits_;  // begin: end, what stands there then
};

}  // namespace

std::string withNewSpelling(std::string_view text) {
  if (!text::JsonEdit(text)) return std::string(text);
  const std::string slots = Rewriter(text).withSlots();
  return Rewriter(slots).withInputs();
}

}  // namespace weft::graph
