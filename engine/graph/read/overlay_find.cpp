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

class Finder {
 public:
  Finder(SourceLoader& loader, const std::string& section) : loader_(loader), section_(section) {}

  void look(const Source& source, const std::string& prefix) {
    const JsonValue* section = source.root.find(section_);
    if (section && section->is(Type::object))
      for (std::size_t i = 0; i < section->members.size(); ++i)
        if (!section->members[i].value.find("input"))
          found.push_back({prefix + section->members[i].key, below_, i});
    const JsonValue* passes = source.root.find("passes");
    if (!passes || !passes->is(Type::array)) return;
    if (section_ == "passes")
      for (std::size_t i = 0; i < passes->items.size(); ++i)
        if (const std::string name = stanzaName(passes->items[i]); !name.empty())
          found.push_back({prefix + name, below_, i});
    open_.push_back(source.identity);
    for (const JsonValue& stanza : passes->items) {
      const JsonValue* include = stanza.find("include");
      if (!include || !include->is(Type::string)) continue;
      const std::string name = includePrefix(stanza), path = pathBeside(*include);
      // A circle of includes is the reader's to report.
      const std::string identity = identityOf(path);
      if (loader_.isOpen(identity) || std::find(open_.begin(), open_.end(), identity) != open_.end())
        continue;
      // So are too many of them, and too many in a row.
      if (++looked_ >= base::limitOf(base::Limit::include_files) ||
          open_.size() >= base::limitOf(base::Limit::include_depth))
        break;
      const auto changed = source.changed.find(name);
      const std::shared_ptr<const Source> child =
          changed != source.changed.end() ? changed->second : loader_.file(path, include->place);
      if (!child) continue;
      below_.push_back(name);
      look(*child, prefix + name + ".");
      below_.pop_back();
    }
    open_.pop_back();
  }

  std::vector<Found> found;

 private:
  SourceLoader& loader_;
  const std::string& section_;
  std::vector<std::string> below_, open_;
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

std::string namesOf(const std::vector<Found>& all, const std::vector<std::size_t>& some) {
  std::string text;
  for (const std::size_t i : some) text += (text.empty() ? "" : ", ") + all[i].name;
  return text;
}

std::vector<Found> findAll(SourceLoader& loader, const Source& source, const std::string& section) {
  Finder finder(loader, section);
  finder.look(source, "");
  return std::move(finder.found);
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

JsonValue withoutPlace(const JsonValue& stanza, bool named) {
  JsonValue out = stanza;
  std::erase_if(out.members, [&](const JsonMember& member) {
    return member.key == "before" || member.key == "after" || member.key == "remove" ||
           (!named && (member.key == "name" || member.key == "as"));
  });
  return out;
}

bool isWhole(const std::string& section, const JsonMember& entry) {
  if (entry.value.is(Type::null) || entry.key.find('.') != std::string::npos) return false;
  if (section == "resources") return !kindOf(entry.value).empty();
  return section == "let" || !entry.value.is(Type::object) || entry.value.find("default");
}

}  // namespace weft::graph
