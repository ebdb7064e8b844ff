// Declared in read_context.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/graph/read/overlay.h"
#include "engine/graph/read/read_context.h"
#include "engine/text/nearest.h"
#include "graph_sentences.h"

namespace weft::graph {

namespace {

using text::Code;
using Type = JsonValue::Type;
using KeyLists = std::initializer_list<std::span<const KeySpec>>;

constexpr std::array<KeySpec, 3> kKinds{{{"texture", ""}, {"buffer", ""}, {"import", ""}}};
constexpr std::array<KeySpec, 1> kInput{{{"inputs", ""}}};  // of a resource that was an input

// Which words of other programs are looked up for the keys of an object; "" for none.
std::string_view foreignOf(const Shape& shape) {
  if (shape.kind == "pass" || shape.kind == "set") return "pass_key";
  if (shape.kind == "parameter") return "value_key";
  return shape.kind == "texture" ? "texture_key" : shape.kind == "state" ? "state_key" : "";
}

bool takes(const Shape& shape, Type type) {
  return shape.types == 0 || (shape.types >> static_cast<unsigned>(type) & 1) != 0;
}

// What of a choice of shapes fits the type of a value: the last whose first key it has, else the first. Null when none does.
const Shape* branchFor(const Shape& shape, const JsonValue& value) {
  if (shape.anyOf.empty()) return takes(shape, value.type) ? &shape : nullptr;
  const Shape* found = nullptr;
  for (const Shape* each : shape.anyOf)
    if (const Shape* branch = branchFor(*each, value);
        branch && (!found || (!branch->keys.empty() && value.find(branch->keys[0].key))))
      found = branch;
  return found;
}

std::string expectedText(const Shape& shape) {
  std::vector<std::string> all;
  if (!shape.anyOf.empty() && !shape.kind.empty() && !shape.doc.empty()) return std::string(shape.doc);
  for (const Shape* each : shape.anyOf) all.push_back(expectedText(*each));
  for (unsigned type = 0; shape.anyOf.empty() && type <= static_cast<unsigned>(Type::object); ++type)
    if (shape.types >> type & 1) all.emplace_back(nameOf(static_cast<Type>(type)));
  if (shape.minItems > 0 && !all.empty()) all.back() += fmt::format(" of at least {}", shape.minItems);
  return fmt::format("{}", fmt::join(all, " or "));
}

class ShapeCheck {
 public:
  // `mends`: keys of one file are mended; else a whole graph is checked.
  ShapeCheck(bool mends, bool overlay, text::Diagnostics& diagnostics)
      : mends_(mends), overlay_(overlay), said_(diagnostics) {}

  void run(JsonValue& root) {
    checkKeys(root, {shapeOfFile(false).keys}, "graph", "graph_key");
    overlay_ = overlay_ || root.find("extends");
    for (JsonMember& section : root.members) {
      const KeySpec* const spec = shapeOfFile(false).find(section.key);
      if (!spec) continue;
      if (section.key == "passes" && section.value.is(Type::array)) {
        for (JsonValue& stanza : section.value.items) checkPass(stanza);
      } else if (section.key == "resources" && section.value.is(Type::object)) {
        for (JsonMember& member : section.value.members) checkResource(member);
      } else {
        checkValue(section.value, *spec->shape, section.key, spec->doc);
      }
    }
  }

 private:
  void checkResource(JsonMember& member) {
    JsonValue& value = member.value;
    said_.resource = member.key;
    if (value.find("inputs")) {
      if (!mends_) checkObject(value, shapeOf("input"), "input", kInput);
      return said_.resource.clear();
    }
    if (mends_ && kindOf(value).empty()) checkKeys(value, {kKinds}, member.key);
    const auto kinds =
        std::ranges::count_if(kKinds, [&](const KeySpec& kind) { return value.find(kind.key) != nullptr; });
    if (!value.is(Type::object) || kinds == 1) {
      checkValue(value, shapeOf("resource"), member.key, "a resource");
    } else if (!mends_) {
      const std::string hint =
          value.find("input")
              ? fmt::format("write \"inputs\": [\"{}\"] beside \"resources\"; `weft format` does", member.key)
              : "say one of \"texture\", \"buffer\" and \"import\"";
      if (kinds > 0)
        said_.error(say::ofTwoKinds, value, member.key, hint);
      else if (member.key.find('.') == std::string::npos)  // else its name is the mistake
        said_.error(say::saysNotWhatItIs, value, member.key, hint);
      drop(value);
    }
    said_.resource.clear();
  }

  void checkPass(JsonValue& stanza) {
    if (stanza.is(Type::absent)) return;
    said_.pass = stanzaName(stanza);
    const auto says = [&](const char* key) { return stanza.find(key) != nullptr; };
    if (mends_ && says("passes")) return checkGroup(stanza);
    if (mends_ && !says("include") && !says("type") && !says("shader"))
      checkKeys(stanza, {std::span(shapeOf("include").keys).first(1)}, "include");
    if (const JsonMember* like = mends_ ? nullptr : memberOf(stanza, "like")) {  // of the first edition
      said_.error(say::passLike, like->place);
      drop(stanza);
      return said_.pass.clear();
    }
    const Shape& shape = shapeOf(says("include") ? "include" : "pass");
    const auto ofGroup = std::ranges::stable_partition(
        stanza.members, [](const JsonMember& member) { return member.key != "passes"; });  // checked
    std::vector<JsonMember> checked(ofGroup.begin(), ofGroup.end());
    stanza.members.erase(ofGroup.begin(), ofGroup.end());
    if (stanza.is(Type::object))
      checkObject(stanza, shape, shape.kind, overlay_ ? placeKeys() : std::span<const KeySpec>());
    else
      checkValue(stanza, shape, shape.kind, shape.doc);
    std::ranges::move(checked, std::back_inserter(stanza.members));
    said_.pass.clear();
  }

  // What a group says is checked once, before each of its passes gets it; what does not fit goes.
  void checkGroup(JsonValue& group) {
    const Shape& shape = shapeOf("group");
    const std::span<const KeySpec> places = overlay_ ? placeKeys() : std::span<const KeySpec>();
    std::vector<JsonValue> members = std::exchange(memberOf(group, "passes")->value.items, {});
    checkObject(group, shape, "group", places);
    mends_ = false;
    checkObject(group, shape, "group", places);
    mends_ = true;
    std::erase_if(group.members, [](const JsonMember& member) {
      return member.value.is(Type::absent) && member.key != "passes";
    });
    for (JsonValue& stanza : members) checkPass(stanza);
    memberOf(group, "passes")->value.items = std::move(members);
    said_.pass.clear();
  }

  static void drop(JsonValue& value) {
    value.type = Type::absent;
    value.items.clear();
    value.members.clear();
  }

  // False after a report. `doc` is what the schema says of the key.
  bool checkValue(JsonValue& value, const Shape& shape, std::string_view key, std::string_view doc,
                  bool item = false) {
    const Shape* branch = branchFor(shape, value);
    bool good = branch && value.items.size() <= branch->maxItems &&
                (!value.is(Type::array) || value.items.size() >= branch->minItems);
    if (!good && mends_) return false;
    if (!good)
      said_.wrongType(value, fmt::format("{}\"{}\"", item ? "an item of " : "", key), expectedText(shape))
          .hint = doc.empty() || doc == expectedText(shape) ? "" : fmt::format("\"{}\": {}", key, doc);
    if (good && branch->items)
      for (JsonValue& each : value.items) good = good && checkValue(each, *branch->items, key, doc, true);
    // Beside words there may be calls, such as every(n).
    const bool call =
        value.text.find('(') != std::string::npos && !shape.anyOf.empty() && shape.anyOf.back()->open;
    if (good && value.is(Type::string) && !branch->open && !call && !mends_)
      good = checkWord(value, *branch, key);
    if (good && value.is(Type::object)) checkObject(value, *branch, key);
    if (!good && !mends_) drop(value);
    return good;
  }

  bool checkWord(JsonValue& value, const Shape& shape, std::string_view key) {
    if (std::ranges::find(shape.words, value.text) != shape.words.end()) return true;
    auto& d = said_.error(say::unknownWord, value, value.text, key);
    d.expected = fmt::format("{}", fmt::join(shape.words, ", "));
    if (shape.kind == "parameterType") d.hint = text::hintForForeign("value_type", value.text);
    const std::string nearest =
        text::nearestName(value.text, std::vector<std::string>(shape.words.begin(), shape.words.end()));
    if (!d.hint.empty() || nearest.empty()) return false;
    d.hint = fmt::format("did you mean \"{}\"?", nearest);
    value.text = nearest;
    return true;
  }

  void checkObject(JsonValue& object, const Shape& shape, std::string_view what,
                   std::span<const KeySpec> more = {}) {
    if (!shape.keys.empty() && !shape.others) checkKeys(object, {shape.keys, more}, what, foreignOf(shape));
    for (JsonMember& member : object.members) {
      if (!said_.goesOn()) return;
      if (const KeySpec* const spec = shape.find(member.key))
        checkValue(member.value, *spec->shape, member.key, spec->doc);
      else if (shape.others)
        checkValue(member.value, *shape.others, member.key, shape.others->doc);
    }
  }

  void checkKeys(JsonValue& object, KeyLists lists, std::string_view what, std::string_view foreign = {}) {
    if (!object.is(Type::object)) return;
    const auto isKnown = [&](std::string_view key) {
      return std::ranges::any_of(
          lists, [&](const auto& keys) { return std::ranges::find(keys, key, &KeySpec::key) != keys.end(); });
    };
    std::vector<std::string> known, meant;
    for (JsonMember& member : object.members) {
      if (isKnown(member.key)) continue;
      if (!said_.goesOn()) return;
      known.clear();
      for (const std::span<const KeySpec> keys : lists)
        for (const KeySpec& spec : keys) known.emplace_back(spec.key);
      const bool ofState = foreign == "pass_key" && shapeOf("state").find(member.key);
      // A word of another program first.
      const text::ForeignWord theirs =
          ofState || foreign.empty() ? text::ForeignWord() : text::findForeignWord(foreign, member.key);
      const std::string nearest = theirs.hint.empty() ? text::nearestName(member.key, known) : theirs.key;
      const bool sure =
          !ofState && !nearest.empty() && !object.find(nearest) &&
          (theirs.hint.empty() ? text::editDistance(member.key, nearest, 2) <= 1 : theirs.isOnlyKey);
      if (mends_ && !sure) continue;
      said_.error(say::unknownKey, member.place, member.key, what,
                  ofState ? fmt::format("it is a key of \"state\": {{ \"{}\": … }}", member.key)
                  : !theirs.hint.empty() ? theirs.hint
                  : nearest.empty()      ? fmt::format("known: {}", fmt::join(known, ", "))
                                         : fmt::format("did you mean \"{}\"?", nearest));
      meant.push_back(nearest);
      if (mends_) member.key = nearest;
    }
    if (mends_) return;
    for (const std::span<const KeySpec> keys : lists)
      for (const KeySpec& spec : keys)
        if (spec.required && !object.find(spec.key) && stanzaName(object).find('.') == std::string::npos &&
            std::ranges::find(meant, spec.key) == meant.end())
          said_.error(say::lacksKey, object.place, what, spec.key, spec.doc);
  }

  bool mends_, overlay_;
  ReadContext said_;
};

}  // namespace

void mendKeys(JsonValue& root, bool preset, text::Diagnostics& diagnostics) {
  ShapeCheck(true, preset, diagnostics).run(root);
}

void checkShape(JsonValue& root, text::Diagnostics& diagnostics) {
  ShapeCheck(false, false, diagnostics).run(root);
}

}  // namespace weft::graph
