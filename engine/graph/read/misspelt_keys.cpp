#include "engine/graph/read/misspelt_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/language/enough.h"
#include "engine/graph/language/keys.h"
#include "engine/graph/read/overlay_apply.h"
#include "engine/graph/read/read_context.h"

namespace weft::graph {

namespace {

using base::Foreign;
using base::JsonMember;
using base::JsonValue;
using Type = JsonValue::Type;
using KeyLists = std::initializer_list<std::span<const KeySpec>>;

class KeyMender {
 public:
  KeyMender(bool preset, base::Diagnostics& diagnostics) : overlay_(preset), diagnostics_(diagnostics) {}

  void run(JsonValue& root) {
    if (std::ranges::any_of(kSceneKeys, [&](std::string_view key) { return root.find(key); })) return;
    mend(root, {kGraphKeys}, {"a graph"}, Foreign::graph_key);
    overlay_ = overlay_ || root.find("extends");
    for (JsonMember& section : root.members) {
      if (section.key == "parameters") mendParameters(section.value);
      if (section.key == "resources")
        for (JsonMember& member : section.value.members) mendResource(member);
      if (section.key == "passes")
        for (JsonValue& stanza : section.value.items) mendPass(stanza);
    }
  }

 private:
  // What an object is called in a message: "the texture 'cells'", "a pass".
  struct Called {
    std::string_view noun;
    const std::string* name = nullptr;
  };

  void mendParameters(JsonValue& parameters) {
    for (JsonMember& member : parameters.members)
      mend(member.value, {kParameterKeys}, {"the parameter", &member.key}, Foreign::value_key);
  }

  void mendResource(JsonMember& member) {
    resource_ = &member.key;
    if (kindOf(member.value).empty()) mend(member.value, {kKinds}, {"the resource", &member.key});
    const std::string_view kind = kindOf(member.value);
    if (kind == "texture")
      mend(member.value, {kTextureKeys}, {"the texture", &member.key}, Foreign::texture_key);
    if (kind == "buffer") mend(member.value, {kBufferKeys}, {"the buffer", &member.key});
    if (kind == "input") mend(member.value, {kInputKeys}, {"the input", &member.key});
    resource_ = nullptr;
  }

  void mendPass(JsonValue& stanza) {
    stanza_ = &stanza;
    const std::span<const KeySpec> places = overlay_ ? kPlaceKeys : std::span<const KeySpec>();
    if (!stanza.find("include") && !stanza.find("type") && !stanza.find("like") && !stanza.find("shader"))
      mend(stanza, {kIncludeKey}, {"an include"});
    if (stanza.find("include")) {
      mend(stanza, {kIncludeKeys, places}, {"an include"});
    } else {
      mend(stanza, {kPassKeys, places}, {"a pass"}, Foreign::pass_key);
      for (JsonMember& member : stanza.members) {
        if (member.key == "parameters") mendParameters(member.value);
        if (member.key == "state") mend(member.value, {kStateKeys}, {"\"state\""}, Foreign::state_key);
      }
    }
    stanza_ = nullptr;
  }

  void mend(JsonValue& object, KeyLists lists, Called what, std::optional<Foreign> foreign = {}) {
    for (JsonMember& member : object.members) {
      if (isKnown(member.key, lists)) continue;
      if (enoughErrors(diagnostics_)) return;
      auto [meant, hint] = meantBy(member.key, lists, foreign);
      if (meant.empty() || object.find(meant)) continue;
      auto& d = diagnostics_.error(
          base::Code::unknownKey, member.place,
          what.name ? fmt::format("unknown key \"{}\" in {} '{}'", member.key, what.noun, *what.name)
                    : fmt::format("unknown key \"{}\" in {}", member.key, what.noun));
      if (stanza_) d.pass = stanzaName(*stanza_);
      if (resource_) d.resource = *resource_;
      d.hint = std::move(hint);
      member.key = std::move(meant);
    }
  }

  static bool isKnown(std::string_view key, KeyLists lists) {
    return std::ranges::any_of(lists, [&](std::span<const KeySpec> keys) {
      return std::ranges::find(keys, key, &KeySpec::key) != keys.end();
    });
  }

  // The key, and what is said of it: one slip away, or the word of another program for it. "" for what is farther off, whose
  // value may be meant for anything.
  static std::pair<std::string, std::string> meantBy(std::string_view key, KeyLists lists,
                                                     std::optional<Foreign> foreign) {
    std::vector<std::string> known;
    for (const std::span<const KeySpec> keys : lists)
      for (const KeySpec& spec : keys) known.emplace_back(spec.key);
    // A word of another program first: "groups" is no slip of "group".
    if (const base::ForeignWord theirs = foreign ? base::findForeignWord(*foreign, key) : base::ForeignWord();
        !theirs.hint.empty())
      return theirs.isOnlyKey ? std::pair(theirs.key, theirs.hint) : std::pair<std::string, std::string>();
    std::string nearest = base::nearestName(key, known);
    if (nearest.empty() || base::editDistance(key, nearest, 2) > 1) return {};
    std::string hint = fmt::format("did you mean \"{}\"?", nearest);
    return {std::move(nearest), std::move(hint)};
  }

  static constexpr std::array<KeySpec, 4> kKinds{
      {{"texture", "", ""}, {"buffer", "", ""}, {"import", "", ""}, {"input", "", ""}}};
  static constexpr std::array<KeySpec, 1> kIncludeKey{{{"include", "", ""}}};

  bool overlay_;
  base::Diagnostics& diagnostics_;
  const JsonValue* stanza_ = nullptr;  // that is being looked at
  const std::string* resource_ = nullptr;
};

}  // namespace

void mendKeys(JsonValue& root, bool preset, base::Diagnostics& diagnostics) {
  KeyMender(preset, diagnostics).run(root);
}

}  // namespace weft::graph
