// Graphs of the language's first edition. Declared in import.h.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "engine/graph/language/names.h"
#include "engine/text/json/edit.h"
#include "importers/import.h"

namespace weft::importing {

namespace {

using Item = text::LayoutItem;
using Node = text::LayoutNode;

constexpr std::size_t kMaxWritten = std::size_t{1} << 20;  // values of passes that are like others

std::size_t valuesOf(const Node& node) {
  std::size_t count = 1;
  for (const Item& item : node.items) count += valuesOf(item.value);
  return count;
}

bool says(Node& node, std::string_view key, std::string_view written) {
  const Item* item = node.find(key);
  return item && item->value.line == written;
}

std::string headOf(std::string_view key) {
  return text::quoteJson(key) + ": ";
}

// `own` over what it is like: objects merge, null takes away, anything else replaces. What is taken over stands where "like" does,
// else first. `other` is the pass `name`, or what it has under `group`.
Node laidOver(Node own, Node other, const std::string& name, std::string_view group) {
  constexpr std::string_view kOwn[] = {"name", "before", "after", "remove"};
  const auto refer = [&](std::string_view in, Item& item) {  // a parameter is declared once
    if (in == "parameters" && item.value.kind == Node::Kind::object)
      item.value = {.line = fmt::format("\"${}.{}\"", name, item.name()), .items = {}, .dangling = {}};
  };
  std::vector<Item> taken;
  for (Item& item : other.items) {
    const bool stays = group.empty() && std::ranges::find(kOwn, item.name()) != std::end(kOwn);
    if (stays || own.find(item.name())) continue;
    item.leading.clear();
    item.trailing.clear();
    refer(group, item);
    if (group.empty())
      for (Item& each : item.value.items) refer(item.name(), each);
    taken.push_back(item);
  }
  std::vector<Item> parts = std::exchange(own.items, group.empty() ? std::vector<Item>() : taken);
  for (Item& item : parts) {
    const Item* below = other.find(item.name());
    if (group.empty() && item.name() == "like") {
      if (!taken.empty()) taken.front().leading = item.leading;
      if (!taken.empty()) taken.back().trailing = item.trailing;
      own.items.insert(own.items.end(), taken.begin(), taken.end());
    } else if (below && below->value.kind == Node::Kind::object && item.value.kind == Node::Kind::object) {
      item.value = laidOver(std::move(item.value), below->value, name, item.name());
      if (!item.value.items.empty()) own.items.push_back(std::move(item));
    } else if (item.value.line != "null") {
      own.items.push_back(std::move(item));
    }
  }
  return own;
}

void writePassesWhole(Node& passes) {
  std::map<std::string_view, const Node*> whole;  // passes above, by name
  std::size_t written = 0;
  for (Item& stanza : passes.items) {
    const Item* like = stanza.value.find("like");
    const auto above = like ? whole.find(like->value.word()) : whole.end();
    if (above != whole.end() && (written += valuesOf(*above->second)) <= kMaxWritten)
      stanza.value = laidOver(stanza.value, *above->second, std::string(above->first), "");
    if (const Item* name = stanza.value.find("name"); name && stanza.value.find("type"))
      whole.try_emplace(name->value.word(), &stanza.value);
  }
}

// The '?' and the `if` of slots that read.
void mendSlots(Node& resources, Node& passes) {
  for (Item& stanza : passes.items)
    if (Item* members = stanza.value.find("passes")) mendSlots(resources, members->value);
  std::set<std::string> names, optional;
  for (Item& item : resources.items) {
    names.emplace(item.name());
    if (item.value.find("input") && says(item.value, "optional", "true")) optional.emplace(item.name());
  }
  for (Item& stanza : passes.items) {
    Item* slots = stanza.value.find("read");
    if (!slots || slots->value.kind != Node::Kind::object) continue;
    for (Item& slot : slots->value.items) {
      std::string_view ref = graph::trimmed(slot.value.word());
      const bool may = ref.ends_with('?');
      if (may) ref = graph::trimmed(ref.substr(0, ref.size() - 1));
      const std::string name(graph::dottedNameIn(ref));
      const std::size_t at = ref.find(" if ");
      const Item* pass = stanza.value.find("name");
      std::string mended(ref);
      if (at != std::string_view::npos) {
        if (name.empty() || !pass || stanza.value.find("repeat")) continue;
        // The list has the name of the slot, if it is free.
        std::string list(slot.name());
        if (names.contains(list)) list = std::string(pass->value.word()) + "_" + list;
        while (!names.insert(list).second) list += "_";
        Item& made = resources.items.emplace_back();
        made.key = headOf(list);
        made.value.kind = Node::Kind::array;
        made.value.items.emplace_back().value.line =
            text::quoteJson(name + " if " + std::string(graph::trimmed(ref.substr(at + 4))));
        mended = list + std::string(ref.substr(name.size(), at - name.size())) + (may ? " ?" : "");
      } else if (!may || !optional.contains(name)) {
        continue;
      }
      slot.value.line = text::quoteJson(mended);
    }
  }
}

void moveInputs(Node& root) {
  Item* const section = root.find("resources");
  if (!section || section->value.kind != Node::Kind::object) return;
  std::vector<Item>& resources = section->value.items;
  const auto first = std::ranges::stable_partition(resources, [](Item& item) {
                       const Item* input = item.value.find("input");
                       return !input || input->value.word().empty();
                     }).begin();
  if (first == resources.end()) return;
  Item inputs;
  inputs.key = headOf("inputs");
  inputs.value.kind = Node::Kind::array;
  inputs.leading = std::exchange(section->leading, {});
  inputs.blankBefore = std::exchange(section->blankBefore, false);
  for (Item& item : std::ranges::subrange(first, resources.end())) {
    const std::string name =
        text::quoteJson(std::string(item.name()) + (says(item.value, "optional", "true") ? " ?" : ""));
    std::erase_if(item.value.items,
                  [](const Item& each) { return each.name() == "input" || each.name() == "optional"; });
    Item& made = inputs.value.items.emplace_back();
    std::swap(made.leading, item.leading);
    std::swap(made.trailing, item.trailing);
    made.value.line = name;
    if (item.value.items.empty()) continue;
    made.value.kind = Node::Kind::object;
    item.key = name + ": ";
    made.value.items.push_back(std::move(item));
  }
  resources.erase(first, resources.end());
  const auto place = root.items.insert(root.items.begin() + (section - root.items.data()), std::move(inputs));
  if (place[1].value.items.empty()) root.items.erase(place + 1);
}

}  // namespace

std::string layoutGraph(std::string_view text) {
  return text::layoutJson(text, [](Node& root) {
    Item *resources = root.find("resources"), *passes = root.find("passes");
    if (passes) writePassesWhole(passes->value);
    if (passes && resources && !resources->value.items.empty()) mendSlots(resources->value, passes->value);
    moveInputs(root);
  });
}

}  // namespace weft::importing
