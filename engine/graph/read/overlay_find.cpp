// What overlays name, found in the sources below them.
#include <algorithm>

#include "engine/base/limits.h"
#include "engine/graph/language/suffix.h"
#include "engine/graph/read/overlay_apply.h"

namespace weft::graph {

namespace {

using base::JsonMember;
using base::JsonValue;
using Type = JsonValue::Type;

// The file behind an include of the source, as it is changed so far; null for a circle, which is the reader's to report.
std::shared_ptr<const Source> fileOf(SourceLoader& loader, const Source& source, const JsonValue& stanza) {
  const JsonValue* include = stanza.find("include");
  if (!include || !include->is(Type::string)) return nullptr;
  if (const auto changed = source.changed.find(includePrefix(stanza)); changed != source.changed.end())
    return changed->second;
  const std::string path = pathBeside(*include);
  return loader.isOpen(identityOf(path)) ? nullptr : loader.file(path, include->place);
}

const JsonValue* sectionOf(const Source& source, const std::string& section) {
  const JsonValue* found = source.root.find(section);
  return found && found->is(section == "passes" ? Type::array : Type::object) ? found : nullptr;
}

class Lister {
 public:
  Lister(SourceLoader& loader, const std::string& section) : loader_(loader), section_(section) {}

  void look(const Source& source, const std::string& prefix) {
    if (const JsonValue* section = sectionOf(source, section_)) {
      for (const JsonMember& member : section->members)
        if (!member.value.find("input")) names.push_back(prefix + member.key);
      for (const JsonValue& stanza : section->items)
        if (const std::string name = stanzaName(stanza); !name.empty()) names.push_back(prefix + name);
    }
    const JsonValue* passes = sectionOf(source, "passes");
    if (!passes) return;
    open_.push_back(source.identity);
    for (const JsonValue& stanza : passes->items) {
      // Too many of them, and too many in a row, are the reader's to report; so is a circle.
      if (open_.size() >= kMostInRow) break;
      const std::shared_ptr<const Source> child = fileOf(loader_, source, stanza);
      if (!child || std::ranges::find(open_, child->identity) != open_.end()) continue;
      if (++looked_ >= base::raised(kMostIncludes)) break;
      look(*child, prefix + includePrefix(stanza) + ".");
    }
    open_.pop_back();
  }

  std::vector<std::string> names;

 private:
  SourceLoader& loader_;
  const std::string& section_;
  std::vector<std::string> open_;
  std::uint64_t looked_ = 0;  // includes, each use counted
};

}  // namespace

JsonMember* memberOf(JsonValue& object, std::string_view key) {
  for (JsonMember& member : object.members)
    if (member.key == key) return &member;
  return nullptr;
}

std::string hintForKey(const JsonValue& object, std::string_view key) {
  std::vector<std::string> keys;
  for (const JsonMember& member : object.members) keys.push_back(member.key);
  const std::string hint = suffixHint(key, keys);
  return hint.empty() ? "leave it out" : hint;
}

std::string_view kindOf(const JsonValue& resource) {
  if (!resource.is(Type::object)) return "alternatives";
  for (const std::string_view kind : {"texture", "buffer", "import", "input"})
    if (const JsonValue* value = resource.find(kind); value && !value->is(Type::null)) return kind;
  return "";
}

std::string nounOf(const std::string& section) {
  return section == "passes" ? "pass" : section == "let" ? "let" : section.substr(0, section.size() - 1);
}

Below includeOf(SourceLoader& loader, const Source& source, std::string_view name) {
  const JsonValue* passes = sectionOf(source, "passes");
  if (!passes || name.find('.') == std::string_view::npos) return {};
  for (const JsonValue& stanza : passes->items) {
    if (!stanza.find("include")) continue;
    const std::string prefix = includePrefix(stanza);
    if (name.size() > prefix.size() && name.starts_with(prefix) && name[prefix.size()] == '.')
      return {prefix, fileOf(loader, source, stanza)};
  }
  return {};
}

std::optional<Found> findWhole(SourceLoader& loader, const Source& source, const std::string& section,
                               std::string_view name, std::uint64_t& looked) {
  if (const JsonValue* own = sectionOf(source, section)) {
    looked += own->members.size() + own->items.size();
    for (std::size_t i = 0; i < own->members.size(); ++i)
      if (own->members[i].key == name) return Found{{}, i, own->members[i].place};
    for (std::size_t i = 0; i < own->items.size(); ++i)
      if (!name.empty() && stanzaName(own->items[i]) == name)
        for (const char* key : {"name", "as", "include"})
          if (const JsonValue* named = own->items[i].find(key)) return Found{{}, i, named->place};
  }
  const Below below = includeOf(loader, source, name);
  if (!below.source) return {};
  std::optional<Found> found =
      findWhole(loader, *below.source, section, name.substr(below.prefix.size() + 1), looked);
  if (found) found->below.insert(found->below.begin(), below.prefix);
  return found;
}

std::vector<std::string> allNames(SourceLoader& loader, const Source& source, const std::string& section) {
  Lister lister(loader, section);
  lister.look(source, "");
  return std::move(lister.names);
}

std::vector<std::string> includesOf(SourceLoader& loader, const Source& source, std::string_view name) {
  std::vector<std::string> below;
  std::shared_ptr<const Source> kept;
  for (const Source* at = &source;;) {
    Below next = includeOf(loader, *at, name);
    if (!next.source) return below;
    name.remove_prefix(next.prefix.size() + 1);
    below.push_back(std::move(next.prefix));
    kept = std::move(next.source);
    at = kept.get();
  }
}

std::string_view nameBelow(std::string_view name, const std::vector<std::string>& below) {
  for (const std::string& prefix : below) {
    if (name.size() <= prefix.size() || !name.starts_with(prefix) || name[prefix.size()] != '.') return {};
    name.remove_prefix(prefix.size() + 1);
  }
  return name;
}

std::vector<std::string> wholeOf(std::string_view wanted, const std::vector<std::string>& names) {
  std::vector<std::string> whole;
  for (const std::size_t i : suffixMatches(names, wanted))
    if (std::ranges::find(whole, names[i]) == whole.end()) whole.push_back(names[i]);
  std::ranges::stable_sort(whole, {}, &std::string::size);
  return whole;
}

std::string wholeHint(std::string_view wanted, const std::vector<std::string>& names) {
  const std::vector<std::string> whole = wholeOf(wanted, names);
  if (whole.empty()) return suffixHint(wanted, names);
  std::string hint = "write the whole name, '" + whole[0] + "'";
  for (std::size_t i = 1; i < std::min<std::size_t>(whole.size(), 3); ++i) hint += " or '" + whole[i] + "'";
  return hint;
}

std::string stanzaName(const JsonValue& stanza) {
  const JsonValue* name = stanza.find("name");
  return name ? name->text : includePrefix(stanza);
}

std::vector<std::string> writtenBy(const JsonValue& stanza) {
  std::vector<std::string> names;
  for (const char* key : {"write", "modify"})
    if (const JsonValue* slots = stanza.find(key))
      for (const JsonMember& slot : slots->members) {
        std::string name = slot.value.text.substr(0, slot.value.text.find_first_of(" [@"));
        for (const char* part : {".mip", ".layer", ".face", ".stencil"})
          if (name.ends_with(part)) name.resize(name.size() - std::string_view(part).size());
        names.push_back(std::move(name));
      }
  return names;
}

JsonValue* passesOf(Source& source) {
  JsonMember* passes = memberOf(source.root, "passes");
  return passes && passes->value.is(Type::array) ? &passes->value : nullptr;
}

JsonValue withoutPlace(const JsonValue& stanza, std::string_view name) {
  JsonValue out = stanza;
  std::erase_if(out.members, [&](const JsonMember& member) {
    return member.key == "before" || member.key == "after" || member.key == "remove" ||
           (name.empty() && (member.key == "name" || member.key == "as"));
  });
  for (JsonMember& member : out.members)
    if (member.key == "name" || member.key == "as") member.value.text = name;
  return out;
}

bool declares(const std::string& section, const JsonMember& entry) {
  if (entry.value.is(Type::null)) return false;
  if (section == "resources") return !kindOf(entry.value).empty();
  if (section == "let" || !entry.value.is(Type::object)) return true;
  const JsonValue* initial = entry.value.find("default");
  return initial && (!initial->is(Type::string) || entry.value.find("choices") || entry.value.find("type"));
}

}  // namespace weft::graph
