// Declared in edit.h.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "engine/graph/edit/edit.h"
#include "engine/graph/language/names.h"
#include "engine/text/json/edit.h"

namespace weft::graph {

namespace {

using text::JsonMember;
using text::JsonValue;

constexpr std::size_t kMaxWritten = std::size_t{16} << 20;  // bytes of passes that are like others

// A value as it is written, whose members or items can be moved with their comments.
struct Part {
  std::string key;          // of a member
  std::string before = {};  // in front of it: blanks and comments, without the comma
  std::string head = {};    // the key as it is written, up to the value
  std::string text = {};    // of a number, a word or a string
  std::string word = {};    // what a string says
  char open = '\0';         // of an object or a list
  std::vector<Part> parts = {};
  std::string behind = {};  // in front of the closing bracket

  Part* find(std::string_view wanted) {
    const auto found = std::ranges::find(parts, wanted, &Part::key);
    return found == parts.end() ? nullptr : &*found;
  }
  bool says(std::string_view wanted, std::string_view written) {
    const Part* part = find(wanted);
    return part && part->text == written;
  }
};

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text), tree_(text::parseJsonTree(text)) {}

  Part whole() const {
    Part root = partOf(tree_.root);
    root.before = of(0, tree_.root.begin);
    return root;
  }
  std::string_view behindWhole() const { return text_.substr(tree_.root.end); }

 private:
  std::string of(std::size_t begin, std::size_t end) const {
    return std::string(text_.substr(begin, end - begin));
  }

  std::string withoutComma(std::size_t begin, std::size_t end) const {
    for (std::size_t at = begin; at < end; ++at)
      if (const std::size_t behind = tree_.behindComment(at); behind > at)
        at = behind - 1;
      else if (text_[at] == ',')
        return of(begin, at) + of(at + 1, end);
    return of(begin, end);
  }

  Part partOf(const JsonValue& value) const {
    Part part{.key = {}, .word = value.text};
    if (!value.is(JsonValue::Type::object) && !value.is(JsonValue::Type::array)) {
      part.text = of(value.begin, value.end);
      return part;
    }
    part.open = text_[value.begin];
    std::size_t behind = value.begin + 1;
    const auto add = [&](const JsonValue& child, std::size_t begin, std::string key) {
      Part& made = part.parts.emplace_back(partOf(child));
      made.key = std::move(key);
      made.before = withoutComma(std::exchange(behind, child.end), begin);
      made.head = of(begin, child.begin);
    };
    for (const JsonMember& member : value.members) add(member.value, member.begin, member.key);
    for (const JsonValue& item : value.items) add(item, item.begin, "");
    part.behind = of(behind, value.end - 1);
    return part;
  }

  std::string_view text_;
  text::JsonTree tree_;
};

std::string textOf(const Part& part) {
  if (part.open == '\0') return part.text;
  std::string all(1, part.open);
  for (const Part& each : part.parts)
    all += (&each == part.parts.data() ? "" : ",") + each.before + each.head + textOf(each);
  return all + part.behind + (part.open == '{' ? '}' : ']');
}

std::string headOf(std::string_view key) {
  return text::quoteJson(key) + ": ";
}

// `own` over what it is like: objects merge, null takes away, anything else replaces. What is taken over stands where "like" does,
// else first. `other` is the pass `name`, or what it has under `group`.
Part laidOver(const Part& own, Part other, const std::string& name, std::string_view group) {
  constexpr std::string_view kOwn[] = {"name", "before", "after", "remove"};
  const auto refer = [&](std::string_view in, Part& part) {  // a parameter is declared once
    if (in != "parameters" || part.open != '{') return;
    part.open = '\0';
    part.text = fmt::format("\"${}.{}\"", name, part.key);
  };
  std::vector<Part> taken;
  for (Part& part : other.parts) {
    const bool stays = group.empty() && std::ranges::find(kOwn, part.key) != std::end(kOwn);
    if (stays || std::ranges::find(own.parts, part.key, &Part::key) != own.parts.end()) continue;
    part.before = " ";
    refer(group, part);
    for (Part& each : part.parts) refer(group.empty() ? part.key : "", each);
    taken.push_back(part);
  }
  Part made{.key = own.key, .before = own.before, .head = own.head, .open = '{', .behind = own.behind};
  if (!group.empty()) made.parts = taken;
  for (const Part& part : own.parts) {
    const Part* below = other.find(part.key);
    if (group.empty() && part.key == "like") {
      if (!taken.empty()) taken.front().before = part.before;
      made.parts.insert(made.parts.end(), taken.begin(), taken.end());
    } else if (below && below->open == '{' && part.open == '{') {
      Part held = laidOver(part, *below, name, part.key);
      if (!held.parts.empty()) made.parts.push_back(std::move(held));
    } else if (part.text != "null") {
      made.parts.push_back(part);
    }
  }
  return made;
}

void writePassesWhole(Part& passes) {
  std::map<std::string, const Part*> whole;  // passes above, by name
  std::size_t written = 0;
  for (Part& stanza : passes.parts) {
    const Part *name = stanza.find("name"), *like = stanza.find("like");
    const auto above = like ? whole.find(like->word) : whole.end();
    if (above != whole.end() && (written += textOf(*above->second).size()) <= kMaxWritten)
      stanza = laidOver(stanza, *above->second, like->word, "");
    if (name = stanza.find("name"); name && stanza.find("type")) whole.try_emplace(name->word, &stanza);
  }
}

// The '?' and the `if` of slots that read.
void mendSlots(Part& resources, Part& passes) {
  for (Part& stanza : passes.parts)
    if (Part* members = stanza.find("passes")) mendSlots(resources, *members);
  std::set<std::string> names, optional;
  for (Part& part : resources.parts) {
    names.insert(part.key);
    if (part.find("input") && part.says("optional", "true")) optional.insert(part.key);
  }
  for (Part& stanza : passes.parts) {
    Part* slots = stanza.find("read");
    if (!slots) continue;
    for (Part& slot : slots->parts) {
      std::string_view ref = trimmed(slot.word);
      const bool may = ref.ends_with('?');
      if (may) ref = trimmed(ref.substr(0, ref.size() - 1));
      const std::string name(dottedNameIn(ref));
      const std::size_t at = ref.find(" if ");
      const Part* pass = stanza.find("name");
      std::string mended(ref);
      if (at != std::string_view::npos) {
        if (name.empty() || !pass || stanza.find("repeat")) continue;
        // The list has the name of the slot, if it is free.
        std::string list = names.contains(slot.key) ? pass->word + "_" + slot.key : slot.key;
        while (!names.insert(list).second) list += "_";
        resources.parts.push_back(
            {.key = list,
             .before = "\n",
             .head = headOf(list),
             .text = fmt::format("[{}]",
                                 text::quoteJson(name + " if " + std::string(trimmed(ref.substr(at + 4)))))});
        mended = list + std::string(ref.substr(name.size(), at - name.size())) + (may ? " ?" : "");
      } else if (!may || !optional.contains(name)) {
        continue;
      }
      slot.text = text::quoteJson(mended);
    }
  }
}

void moveInputs(Part& root) {
  const auto section = std::ranges::find(root.parts, "resources", &Part::key);
  if (section == root.parts.end()) return;
  const auto first = std::ranges::stable_partition(section->parts, [](Part& part) {
                       const Part* input = part.find("input");
                       return !input || !input->text.starts_with('"');
                     }).begin();
  if (first == section->parts.end()) return;
  Part inputs{.key = "inputs", .before = section->before, .head = headOf("inputs"), .open = '['};
  for (Part& part : std::ranges::subrange(first, section->parts.end())) {
    part.head = text::quoteJson(part.key + (part.says("optional", "true") ? " ?" : ""));
    std::erase_if(part.parts, [](const Part& each) { return each.key == "input" || each.key == "optional"; });
    std::string rest = part.parts.empty() ? "" : fmt::format(": {}", textOf(part));
    inputs.parts.push_back({.key = {},
                            .before = part.before,
                            .text = rest.empty() ? part.head : fmt::format("{{ {}{} }}", part.head, rest)});
  }
  inputs.behind = section->before = "\n";
  section->parts.erase(first, section->parts.end());
  const auto place = root.parts.insert(section, std::move(inputs));
  if (place[1].parts.empty()) root.parts.erase(place + 1);
}

}  // namespace

std::string withNewSpelling(std::string_view text) {
  if (!text::JsonEdit(text)) return std::string(text);
  const Reader reader(text);
  Part root = reader.whole();
  Part *resources = root.find("resources"), *passes = root.find("passes");
  if (passes) writePassesWhole(*passes);
  if (passes && resources && !resources->parts.empty()) mendSlots(*resources, *passes);
  moveInputs(root);
  return root.before + textOf(root) + std::string(reader.behindWhole());
}

}  // namespace weft::graph
