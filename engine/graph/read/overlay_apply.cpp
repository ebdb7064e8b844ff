#include "engine/graph/read/overlay_apply.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "engine/base/limits.h"
#include "engine/base/nearest.h"
#include "engine/graph/language/enough.h"
#include "engine/graph/language/suffix.h"

namespace weft::graph {

namespace {

using base::Code;
using base::Diagnostic;
using base::JsonMember;
using base::JsonValue;
using Type = JsonValue::Type;

// Names that the entries of overlays may look through, for each value that all files may hold.
constexpr std::uint64_t kNamesPerValue = 8;

class Applier {
 public:
  Applier(SourceLoader& loader, Source& target, base::Diagnostics& diagnostics)
      : loader_(loader), target_(target), diagnostics_(diagnostics) {}

  // Passes first: other sections may reach into what the overlay includes.
  void run(const JsonValue& overlay, bool preset) {
    if (const JsonValue* passes = overlay.find("passes");
        passes && expect(*passes, Type::array, "\"passes\"", "an array"))
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
        if (expect(value, Type::object, "\"set\"", "an object of values by parameter"))
          for (const JsonMember& each : value.members)
            target_.sets.push_back({each, preset ? Origin::preset : Origin::overlay});
      } else if (section && value.is(Type::object)) {
        for (const JsonMember& entry : value.members)
          if (!stopped()) applyEntry(member, entry);
      } else {
        mergeMember(target_.root, member);
      }
    }
  }

 private:
  Diagnostic& error(Code code, const base::Place& place, std::string message) {
    Diagnostic& d = diagnostics_.error(code, place, std::move(message));
    d.pass = pass_;
    d.resource = resource_;
    return d;
  }

  bool stopped() const { return tooMuch_ || enoughErrors(diagnostics_); }

  // False after the report.
  bool lookThrough(std::size_t names, const base::Place& place) {
    looked_ += names;
    if (tooMuch_ || looked_ <= kNamesPerValue * base::raised(base::kMostValues)) return !tooMuch_;
    base::reportLimit(diagnostics_, place, "the overlay changes too much of a graph with too many names",
                      kNamesPerValue * base::kMostValues, "names looked through")
        .found = fmt::format("{} names looked through so far", looked_);
    tooMuch_ = true;
    return false;
  }

  bool expect(const JsonValue& value, Type type, const char* what, const char* expected) {
    if (value.is(type)) return true;
    Diagnostic& d = error(Code::wrongType, value.place, fmt::format("{} has the wrong type", what));
    d.expected = expected;
    d.found = describe(value);
    return false;
  }

  // ---- values ----

  void mergeMember(JsonValue& into, const JsonMember& over) {
    if (!lookThrough(into.members.size(), over.place)) return;
    JsonMember* there = memberOf(into, over.key);
    if (over.value.is(Type::null) && !keepsNull_) {
      if (there) {
        into.members.erase(into.members.begin() + (there - into.members.data()));
        return;
      }
      error(Code::nothingToChange, over.place,
            fmt::format("null takes \"{}\" away, which is not there", over.key))
          .hint = hintForKey(into, over.key);
    } else if (!over.value.is(Type::object)) {
      if (there)
        *there = over;
      else
        into.members.push_back(over);
    } else {
      if (!there || !there->value.is(Type::object)) {
        JsonMember empty{over.key, over.place, over.value};
        empty.value.members.clear();
        if (there)
          *there = std::move(empty);
        else
          there = &into.members.emplace_back(std::move(empty));
      }
      for (const JsonMember& member : over.value.members) mergeMember(there->value, member);
    }
  }

  // ---- what is below ----

  // Calls `change` with the source at the end of the prefixes: a copy, kept beside its include.
  template <class Change>
  void edit(Source& source, std::span<const std::string> below, const base::Place& place,
            const Change& change) {
    if (below.empty()) return change(source);
    std::shared_ptr<const Source> child = includeOf(loader_, source, below[0] + ".").source;
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

  // What `name` names; nothing when nothing has that name, or stopped().
  std::optional<Found> find(const std::string& section, std::string_view name, const base::Place& place) {
    std::uint64_t names = 0;
    std::optional<Found> found = findWhole(loader_, target_, section, name, names);
    if (found) target_.named.push_back({std::string(name), place, found->place});
    return lookThrough(names, place) ? found : std::nullopt;
  }

  // ---- parameters, lets, resources ----

  void applyEntry(const JsonMember& section, const JsonMember& entry) {
    const std::string noun = nounOf(section.key);
    resource_ = section.key == "resources" ? entry.key : "";
    const std::optional<Found> found = find(section.key, entry.key, entry.place);
    if (tooMuch_) return;
    const std::vector<std::string> below = found ? found->below : includesOf(loader_, target_, entry.key);
    const std::string own(nameBelow(entry.key, below));
    if (found) {
      edit(target_, below, entry.place, [&](Source& source) {
        mergeEntry(section.key, *memberOf(source.root, section.key), found->index, entry);
      });
    } else if (declares(section.key, entry) && own.find('.') == std::string::npos) {
      edit(target_, below, entry.place, [&](Source& source) {
        JsonMember* there = memberOf(source.root, section.key);
        if (!there) {
          there = &source.root.members.emplace_back(section);
          there->value.members.clear();
        }
        if (!there->value.is(Type::object)) return;
        there->value.members.push_back(entry);
        there->value.members.back().key = own;
      });
    } else {
      const std::string hint = wholeHint(entry.key, allNames(loader_, target_, section.key));
      error(Code::nothingToChange, entry.place,
            fmt::format("{} '{}' is not there to be {}", noun, entry.key,
                        entry.value.is(Type::null) ? "taken away" : "changed"))
          .hint = hint.empty() ? "write all of it to declare a new one" : hint;
    }
    resource_.clear();
  }

  void mergeEntry(const std::string& section, JsonMember& into, std::size_t index, const JsonMember& entry) {
    JsonMember& there = into.value.members[index];
    if (section == "resources" && !entry.value.is(Type::null)) {
      const std::string_view before = kindOf(there.value), over = kindOf(entry.value);
      const JsonValue* dropped = entry.value.find(before);
      const bool changes = there.value.is(Type::object) && entry.value.is(Type::object)
                               ? !over.empty() && over != before && !(dropped && dropped->is(Type::null))
                               : over.empty();
      if (changes) {
        Diagnostic& d = error(Code::kindsDoNotMerge, entry.place,
                              fmt::format("resource '{}' cannot be merged with what is there", entry.key));
        d.expected = before == "alternatives"
                         ? "a reference or a list of references"
                         : fmt::format("keys of {} {}", before.starts_with("i") ? "an" : "a", before);
        d.found = over.empty() ? describe(entry.value) : fmt::format("\"{}\"", over);
        d.hint = before == "alternatives" ? "write the whole resource, with its kind"
                                          : fmt::format("take the old kind away first: \"{}\": null", before);
        return;
      }
    }
    JsonMember over = entry;
    over.key = there.key;  // "bloom.glow" is "glow" in its own file
    mergeMember(into.value, over);
  }

  // ---- passes ----

  void applyStanza(const JsonValue& stanza) {
    if (!expect(stanza, Type::object, "a pass", "an object")) return;
    JsonValue* passes = passesOf(target_);
    if (!passes) return;  // the reader says what is wrong with the base
    pass_ = stanzaName(stanza);
    const JsonValue* before = stanza.find("before");
    const JsonValue* after = stanza.find("after");
    const JsonValue* remove = stanza.find("remove");
    if (before && after)
      error(Code::keysExclude, stanza.place, "a pass cannot stand both \"before\" and \"after\" others")
          .hint = "keep one of them";
    else if (remove && !remove->is(Type::boolean))
      expect(*remove, Type::boolean, "\"remove\"", "true or false");
    else if (const JsonValue* anchor = before ? before : after)
      putAt(stanza, *anchor, after != nullptr);
    else
      change(stanza, remove && remove->flag);
    pass_.clear();
  }

  // A new pass, or one that moves.
  void putAt(const JsonValue& stanza, const JsonValue& anchor, bool after) {
    if (!expect(anchor, Type::string, after ? "\"after\"" : "\"before\"", "the name of a pass or include"))
      return;
    std::optional<Found> beside = find("passes", anchor.text, anchor.place);
    if (tooMuch_) return;
    if (!beside) {
      const std::vector<std::string> names = allNames(loader_, target_, "passes");
      Diagnostic& d = error(Code::passWithoutPlace, anchor.place,
                            fmt::format("pass '{}' stands {} '{}', which is not there", pass_,
                                        after ? "after" : "before", anchor.text));
      d.expected = "the name of a pass, or the prefix of an include";
      d.hint = wholeHint(anchor.text, names);
      // Where it was probably meant, else at the end, so that what stands beside it is no second mistake.
      const std::vector<std::string> whole = wholeOf(anchor.text, names);
      beside = find("passes", whole.empty() ? base::nearestName(anchor.text, names) : whole[0], anchor.place);
      if (tooMuch_) return;
    }
    const std::optional<Found> moved = find("passes", pass_, stanza.place);
    std::string own(beside ? nameBelow(pass_, beside->below) : "");
    if (own.empty()) own = pass_;
    if (tooMuch_ || !mayStand(stanza, anchor, beside, moved, own)) return;
    if (!beside) {
      passesOf(target_)->items.push_back(withoutPlace(stanza, pass_));
      return;
    }
    edit(target_, beside->below, anchor.place, [&](Source& source) {
      std::vector<JsonValue>& items = passesOf(source)->items;
      std::size_t at = beside->index;
      JsonValue placed = withLike(withoutPlace(stanza, own), beside->below);
      if (moved) {
        const auto there = items.begin() + static_cast<std::ptrdiff_t>(moved->index);
        if (!mergeStanza(source, *there, stanza, beside->below)) return;
        placed = std::move(*there);
        items.erase(there);
        if (moved->index < at) --at;
      }
      items.insert(items.begin() + static_cast<std::ptrdiff_t>(at + (after ? 1 : 0)), std::move(placed));
    });
  }

  // Whether the pass can stand beside the anchor, in whose file it is then called `own`; false after a report.
  bool mayStand(const JsonValue& stanza, const JsonValue& anchor, const std::optional<Found>& beside,
                const std::optional<Found>& moved, std::string_view own) {
    const JsonValue* named = stanza.find("name");
    const JsonValue& culprit = named ? *named : stanza;
    if (beside && moved && beside->below == moved->below) {
      if (beside->index != moved->index) return true;
      error(Code::passWithoutPlace, anchor.place, fmt::format("pass '{}' stands beside itself", pass_)).hint =
          "name another pass";
    } else if (beside && (moved || own.find('.') != std::string_view::npos)) {
      std::string whole;
      for (const std::string& prefix : beside->below) whole += prefix + ".";
      error(Code::passWithoutPlace, culprit.place,
            fmt::format("pass '{}' cannot stand beside '{}', which is in another file", pass_, anchor.text))
          .hint = moved ? "name a pass of its own file, or remove it and write a new one here"
                        : fmt::format("call it '{}{}'", whole, pass_.substr(pass_.rfind('.') + 1));
    } else if (stanza.find("type") || stanza.find("include") || stanza.find("like")) {
      return true;
    } else {
      error(Code::passWithoutPlace, culprit.place, fmt::format("pass '{}' is not there to be moved", pass_))
          .hint = wholeHint(pass_, allNames(loader_, target_, "passes"));
    }
    return false;
  }

  // "like" names a pass of the same file, which an overlay calls by its whole name or as that file does.
  static JsonValue withLike(JsonValue stanza, const std::vector<std::string>& below) {
    if (JsonMember* like = memberOf(stanza, "like"))
      if (const std::string_view own = nameBelow(like->value.text, below); !own.empty())
        like->value.text = std::string(own);
    return stanza;
  }

  void change(const JsonValue& stanza, bool remove) {
    const JsonValue* named = stanza.find("name");
    if (!named) named = stanza.find("as") ? stanza.find("as") : stanza.find("include");
    const base::Place place = named ? named->place : stanza.place;
    const std::optional<Found> found = find("passes", pass_, place);
    if (tooMuch_) return;
    if (!found && remove) {
      error(Code::nothingToChange, place, fmt::format("pass '{}' is not there to be removed", pass_)).hint =
          wholeHint(pass_, allNames(loader_, target_, "passes"));
    } else if (!found) {
      const std::vector<std::string> names = allNames(loader_, target_, "passes");
      Diagnostic& d =
          error(Code::passWithoutPlace, place,
                fmt::format("pass '{}' is not there to be changed, and a new one needs a place", pass_));
      d.expected = "the name of a pass, or \"before\" or \"after\" one";
      d.hint = wholeHint(pass_, names);
      if ((stanza.find("type") || stanza.find("include")) && wholeOf(pass_, names).empty())
        passesOf(target_)->items.push_back(withoutPlace(stanza, pass_));
    } else {
      edit(target_, found->below, place, [&](Source& source) {
        std::vector<JsonValue>& items = passesOf(source)->items;
        if (!remove) {
          mergeStanza(source, items[found->index], stanza, found->below);
          return;
        }
        const JsonValue& gone = items[found->index];
        source.removed.push_back({stanzaName(gone), place, writtenBy(gone)});
        source.changed.erase(stanzaName(gone));
        items.erase(items.begin() + static_cast<std::ptrdiff_t>(found->index));
      });
    }
  }

  // False after a report.
  bool mergeStanza(Source& source, JsonValue& there, const JsonValue& stanza,
                   const std::vector<std::string>& below) {
    const bool include = there.find("include") != nullptr;
    if (include ? stanza.find("type") != nullptr : stanza.find("include") != nullptr) {
      const JsonValue& culprit = *stanza.find(include ? "type" : "include");
      Diagnostic& d = error(Code::kindsDoNotMerge, culprit.place,
                            fmt::format("'{}' cannot be merged with what is there", pass_));
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
    keepsNull_ = there.find("like") != nullptr;
    for (const JsonMember& member : over.members) mergeMember(there, member);
    keepsNull_ = false;
    return true;
  }

  SourceLoader& loader_;
  Source& target_;
  base::Diagnostics& diagnostics_;
  std::string pass_, resource_;  // what is being applied
  std::uint64_t looked_ = 0;     // names, by all entries so far
  bool tooMuch_ = false;         // reported; nothing more is applied
  bool keepsNull_ = false;       // in a pass that is like another null stays, for the keys of the other
};

}  // namespace

void applyOverlay(SourceLoader& loader, const JsonValue& overlay, bool preset, Source& target,
                  base::Diagnostics& diagnostics) {
  Applier(loader, target, diagnostics).run(overlay, preset);
}

}  // namespace weft::graph
