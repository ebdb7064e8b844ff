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
    const JsonValue *resources = tree_.root.find("resources"), *passes = tree_.root.find("passes");
    if (!resources || resources->members.empty() || !passes) return std::string(text_);
    for (const JsonValue& stanza : passes->items)
      if (const JsonValue* slots = stanza.find("read"))
        for (const JsonMember& slot : slots->members)
          if (slot.value.is(Type::string)) mendSlot(stanza, slot);
    const std::size_t end = resources->members.back().value.end;
    edits_[end] = {end, lists_};
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
    std::string_view ref = trimmed(slot.value.text);
    const bool may = ref.ends_with('?');
    if (may) ref = trimmed(ref.substr(0, ref.size() - 1));
    const std::string_view name = dottedNameIn(ref);
    const std::size_t at = ref.find(" if ");
    const JsonValue* pass = stanza.find("name");
    std::string mended(ref);
    if (at != std::string_view::npos) {
      if (name.empty() || !pass || stanza.find("repeat")) return;
      // The list has the name of the slot, if it is free.
      std::string list = names_.contains(slot.key) ? pass->text + "_" + slot.key : slot.key;
      while (!names_.insert(list).second) list += "_";
      lists_ += fmt::format(",\n{}: [{}]", text::quoteJson(list),
                            text::quoteJson(fmt::format("{} if {}", name, trimmed(ref.substr(at + 4)))));
      mended = list + std::string(ref.substr(name.size(), at - name.size())) + (may ? " ?" : "");
    } else if (!may || !optional_.contains(std::string(name))) {
      return;
    }
    edits_[slot.value.begin] = {slot.value.end, text::quoteJson(mended)};
  }

  std::string edited() const {
    std::string out(text_);
    for (auto edit = edits_.rbegin(); edit != edits_.rend(); ++edit)
      out.replace(edit->first, edit->second.first - edit->first, edit->second.second);
    return out;
  }

  std::string_view text_;
  text::JsonTree tree_;
  std::set<std::string> names_, optional_;                            // of resources; of optional inputs
  std::string lists_;                                                 // of alternatives, to be added
  std::map<std::size_t, std::pair<std::size_t, std::string>> edits_;  // begin: end, what stands there then
};

}  // namespace

std::string withNewSpelling(std::string_view text) {
  if (!text::JsonEdit(text)) return std::string(text);
  const std::string whole = withWholePasses(text);
  const std::string slots = Rewriter(whole).withSlots();
  return Rewriter(slots).withInputs();
}

}  // namespace weft::graph
