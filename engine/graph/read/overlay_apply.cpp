// What one overlay changes in a source and in the files that it includes. Declared in overlay.h.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "engine/graph/language/suffix.h"
#include "engine/graph/read/merge.h"
#include "engine/graph/read/overlay.h"
#include "engine/graph/read/read_context.h"
#include "engine/text/limits.h"
#include "engine/text/nearest.h"

namespace weft::graph {

namespace {

using text::Code;
using text::Diagnostic;
using Type = JsonValue::Type;

constexpr std::uint64_t kMaxChanges = 16'384;  // values of one overlay: each is looked for in what is below

const JsonValue* sectionOf(const Source& source, std::string_view section) {
  const JsonValue* found = source.root.find(section);
  return found && found->is(section == "passes" ? Type::array : Type::object) ? found : nullptr;
}

JsonValue* passesOf(Source& source) {
  JsonMember* passes = memberOf(source.root, "passes");
  return passes && passes->value.is(Type::array) ? &passes->value : nullptr;
}

// Where a whole name leads.
struct Spot {
  std::vector<std::string> below;    // the prefixes of the includes that it begins with, from the source down
  std::string own;                   // what is left of the name, in the file at their end
  std::optional<std::size_t> index;  // there, among the members of the section or the stanzas of "passes"
  text::Place declared;              // of its name there
};

// The stanza without "before", "after" and "remove", called `name` in its own file; without a name when that is "".
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

// The value that a stanza is called by; null when it has none.
const JsonValue* calledBy(const JsonValue& stanza) {
  for (const char* key : {"name", "as", "include"})
    if (const JsonValue* named = stanza.find(key)) return named;
  return nullptr;
}

// What a pass stanza writes and modifies: the names of the resources.
std::vector<std::string> writtenBy(const JsonValue& stanza) {
  std::vector<std::string> names;
  for (const char* key : {"write", "modify"})
    if (const JsonValue* slots = stanza.find(key))
      for (const JsonMember& slot : slots->members) {
        std::string name = slot.value.text.substr(0, slot.value.text.find_first_of(" [@"));
        for (const std::string_view part : {".mip", ".layer", ".face", ".stencil"})
          if (name.ends_with(part)) name.resize(name.size() - part.size());
        names.push_back(std::move(name));
      }
  return names;
}

// Whether an entry that is not there yet declares something, instead of changing it.
bool declares(std::string_view section, const JsonMember& entry) {
  if (entry.value.is(Type::null)) return false;
  if (section == "resources") return !kindOf(entry.value).empty();
  if (section == "let" || !entry.value.is(Type::object)) return true;
  const JsonValue* initial = entry.value.find("default");
  return initial && (!initial->is(Type::string) || entry.value.find("choices") || entry.value.find("type"));
}

// Those of the names that end in one that is not whole, the shortest first.
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
  return fmt::format("write the whole name, '{}'", whole[0]) +
         (whole.size() > 1 ? fmt::format(" or '{}'", whole[1]) : "");
}

class Applier {
 public:
  Applier(SourceLoader& loader, Source& target, text::Diagnostics& diagnostics)
      : loader_(loader), target_(target), diagnostics_(diagnostics), said_(diagnostics) {}

  // Passes first: other sections may reach into what the overlay includes.
  void run(const JsonValue& overlay, bool preset) {
    if (const std::uint64_t values = valuesOf(overlay); values > text::raised(kMaxChanges)) {
      text::reportLimit(diagnostics_, overlay.place, "the overlay changes too much", kMaxChanges, "values",
                        values);
      return;
    }
    if (const JsonValue* passes = overlay.find("passes");
        passes && said_.expect(*passes, Type::array, "\"passes\""))
      for (const JsonValue& stanza : passes->items)
        if (!stopped()) applyStanza(stanza);
    for (const JsonMember& member : overlay.members) {
      if (stopped()) return;
      const JsonValue& value = member.value;
      const bool section = member.key == "parameters" || member.key == "let" || member.key == "resources";
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

 private:
  bool stopped() const { return tooMuch_ || !said_.goesOn(); }

  // In a pass that is like another, null stays, for the keys of the other.
  void merge(JsonValue& into, const JsonMember& over, bool keepsNull = false) {
    const auto nothingThere = [&](const JsonValue& in, const JsonMember& none) {
      said_
          .error(Code::nothingToChange, none.place,
                 fmt::format("null takes \"{}\" away, which is not there", none.key))
          .hint = hintForKey(in, none.key);
    };
    Merge{.keepsNull = keepsNull, .nothingThere = nothingThere}.run(into, over);
  }

  // ---- what is below ----

  // The file behind the include of that prefix, as it is changed so far; null when there is none, and for a circle, which is the
  // reader's to report.
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
    Spot spot{{}, std::string(name), {}};
    const Source* at = &target_;
    std::shared_ptr<const Source> kept;
    for (std::size_t dot = 0; (dot = spot.own.find('.')) != std::string::npos;) {
      std::string prefix = spot.own.substr(0, dot);
      std::shared_ptr<const Source> child = includedBy(*at, prefix);
      if (!child) return spot;
      spot.own.erase(0, dot + 1);
      spot.below.push_back(std::move(prefix));
      kept = std::move(child);
      at = kept.get();
    }
    const JsonValue* own = spot.own.empty() ? nullptr : sectionOf(*at, section);
    for (std::size_t i = 0; own && i < own->members.size() && !spot.index; ++i)
      if (own->members[i].key == spot.own) {
        spot.index = i;
        spot.declared = own->members[i].place;
      }
    for (std::size_t i = 0; own && i < own->items.size() && !spot.index; ++i)
      if (stanzaName(own->items[i]) == spot.own) {
        spot.index = i;
        spot.declared = calledBy(own->items[i])->place;
      }
    return spot;
  }

  // As locate(); what is there is also noted as named by the overlay at `place`.
  Spot find(std::string_view section, std::string_view name, const text::Place& place) {
    Spot spot = locate(section, name);
    if (spot.index) target_.named.push_back({std::string(name), place, spot.declared});
    return spot;
  }

  // "like" names a pass of the same file, which an overlay calls by its whole name or as that file does.
  JsonValue withLike(JsonValue stanza, const std::vector<std::string>& below) const {
    if (JsonMember* like = memberOf(stanza, "like"))
      if (Spot other = locate("passes", like->value.text); other.below == below)
        like->value.text = std::move(other.own);
    return stanza;
  }

  // Every name in a section of the target and of all it includes, its own first, without inputs: for hints.
  std::vector<std::string> allNames(const std::string& section) const {
    std::vector<std::string> names, open;
    std::uint64_t looked = 0;  // includes, each use counted
    const auto look = [&](const auto& self, const Source& source, const std::string& prefix) -> void {
      if (const JsonValue* own = sectionOf(source, section)) {
        for (const JsonMember& member : own->members)
          if (!member.value.find("input")) names.push_back(prefix + member.key);
        for (const JsonValue& stanza : own->items)
          if (const std::string name = stanzaName(stanza); !name.empty()) names.push_back(prefix + name);
      }
      const JsonValue* passes = sectionOf(source, "passes");
      open.push_back(source.identity);
      for (std::size_t i = 0; passes && i < passes->items.size(); ++i) {
        // Too many of them, and too many in a row, are the reader's to report; so is a circle.
        const std::shared_ptr<const Source> child =
            open.size() < kMaxInRow && looked < kMaxIncludes ? fileOf(source, passes->items[i]) : nullptr;
        if (!child || std::ranges::find(open, child->identity) != open.end()) continue;
        ++looked;
        self(self, *child, prefix + includePrefix(passes->items[i]) + ".");
      }
      open.pop_back();
    };
    look(look, target_, "");
    return names;
  }

  // Calls `change` with the source at the end of the prefixes: a copy, kept beside its include.
  template <class Change>
  void edit(Source& source, std::span<const std::string> below, const text::Place& place,
            const Change& change) {
    if (below.empty()) return change(source);
    std::shared_ptr<const Source> child = includedBy(source, below[0]);
    // A copy that nobody else has seen is changed as it is.
    std::shared_ptr<const Source>& kept = source.changed[below[0]];
    std::shared_ptr<Source> copy;
    if (kept && kept.use_count() == 2) {  // `kept` and `child`
      copy = std::const_pointer_cast<Source>(kept);
    } else {
      if (!loader_.mayCopy(*child, place)) {
        tooMuch_ = true;
        return;
      }
      copy = std::make_shared<Source>(*child);
    }
    kept = copy;
    edit(*copy, below.subspan(1), place, change);
  }

  // ---- parameters, lets, resources ----

  void applyEntry(const JsonMember& section, const JsonMember& entry) {
    said_.resource = section.key == "resources" ? entry.key : "";
    const Spot spot = find(section.key, entry.key, entry.place);
    if (spot.index) {
      edit(target_, spot.below, entry.place, [&](Source& source) {
        JsonMember& there = *memberOf(source.root, section.key);
        if (section.key == "resources" && !mayMerge(there.value.members[*spot.index].value, entry)) return;
        JsonMember over = entry;
        over.key = spot.own;  // "bloom.glow" is "glow" in its own file
        merge(there.value, over);
      });
    } else if (declares(section.key, entry) && spot.own.find('.') == std::string::npos) {
      edit(target_, spot.below, entry.place, [&](Source& source) {
        JsonMember* there = memberOf(source.root, section.key);
        if (!there) {
          there = &source.root.members.emplace_back(section);
          there->value.members.clear();
        }
        if (!there->value.is(Type::object)) return;
        there->value.members.push_back(entry);
        there->value.members.back().key = spot.own;
      });
    } else {
      const std::string hint = wholeHint(entry.key, allNames(section.key));
      said_
          .error(Code::nothingToChange, entry.place,
                 fmt::format("'{}' of \"{}\" is not there to be {}", entry.key, section.key,
                             entry.value.is(Type::null) ? "taken away" : "changed"))
          .hint = hint.empty() ? "write all of it to declare a new one" : hint;
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
    Diagnostic& d = said_.error(Code::kindsDoNotMerge, entry.place,
                                fmt::format("resource '{}' cannot be merged with what is there", entry.key));
    d.expected = before == "alternatives" ? "a reference or a list of references"
                                          : fmt::format("keys of \"{}\"", before);
    d.found = over.empty() ? describe(entry.value) : fmt::format("\"{}\"", over);
    d.hint = before == "alternatives" ? "write the whole resource, with its kind"
                                      : fmt::format("take the old kind away first: \"{}\": null", before);
    return false;
  }

  // ---- passes ----

  void applyStanza(const JsonValue& stanza) {
    if (!said_.expect(stanza, Type::object, "a pass")) return;
    if (!passesOf(target_)) return;  // the reader says what is wrong with the base
    said_.pass = stanzaName(stanza);
    const JsonValue* before = stanza.find("before");
    const JsonValue* after = stanza.find("after");
    const JsonValue* remove = stanza.find("remove");
    if (before && after)
      said_.error(Code::keysExclude, stanza.place, "a pass cannot stand both \"before\" and \"after\" others")
          .hint = "keep one of them";
    else if (remove && !remove->is(Type::boolean))
      said_.expect(*remove, Type::boolean, "\"remove\"");
    else if (const JsonValue* anchor = before ? before : after)
      putAt(stanza, *anchor, after != nullptr);
    else
      change(stanza, remove && remove->flag);
    said_.pass.clear();
  }

  // A new pass, or one that moves.
  void putAt(const JsonValue& stanza, const JsonValue& anchor, bool after) {
    if (!said_.expect(anchor, Type::string, after ? "\"after\"" : "\"before\"")) return;
    Spot beside = find("passes", anchor.text, anchor.place);
    if (!beside.index) {
      const std::vector<std::string> names = allNames("passes");
      Diagnostic& d = said_.error(Code::passWithoutPlace, anchor.place,
                                  fmt::format("pass '{}' stands {} '{}', which is not there", said_.pass,
                                              after ? "after" : "before", anchor.text));
      d.expected = "the name of a pass, or the prefix of an include";
      d.hint = wholeHint(anchor.text, names);
      // Where it was probably meant, else at the end, so that what stands beside it is no second mistake.
      const std::vector<std::string> whole = wholeOf(anchor.text, names);
      beside = locate("passes", whole.empty() ? text::nearestName(anchor.text, names) : whole[0]);
    }
    const JsonValue* named = calledBy(stanza);
    const Spot moved = find("passes", said_.pass, named ? named->place : stanza.place);
    const std::string own = moved.below == beside.below ? moved.own : said_.pass;
    if (!mayStand(stanza, anchor, beside, moved, own)) return;
    if (!beside.index) {
      passesOf(target_)->items.push_back(withoutPlace(stanza, said_.pass));
      return;
    }
    edit(target_, beside.below, anchor.place, [&](Source& source) {
      std::vector<JsonValue>& items = passesOf(source)->items;
      std::size_t at = *beside.index;
      JsonValue placed = withLike(withoutPlace(stanza, own), beside.below);
      if (moved.index) {
        const auto there = items.begin() + static_cast<std::ptrdiff_t>(*moved.index);
        if (!mergeStanza(source, *there, stanza, beside.below)) return;
        placed = std::move(*there);
        items.erase(there);
        if (*moved.index < at) --at;
      }
      items.insert(items.begin() + static_cast<std::ptrdiff_t>(at + (after ? 1 : 0)), std::move(placed));
    });
  }

  // Whether the pass can stand beside the anchor, in whose file it is then called `own`; false after a report.
  bool mayStand(const JsonValue& stanza, const JsonValue& anchor, const Spot& beside, const Spot& moved,
                std::string_view own) {
    const JsonValue* named = stanza.find("name");
    const JsonValue& culprit = named ? *named : stanza;
    if (beside.index && moved.index && beside.below == moved.below) {
      if (*beside.index != *moved.index) return true;
      said_
          .error(Code::passWithoutPlace, anchor.place,
                 fmt::format("pass '{}' stands beside itself", said_.pass))
          .hint = "name another pass";
    } else if (beside.index && (moved.index || own.find('.') != std::string_view::npos)) {
      std::string whole;
      for (const std::string& prefix : beside.below) whole += prefix + ".";
      said_
          .error(Code::passWithoutPlace, culprit.place,
                 fmt::format("pass '{}' cannot stand beside '{}', which is in another file", said_.pass,
                             anchor.text))
          .hint = moved.index
                      ? "name a pass of its own file, or remove it and write a new one here"
                      : fmt::format("call it '{}{}'", whole, said_.pass.substr(said_.pass.rfind('.') + 1));
    } else if (stanza.find("type") || stanza.find("include") || stanza.find("like")) {
      return true;
    } else {
      said_
          .error(Code::passWithoutPlace, culprit.place,
                 fmt::format("pass '{}' is not there to be moved", said_.pass))
          .hint = wholeHint(said_.pass, allNames("passes"));
    }
    return false;
  }

  void change(const JsonValue& stanza, bool remove) {
    const JsonValue* named = calledBy(stanza);
    const text::Place place = named ? named->place : stanza.place;
    const Spot spot = find("passes", said_.pass, place);
    if (!spot.index) {
      const std::vector<std::string> names = allNames("passes");
      Diagnostic& d = said_.error(remove ? Code::nothingToChange : Code::passWithoutPlace, place,
                                  fmt::format("pass '{}' is not there to be {}", said_.pass,
                                              remove ? "removed" : "changed, and a new one needs a place"));
      if (!remove) d.expected = "the name of a pass, or \"before\" or \"after\" one";
      d.hint = wholeHint(said_.pass, names);
      if (!remove && (stanza.find("type") || stanza.find("include")) && wholeOf(said_.pass, names).empty())
        passesOf(target_)->items.push_back(withoutPlace(stanza, said_.pass));
      return;
    }
    edit(target_, spot.below, place, [&](Source& source) {
      std::vector<JsonValue>& items = passesOf(source)->items;
      JsonValue& there = items[*spot.index];
      if (!remove) {
        mergeStanza(source, there, stanza, spot.below);
        return;
      }
      source.removed.push_back({stanzaName(there), place, writtenBy(there)});
      source.changed.erase(stanzaName(there));
      items.erase(items.begin() + static_cast<std::ptrdiff_t>(*spot.index));
    });
  }

  // False after a report.
  bool mergeStanza(Source& source, JsonValue& there, const JsonValue& stanza,
                   const std::vector<std::string>& below) {
    const bool include = there.find("include") != nullptr;
    if (const JsonValue* culprit = stanza.find(include ? "type" : "include")) {
      Diagnostic& d = said_.error(Code::kindsDoNotMerge, culprit->place,
                                  fmt::format("'{}' cannot be merged with what is there", said_.pass));
      d.expected = include ? "keys of an include" : "keys of a pass";
      d.found = include ? "a pass" : "an include";
      d.hint = "remove the one, and give the other a name of its own";
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
    const JsonValue over = withLike(withoutPlace(stanza, ""), below);
    const bool keepsNull = there.find("like") != nullptr;
    for (const JsonMember& member : over.members) merge(there, member, keepsNull);
    return true;
  }

  SourceLoader& loader_;
  Source& target_;
  text::Diagnostics& diagnostics_;
  ReadContext said_;      // with the pass or resource that is being applied
  bool tooMuch_ = false;  // reported; nothing more is applied
};

}  // namespace

void applyOverlay(SourceLoader& loader, const JsonValue& overlay, bool preset, Source& target,
                  text::Diagnostics& diagnostics) {
  Applier(loader, target, diagnostics).run(overlay, preset);
}

}  // namespace weft::graph
