#include "engine/graph/read/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "engine/graph/language/names.h"
#include "engine/graph/read/read_context.h"
#include "engine/text/files/file.h"
#include "engine/text/limits.h"
#include "engine/text/nearest.h"
#include "graph_sentences.h"

namespace weft::graph {

using text::Code;
using Type = JsonValue::Type;

// ---- trees ----

JsonMember* memberOf(JsonValue& object, std::string_view key) {
  const auto found = std::ranges::find(object.members, key, &JsonMember::key);
  return found == object.members.end() ? nullptr : &*found;
}

std::string_view kindOf(const JsonValue& resource) {
  if (!resource.is(Type::object)) return "alternatives";
  for (const std::string_view kind : {"texture", "buffer", "import", "inputs"})
    if (const JsonValue* value = resource.find(kind); value && !value->is(Type::null)) return kind;
  return "";
}

namespace {

// The value and all that is in it.
std::uint64_t valuesOf(const JsonValue& value) {
  std::uint64_t count = 1;
  for (const JsonValue& item : value.items) count += valuesOf(item);
  for (const JsonMember& member : value.members) count += valuesOf(member.value);
  return count;
}

// The value that a stanza is called by; null when it has none.
const JsonValue* calledBy(const JsonValue& stanza) {
  for (const char* key : {"name", "as", "include"})
    if (const JsonValue* named = stanza.find(key)) return named;
  return nullptr;
}

}  // namespace

std::string includePrefix(const JsonValue& stanza) {
  const JsonValue *as = stanza.find("as"), *include = stanza.find("include");
  return as ? as->text : include ? std::filesystem::path(include->text).stem().string() : std::string();
}

std::string stanzaName(const JsonValue& stanza) {
  const JsonValue* name = stanza.find("name");
  return name ? name->text : includePrefix(stanza);
}

// ---- one overlay, laid over a source and the files that it includes ----

namespace {

using text::Diagnostic;

constexpr std::uint64_t kMaxChanges = 16'384;  // values of one overlay: each is looked for in what is below
constexpr std::uint64_t kMaxShared = 262'144;  // values of sets, counted for each pass that has them

// Where a whole name leads.
struct Spot {
  std::vector<std::string> below;  // the prefixes of the includes that it begins with, from the source down
  std::string own;                 // what is left of the name, in the file at their end
  std::optional<std::size_t> index = {};  // there, among members of the section or stanzas of "passes"
  Place declared = {};                    // of its name there
};

const JsonValue* sectionOf(const Source& source, std::string_view section) {
  const JsonValue* found = source.root.find(section);
  return found && found->is(section == "passes" ? Type::array : Type::object) ? found : nullptr;
}

// The stanza without "before", "after" and "remove", called `name` in its own file; without a name when that is "".
JsonValue withoutPlace(JsonValue stanza, std::string_view name) {
  std::erase_if(stanza.members, [&](const JsonMember& member) {
    return member.key == "before" || member.key == "after" || member.key == "remove" ||
           (name.empty() && (member.key == "name" || member.key == "as"));
  });
  for (JsonMember& member : stanza.members)
    if (member.key == "name" || member.key == "as") member.value.text = name;
  return stanza;
}

// What a pass stanza writes and modifies: the names of the resources.
std::vector<std::string> writtenBy(const JsonValue& stanza) {
  std::vector<std::string> names;
  for (const char* key : {"write", "modify"})
    for (const JsonMember& slot : membersIn(stanza, key))
      names.emplace_back(dottedNameIn(trimmed(slot.value.text)));
  return names;
}

// Whether an entry that is not there yet declares something, instead of changing it.
bool declares(std::string_view section, const JsonMember& entry) {
  if (entry.value.is(Type::null)) return false;
  if (section == "resources") return !kindOf(entry.value).empty();
  if (section == "let" || section == "sets" || !entry.value.is(Type::object)) return true;
  const JsonValue* initial = entry.value.find("default");
  return initial && (!initial->is(Type::string) || entry.value.find("choices") || entry.value.find("type"));
}

// The same of a stanza; its type may be that of a set or of its shader.
bool declaresPass(const JsonValue& stanza) {
  return stanza.find("type") || stanza.find("include") || stanza.find("use") || stanza.find("shader");
}

class Applier {
 public:
  Applier(SourceLoader& loader, Source& target, text::Diagnostics& diagnostics)
      : loader_(loader), target_(target), said_(diagnostics) {}

  // Passes first: other sections may reach into what the overlay includes.
  void run(const JsonValue& overlay, bool preset) {
    if (const std::uint64_t values = valuesOf(overlay); values > text::raised(kMaxChanges)) {
      said_.error(say::overlayTooLarge, overlay, text::hintToRaise(kMaxChanges, values));
      return;
    }
    if (const JsonValue* passes = overlay.find("passes");
        passes && said_.expect(*passes, Type::array, "\"passes\""))
      for (const JsonValue& stanza : passes->items)
        if (!stopped()) applyStanza(stanza);
    for (const JsonMember& member : overlay.members) {
      if (stopped()) return;
      const JsonValue& value = member.value;
      const bool section = member.key == "parameters" || member.key == "let" || member.key == "resources" ||
                           member.key == "sets";
      if (member.key == "extends" || member.key == "passes" ||
          (preset && (member.key == "name" || member.key == "description")))
        continue;
      if (member.key == "set") {
        if (said_.expect(value, Type::object, "\"set\""))
          for (const JsonMember& each : value.members)
            target_.sets.push_back({each, preset ? Origin::preset : Origin::overlay});
      } else if (section && value.is(Type::object)) {
        for (const JsonMember& entry : value.members)
          if (!stopped()) applyEntry(member, entry);
      } else {
        merge(target_.root, member);
      }
    }
  }

  // In a file that extends no other: lays stanzas that say where they stand over the others, each after what it names.
  void place() {
    JsonMember* const passes = memberOf(target_.root, "passes");
    const auto says = [](const JsonValue& stanza) { return anchorOf(stanza) || stanza.find("remove"); };
    if (!passes || std::ranges::none_of(passes->value.items, says)) return;
    std::vector<JsonValue> stay, waiting;
    for (JsonValue& stanza : passes->value.items) {
      dropRemove(stanza);
      const bool once = std::ranges::count(passes->value.items, stanzaName(stanza), stanzaName) == 1;
      (anchorOf(stanza) && once ? waiting : stay).push_back(stanza);
    }
    passes->value.items = std::move(stay);
    while (!waiting.empty() && !stopped()) {
      const auto next = std::ranges::find_if(waiting, [&](const JsonValue& stanza) {
        return std::ranges::find(waiting, anchorOf(stanza)->text, stanzaName) == waiting.end();
      });
      if (next == waiting.end()) {
        const JsonValue& anchor = *anchorOf(waiting[0]);
        said_.pass = stanzaName(waiting[0]);
        said_.error(say::waitForEachOther, anchor, said_.pass, anchor.text);
        std::ranges::move(waiting, std::back_inserter(passesOf(target_)));
        return;
      }
      applyStanza(*next);
      waiting.erase(next);
    }
  }

 private:
  static const JsonValue* anchorOf(const JsonValue& stanza) {
    const JsonValue* after = stanza.find("after");
    return after ? after : stanza.find("before");
  }

  void dropRemove(JsonValue& stanza) {
    std::erase_if(stanza.members, [&](const JsonMember& member) {
      if (member.key != "remove") return false;
      said_.pass = stanzaName(stanza);
      said_.error(say::removeWithoutExtends, member.place);
      return true;
    });
  }

  bool stopped() const { return loader_.tooMany() || !said_.goesOn(); }

  // Objects merge, null takes a member away, anything else replaces what is there.
  void merge(JsonValue& into, const JsonMember& over) {
    JsonMember* there = memberOf(into, over.key);
    if (over.value.is(Type::null)) {
      if (there)
        into.members.erase(into.members.begin() + (there - into.members.data()));
      else
        said_.error(say::nothingToTakeAway, over.place, over.key);
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
    for (const JsonMember& member : over.value.members) merge(there->value, member);
  }

  // ---- what is below ----

  // The file behind an include, as it is changed so far; null for another stanza, and for a circle, which the reader reports.
  std::shared_ptr<const Source> fileOf(const Source& source, const JsonValue& stanza) const {
    const JsonValue* include = stanza.find("include");
    if (!include || !include->is(Type::string)) return nullptr;
    if (const auto changed = source.changed.find(includePrefix(stanza)); changed != source.changed.end())
      return changed->second;
    const std::string path = pathBeside(*include);
    return loader_.isOpen(identityOf(path)) ? nullptr : loader_.file(path, include->place);
  }
  std::shared_ptr<const Source> includedBy(const Source& source, std::string_view prefix) const {
    if (const JsonValue* passes = sectionOf(source, "passes"))
      for (const JsonValue& stanza : passes->items)
        if (stanza.find("include") && includePrefix(stanza) == prefix) return fileOf(source, stanza);
    return nullptr;
  }

  Spot locate(std::string_view section, std::string_view name) const {
    Spot spot{{}, std::string(name)};
    std::shared_ptr<const Source> kept;
    const Source* at = &target_;
    for (std::size_t dot = 0; (dot = spot.own.find('.')) != std::string::npos;) {
      const std::string prefix = spot.own.substr(0, dot);
      kept = includedBy(*at, prefix);
      if (!kept) return spot;
      at = kept.get();
      spot.own.erase(0, dot + 1);
      spot.below.push_back(prefix);
    }
    const JsonValue* own = spot.own.empty() ? nullptr : sectionOf(*at, section);
    if (!own) return spot;
    const auto member = std::ranges::find(own->members, spot.own, &JsonMember::key);
    const auto stanza = std::ranges::find(own->items, spot.own, stanzaName);
    if (member != own->members.end()) {
      spot.index = member - own->members.begin();
      spot.declared = member->place;
    } else if (stanza != own->items.end()) {
      spot.index = stanza - own->items.begin();
      spot.declared = calledBy(*stanza)->place;
    }
    return spot;
  }

  // As locate(); what is there is also noted as named by the overlay at `place`.
  Spot find(std::string_view section, std::string_view name, const Place& place) {
    Spot spot = locate(section, name);
    if (spot.index) target_.named.push_back({std::string(name), place, spot.declared});
    return spot;
  }

  // "use" names sets of the file of the pass, which an overlay calls by their whole names or as that file does.
  JsonValue withSets(JsonValue stanza, const std::vector<std::string>& below) {
    if (JsonMember* use = memberOf(stanza, "use"))
      for (JsonValue& name :
           use->value.is(Type::string) ? std::span(&use->value, 1) : std::span(use->value.items))
        if (Spot set = locate("sets", name.text); set.below == below) {
          if (set.index)
            target_.named.push_back({name.text, name.place, set.declared});
          else
            name.place = name.place.after(name.text.size() - set.own.size());
          name.text = std::move(set.own);
        }
    return stanza;
  }

  // Where an overlay changes what a pass has of a set, the pass gets all of the set as its own, and uses it no more.
  void makeOwn(const Source& source, JsonValue& stanza, const JsonValue& over) {
    const JsonValue *use = stanza.find("use"), *sets = sectionOf(source, "sets");
    if (!use || !sets || over.find("use")) return;
    std::vector<JsonValue> kept;
    JsonValue own = stanza;
    for (const JsonValue& name : stringsOf(*use)) {
      const JsonValue* set = sets->find(name.text);
      const auto changes = [&](const JsonMember& group) {
        const JsonValue* found = over.find(group.key);
        return found && (!found->is(Type::object) || !isGroup(group.key) ||
                         std::ranges::any_of(found->members, [&](const auto& member) {
                           return group.value.find(member.key) != nullptr;
                         }));
      };
      if (!set || std::ranges::none_of(set->members, changes)) {
        kept.push_back(name);
        continue;
      }
      if (!loader_.mayShare(*set, over.place)) return;
      addSet(own, *set, [](const JsonMember&) {});
    }
    JsonMember& left = *memberOf(own, "use");
    if (kept.empty())
      own.members.erase(own.members.begin() + (&left - own.members.data()));
    else if (left.value.is(Type::array))
      left.value.items = std::move(kept);
    stanza = std::move(own);
  }

  // Adds every name in a section of a source and of all that it includes, its own first, without inputs: for hints. Looks at
  // `files` at most; too many, and circles, are the reader's to report.
  void addNames(const Source& source, std::string_view section, const std::string& prefix, std::size_t& files,
                std::vector<std::string>& names) const {
    if (const JsonValue* own = sectionOf(source, section)) {
      for (const JsonMember& member : own->members)
        if (!member.value.find("inputs")) names.push_back(prefix + member.key);
      for (const JsonValue& stanza : own->items)
        if (const std::string name = stanzaName(stanza); !name.empty()) names.push_back(prefix + name);
    }
    const bool deep = std::ranges::count(prefix, '.') >= 8;
    if (const JsonValue* passes = deep ? nullptr : sectionOf(source, "passes"))
      for (const JsonValue& stanza : passes->items)
        if (const auto child = files > 0 ? fileOf(source, stanza) : nullptr)
          addNames(*child, section, prefix + includePrefix(stanza) + ".", --files, names);
  }

  // What was meant by a name that is not there.
  struct Meant {
    std::vector<std::string> whole;  // the names that end in it, the shortest first
    std::string near, hint;
  };
  Meant meantBy(std::string_view wanted, std::string_view section) const {
    std::vector<std::string> names;
    std::size_t files = kMaxIncludes;
    addNames(target_, section, "", files, names);
    Meant meant{.whole = {}, .near = text::nearestName(wanted, names), .hint = suffixHint(wanted, names)};
    for (const std::size_t i : suffixMatches(names, wanted)) meant.whole.push_back(names[i]);
    std::ranges::stable_sort(meant.whole, {}, &std::string::size);
    if (meant.whole.empty()) return meant;
    meant.near = meant.whole[0];
    meant.hint = fmt::format("write the whole name, '{}'", meant.near) +
                 (meant.whole.size() > 1 ? fmt::format(" or '{}'", meant.whole[1]) : "");
    return meant;
  }

  // The file at the end of the prefixes, to be changed: a copy, kept beside its include. Null after a report.
  Source* open(const std::vector<std::string>& below, const Place& place) {
    Source* at = &target_;
    for (const std::string& prefix : below) {
      const std::shared_ptr<const Source> child = includedBy(*at, prefix);
      if (!own_.contains(child.get())) {
        if (!loader_.mayCopy(*child, place)) return nullptr;
        own_.insert((at->changed[prefix] = std::make_shared<Source>(*child)).get());
      }
      at = at->changed[prefix].get();
    }
    return at;
  }

  // ---- parameters, lets, resources ----

  void applyEntry(const JsonMember& section, JsonMember entry) {
    said_.resource = section.key == "resources" ? entry.key : "";
    const std::string whole = entry.key;
    const Spot spot = find(section.key, whole, entry.place);
    const bool dotted = spot.own.find('.') != std::string::npos;
    const bool fresh = !spot.index && declares(section.key, entry) && !dotted;
    if (!spot.index && !fresh) {
      const std::string hint = meantBy(whole, section.key).hint;
      said_.error(say::entryNotThere, entry.place, whole, section.key,
                  entry.value.is(Type::null) ? "removed" : "changed",
                  !hint.empty()                           ? hint
                  : section.key == "parameters" && dotted ? "use \"set\", or \"parameters\" of its pass"
                                                          : "write all of it to declare a new one");
    } else if (Source* source = open(spot.below, entry.place)) {
      entry.key = spot.own;  // "bloom.glow" is "glow" in its own file
      JsonMember* there = memberOf(source->root, section.key);
      if (!there) {
        there = &source->root.members.emplace_back(section);
        there->value.members.clear();
      }
      if (fresh && there->value.is(Type::object))
        there->value.members.push_back(entry);
      else if (!fresh &&
               (section.key != "resources" || mayMerge(there->value.members[*spot.index].value, entry)))
        merge(there->value, entry);
    }
    said_.resource.clear();
  }

  // False after a report: the entry makes another kind of resource of what is there.
  bool mayMerge(const JsonValue& there, const JsonMember& entry) {
    if (entry.value.is(Type::null)) return true;
    const std::string_view before = kindOf(there), over = kindOf(entry.value);
    const JsonValue* dropped = entry.value.find(before);
    const bool changes = there.is(Type::object) && entry.value.is(Type::object)
                             ? !over.empty() && over != before && !(dropped && dropped->is(Type::null))
                             : over.empty();
    if (!changes) return true;
    said_.error(say::resourceCannotBeMerged, entry.place, entry.key,
                before == "alternatives" ? "a reference or a list of references, or a whole resource"
                                         : fmt::format("keys of \"{0}\", or \"{0}\": null", before),
                over.empty() ? describe(entry.value) : fmt::format("\"{}\"", over));
    return false;
  }

  // ---- passes ----

  void applyStanza(const JsonValue& stanza) {
    if (!said_.expect(stanza, Type::object, "a pass")) return;
    if (!sectionOf(target_, "passes")) return;  // the reader says what is wrong with the base
    said_.pass = stanzaName(stanza);
    const JsonValue *after = stanza.find("after"), *remove = stanza.find("remove");
    if (stanza.find("before") && after)
      said_.error(say::beforeAndAfter, stanza.place);
    else if (remove && !remove->is(Type::boolean))
      said_.expect(*remove, Type::boolean, "\"remove\"");
    else if (const JsonValue* anchor = anchorOf(stanza))
      putAt(stanza, *anchor, after != nullptr);
    else
      change(stanza, remove && remove->flag);
    said_.pass.clear();
  }

  // An include called by its file, which cannot be read: the reader reports that, and the name may be wrong with it.
  bool isMisspeltInclude(std::string_view name) const {
    return std::ranges::any_of(sectionOf(target_, "passes")->items, [&](const JsonValue& stanza) {
      return stanzaName(stanza) == name && stanza.find("include") && !stanza.find("as") &&
             !fileOf(target_, stanza);
    });
  }

  std::vector<JsonValue>& passesOf(Source& source) { return memberOf(source.root, "passes")->value.items; }

  // A new pass, or one that moves.
  void putAt(const JsonValue& stanza, const JsonValue& anchor, bool after) {
    if (!said_.expect(anchor, Type::string, after ? "\"after\"" : "\"before\"")) return;
    Spot beside = find("passes", anchor.text, anchor.place);
    if (!beside.index) {
      const Meant meant = meantBy(anchor.text, "passes");
      if (!isMisspeltInclude(meant.near))
        said_.error(say::anchorNotThere, anchor.place, said_.pass, after ? "after" : "before", anchor.text,
                    meant.hint);
      // Where it was probably meant, else at the end, so that what stands beside it is no second mistake.
      if (!meant.near.empty()) beside = locate("passes", meant.near);
    }
    const JsonValue* named = calledBy(stanza);
    const Spot moved = find("passes", said_.pass, named ? named->place : stanza.place);
    const std::string own = moved.below == beside.below ? moved.own : said_.pass;
    if (!mayStand(stanza, anchor, beside, moved, own)) return;
    Source* source = open(beside.index ? beside.below : std::vector<std::string>(), anchor.place);
    if (!source) return;
    std::vector<JsonValue>& items = passesOf(*source);
    std::size_t at = beside.index ? *beside.index + (after ? 1 : 0) : items.size();
    JsonValue placed = withSets(withoutPlace(stanza, own), beside.below);
    if (beside.index && moved.index) {
      const auto there = items.begin() + static_cast<std::ptrdiff_t>(*moved.index);
      if (!mergeStanza(*source, *there, stanza, beside.below)) return;
      placed = withoutPlace(std::move(*there), own);
      items.erase(there);
      if (*moved.index < at) --at;
    }
    if (at > 0 && at < items.size() && !joinGroup(placed, items[at - 1], items[at])) return;
    items.insert(items.begin() + static_cast<std::ptrdiff_t>(at), std::move(placed));
  }

  // What comes between two passes of a group that repeats is one of them. False after a report.
  bool joinGroup(JsonValue& placed, const JsonValue& above, const JsonValue& below) {
    const JsonValue *group = above.find("passes"), *other = below.find("passes");
    if (!group || !other || !group->find("repeat") || group->place != other->place) return true;
    const JsonValue* own = placed.find("passes");
    if (!own) placed.members.push_back({"passes", group->place, *group});
    if (!own || own->place == group->place) return true;
    said_.error(say::betweenPassesOfGroup, placed.place, stanzaName(placed));
    return false;
  }

  // Whether the pass can stand beside the anchor, in whose file it is then called `own`; false after a report.
  bool mayStand(const JsonValue& stanza, const JsonValue& anchor, const Spot& beside, const Spot& moved,
                std::string_view own) {
    const JsonValue* named = stanza.find("name");
    const JsonValue& where = named ? *named : stanza;
    if (beside.index && moved.index && beside.below == moved.below) {
      if (*beside.index != *moved.index) return true;
      said_.error(say::standsBesideItself, anchor, said_.pass);
    } else if (beside.index && (moved.index || own.find('.') != std::string_view::npos)) {
      std::string whole;
      for (const std::string& prefix : beside.below) whole += prefix + ".";
      said_.error(say::anchorInOtherFile, where, said_.pass, anchor.text,
                  moved.index
                      ? "name a pass of its own file, or remove it and write a new one here"
                      : fmt::format("call it '{}{}'", whole, said_.pass.substr(said_.pass.rfind('.') + 1)));
    } else if (declaresPass(stanza)) {
      return true;
    } else {
      said_.error(say::passNotToBeMoved, where, said_.pass, meantBy(said_.pass, "passes").hint);
    }
    return false;
  }

  void change(const JsonValue& stanza, bool remove) {
    const JsonValue* named = calledBy(stanza);
    const Place place = named ? named->place : stanza.place;
    const Spot spot = find("passes", said_.pass, place);
    if (!spot.index) {
      const Meant meant = meantBy(said_.pass, "passes");
      remove ? said_.error(say::passNotToBeRemoved, place, said_.pass, meant.hint)
             : said_.error(say::passNotToBeChanged, place, said_.pass, meant.hint);
      if (!remove && declaresPass(stanza) && meant.whole.empty())
        passesOf(target_).push_back(withoutPlace(stanza, said_.pass));
      return;
    }
    Source* source = open(spot.below, place);
    if (!source) return;
    std::vector<JsonValue>& items = passesOf(*source);
    JsonValue& there = items[*spot.index];
    if (!remove) {
      mergeStanza(*source, there, stanza, spot.below);
      return;
    }
    source->removed.push_back({stanzaName(there), place, writtenBy(there)});
    source->changed.erase(stanzaName(there));
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(*spot.index));
  }

  // False after a report.
  bool mergeStanza(Source& source, JsonValue& there, const JsonValue& stanza,
                   const std::vector<std::string>& below) {
    const bool include = there.find("include") != nullptr;
    if (const JsonValue* culprit = stanza.find(include ? "type" : "include")) {
      said_.error(say::passCannotBeMerged, culprit->place, said_.pass,
                  include ? "keys of an include" : "keys of a pass");
      return false;
    }
    if (include && stanza.find("include")) {
      // Another file under the same prefix.
      source.changed.erase(includePrefix(there));
      if (!there.find("as")) {
        JsonMember as{"as", there.place, *there.find("include")};
        as.value.text = includePrefix(there);
        there.members.push_back(std::move(as));
      }
    }
    const JsonValue over = withSets(withoutPlace(stanza, ""), below);
    makeOwn(source, there, over);
    for (const JsonMember& member : over.members) merge(there, member);
    return true;
  }

  SourceLoader& loader_;
  Source& target_;
  ReadContext said_;             // with the pass or resource that is being applied
  std::set<const Source*> own_;  // copies that only this overlay has seen
};

// ---- files ----

// What "extends" names: a path, or a list of paths. Empty after a report.
std::span<const JsonValue> namesIn(const JsonValue& extends, text::Diagnostics& diagnostics) {
  const std::span<const JsonValue> names = stringsOf(extends);
  const auto wrong =
      std::ranges::find_if(names, [](const JsonValue& name) { return !name.is(Type::string); });
  if (!names.empty() && wrong == names.end()) return names;
  ReadContext(diagnostics)
      .wrongType(names.empty() ? extends : *wrong, "\"extends\"",
                 "the path of a graph, or a list of that and of overlays");
  return {};
}

// Whether a file without "extends" has passes that none before it has: no stanza says where it stands.
bool isWholeGraph(const JsonValue& root) {
  const JsonValue* passes = root.find("passes");
  if (!passes || passes->items.empty()) return false;
  return std::ranges::all_of(passes->items, [](const JsonValue& stanza) {
    return declaresPass(stanza) && !stanza.find("before") && !stanza.find("after");
  });
}

}  // namespace

std::string pathBeside(const JsonValue& written) {
  const std::filesystem::path from = written.place.file ? *written.place.file : std::string();
  return (from.parent_path() / written.text).lexically_normal().string();
}

std::string identityOf(const std::string& path) {
  // What may not be read is not followed either: it is what it is called.
  if (!text::mayRead(path)) return std::filesystem::path(path).lexically_normal().string();
  std::error_code ec;
  auto canonical = std::filesystem::canonical(path, ec);
  if (ec) canonical = std::filesystem::weakly_canonical(path, ec);  // slower; of one that is not there
  return ec ? path : canonical.string();
}

std::shared_ptr<const Source> SourceLoader::file(const std::string& path, const text::Place& from) {
  const std::string identity = identityOf(path);
  if (const auto known = known_.find(identity); known != known_.end()) return known->second;
  std::optional<JsonValue> root = parse(path, from, false);
  return known_[identity] = root ? complete(*std::move(root), path) : nullptr;
}

std::optional<JsonValue> SourceLoader::parse(const std::string& path, const text::Place& from, bool preset) {
  if (const auto found = options_.given.find(path); found != options_.given.end()) {
    texts_[path] = found->second;
  } else {
    std::optional<std::string> bytes = text::readTextFile(path, diagnostics_, Code::unreadableFile, from);
    if (bytes && bytes->size() > options_.mostFileBytes) {
      diagnostics_.error(say::fileTooLarge, from, options_.mostFileBytes, bytes->size());
      bytes.reset();
    }
    if (!bytes) return std::nullopt;
    texts_[path] = std::make_shared<const std::string>(*std::move(bytes));
  }
  std::optional<JsonValue> root = text::parseJson(*texts_[path], path, diagnostics_);
  if (root) mendKeys(*root, preset, diagnostics_);
  if (root) writeOutLists(*root, *this, diagnostics_);
  return root;
}

bool SourceLoader::mayAdd(std::uint64_t count, std::uint64_t& sum, std::uint64_t bound,
                          const text::Place& place, const char* message) {
  sum += count;
  if (!tooMany_ && sum <= text::raised(bound)) return true;
  if (!std::exchange(tooMany_, true))
    text::reportLimit(diagnostics_, place, message, bound, "values").found = fmt::format("{} so far", sum);
  return false;
}

bool SourceLoader::mayCopy(const Source& source, const text::Place& place) {
  return mayAdd(source.values, values_, text::kMaxValues, place,
                "the files of the graph and the copies that overlays change hold too many values");
}

bool SourceLoader::mayShare(const JsonValue& set, const text::Place& place) {
  return mayAdd(valuesOf(set), shared_, kMaxShared, place, "passes hold too much of sets and groups");
}

// A file without "extends" is a graph; one with it is what it extends, with the others of the list and itself laid over that.
std::shared_ptr<const Source> SourceLoader::complete(JsonValue root, const std::string& path) {
  // Bases are named: GCC 12 destroys nameless ones twice where a later member throws.
  Source source{FileDesc{.path = path, .files = {path}}, identityOf(path)};
  const JsonValue* set = root.find("set");
  const JsonValue* extends = root.find("extends");
  if (!extends && set && !root.find("passes")) {
    diagnostics_.error(say::presetNotGraph, set->place, path);
    return nullptr;
  }
  if (!extends) {
    if (set && set->is(Type::object)) {
      for (const JsonMember& member : set->members) source.sets.push_back({member, Origin::file});
      std::erase_if(root.members, [](const JsonMember& member) { return member.key == "set"; });
    }
    source.root = std::move(root);
    source.values = valuesOf(source.root);
    if (!mayCopy(source, source.root.place)) return nullptr;
    open_.emplace_back(source.identity, path);
    Applier(*this, source, diagnostics_).place();
    open_.pop_back();
    return std::make_shared<const Source>(std::move(source));
  }
  const std::span<const JsonValue> below = namesIn(*extends, diagnostics_);
  open_.emplace_back(source.identity, path);
  const std::shared_ptr<const Source> base =
      !below.empty() && mayExtend(below[0]) ? file(pathBeside(below[0]), below[0].place) : nullptr;
  bool good = base != nullptr;
  if (good) {
    source = *base;
    source.path = path;
    source.identity = identityOf(path);
    for (std::size_t i = 1; i < below.size(); ++i)
      good = layFile(source, pathBeside(below[i]), &below[i], false) && good;
    std::erase_if(source.root.members, [](const JsonMember& member) {  // of the base
      return member.key == "name" || member.key == "description";
    });
    good = good && lay(source, root, path, false);
    source.root.place = root.place;
    std::ranges::rotate(source.files, source.files.end() - 1);  // itself first
  }
  open_.pop_back();
  return good ? std::make_shared<const Source>(std::move(source)) : nullptr;
}

bool SourceLoader::mayExtend(const JsonValue& written) {
  const std::string below = pathBeside(written), identity = identityOf(below);
  const bool circle = isOpen(identity);
  if (!circle && open_.size() <= kMaxInRow) return true;
  std::string found;
  const auto again = std::ranges::find(open_, identity, &std::pair<std::string, std::string>::first);
  for (auto each = again; each != open_.end(); ++each) found += each->second + " -> ";
  circle ? diagnostics_.error(say::extendsItself, written.place, below, found + below)
         : diagnostics_.error(say::extendsTooLong, written.place, kMaxInRow, found + below);
  return false;
}

bool SourceLoader::isOpen(const std::string& identity) const {
  return std::ranges::find(open_, identity, &std::pair<std::string, std::string>::first) != open_.end();
}

std::shared_ptr<const Source> SourceLoader::withPreset(const Source& source, const std::string& path) {
  Source made = source;
  return layFile(made, path, nullptr, true) ? std::make_shared<const Source>(std::move(made)) : nullptr;
}

bool SourceLoader::layFile(Source& made, const std::string& path, const JsonValue* written, bool preset) {
  const std::string own = identityOf(path);
  if (written && (broken_.contains(own) || !mayExtend(*written))) {
    broken_.insert(own);
    return false;
  }
  const std::optional<JsonValue> root = parse(path, written ? written->place : text::Place{}, true);
  bool good = root && ReadContext(diagnostics_).expect(*root, Type::object, "a preset");
  const JsonValue* extends = good ? root->find("extends") : nullptr;
  if (good && !extends && isWholeGraph(*root) && (written || root->find("present"))) {
    diagnostics_.error(say::graphAsOverlay, (written ? *written : *root).place, path, made.path,
                       written
                           ? "a file extends one graph, the first of its list; give the others as includes"
                           : "include it in a graph, or check it by itself");
    good = false;
  }
  open_.emplace_back(own, path);
  if (extends) {
    const std::span<const JsonValue> below = namesIn(*extends, diagnostics_);
    good = !below.empty();
    for (const JsonValue& each : below) {
      const std::string file = pathBeside(each), identity = identityOf(file);
      const bool there = std::ranges::find(made.files, identity, identityOf) != made.files.end();
      if (there && !isOpen(identity)) continue;  // it is below already
      good = layFile(made, file, &each, preset) && good;
    }
  }
  good = good && lay(made, *root, path, preset);
  open_.pop_back();
  if (!good) broken_.insert(own);
  return good;
}

bool SourceLoader::lay(Source& made, const JsonValue& root, const std::string& path, bool preset) {
  if (!mayCopy(made, root.place)) return false;
  made.files.push_back(path);
  made.top = path;
  if (made.root.is(Type::object)) Applier(*this, made, diagnostics_).run(root, preset);
  made.values = valuesOf(made.root);
  return !tooMany_;
}

}  // namespace weft::graph
