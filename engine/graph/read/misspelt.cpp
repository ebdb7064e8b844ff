#include "engine/graph/read/misspelt.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/graph/desc_walk.h"
#include "engine/graph/read/merge.h"
#include "engine/graph/read/read_context.h"
#include "engine/text/nearest.h"

namespace weft::graph {

namespace {

using text::Code;
using text::Foreign;
using Type = JsonValue::Type;
using KeyLists = std::initializer_list<std::span<const KeySpec>>;

constexpr std::array<KeySpec, 4> kKinds{{{"texture", ""}, {"buffer", ""}, {"import", ""}, {"input", ""}}};

// Value: JsonValue, to mend a file; const JsonValue, to check a whole graph.
template <class Value>
class KeyCheck {
 public:
  KeyCheck(bool overlay, text::Diagnostics& diagnostics) : overlay_(overlay), said_(diagnostics) {}

  void run(Value& root) {
    check(root, {kGraphKeys}, "a graph", Foreign::graph_key);
    overlay_ = overlay_ || root.find("extends");
    for (auto& section : root.members) {
      if (section.key == "parameters") checkParameters(section.value);
      if (section.key == "resources")
        for (auto& member : section.value.members) checkResource(member.key, member.value);
      if (section.key == "passes")
        for (auto& stanza : section.value.items) checkPass(stanza);
    }
  }

 private:
  static constexpr bool kMends = !std::is_const_v<Value>;

  void checkParameters(Value& parameters) {
    for (auto& member : parameters.members)
      check(member.value, {kParameterKeys}, fmt::format("the parameter '{}'", member.key),
            Foreign::value_key);
  }

  void checkResource(const std::string& name, Value& value) {
    said_.resource = name;
    if (kMends && kindOf(value).empty()) check(value, {kKinds}, fmt::format("the resource '{}'", name));
    const auto is = [&](const char* kind) { return value.find(kind) != nullptr; };
    // What is of two kinds at once is the reader's to report.
    if (!is("import") && is("texture") + is("buffer") + is("input") == 1) {
      if (is("texture"))
        check(value, {kTextureKeys}, fmt::format("the texture '{}'", name), Foreign::texture_key);
      if (is("buffer")) check(value, {kBufferKeys}, fmt::format("the buffer '{}'", name));
      if (is("input")) check(value, {kInputKeys}, fmt::format("the input '{}'", name));
    }
    said_.resource.clear();
  }

  void checkPass(Value& stanza) {
    said_.pass = stanzaName(stanza);
    alike_ = stanza.find("like") != nullptr;
    const std::span<const KeySpec> places = overlay_ ? kPlaceKeys : std::span<const KeySpec>();
    if (kMends && !stanza.find("include") && !stanza.find("type") && !alike_ && !stanza.find("shader"))
      check(stanza, {std::span(kIncludeKeys).first(1)}, "an include");
    if (stanza.find("include")) {
      check(stanza, {kIncludeKeys, places}, "an include");
    } else {
      check(stanza, {kPassKeys, places}, "a pass", Foreign::pass_key);
      for (auto& member : stanza.members) {
        if (member.key == "parameters") checkParameters(member.value);
        if (member.key == "state") check(member.value, {kStateKeys}, "\"state\"", Foreign::state_key);
        if (member.key == "shader") check(member.value, {kShaderKeys}, "\"shader\"");
      }
    }
    said_.pass.clear();
    alike_ = false;
  }

  void check(Value& object, KeyLists lists, const std::string& what, std::optional<Foreign> foreign = {}) {
    if (!object.is(Type::object)) return;
    std::vector<std::string> known, meant;
    for (const std::span<const KeySpec> keys : lists)
      for (const KeySpec& spec : keys) known.emplace_back(spec.key);
    for (auto& member : object.members) {
      if (std::ranges::find(known, member.key) != known.end()) continue;
      if (!said_.goesOn()) return;
      const bool ofState = foreign == Foreign::pass_key &&
                           std::ranges::find(kStateKeys, member.key, &KeySpec::key) != kStateKeys.end();
      // A word of another program first: "groups" is no slip of "group".
      const text::ForeignWord theirs =
          foreign && !ofState ? text::findForeignWord(*foreign, member.key) : text::ForeignWord();
      const std::string nearest = theirs.hint.empty() ? text::nearestName(member.key, known) : theirs.key;
      const bool sure =
          !ofState && !nearest.empty() && !object.find(nearest) &&
          (theirs.hint.empty() ? text::editDistance(member.key, nearest, 2) <= 1 : theirs.isOnlyKey);
      if (kMends && !sure) continue;
      said_.error(Code::unknownKey, member.place, fmt::format("unknown key \"{}\" in {}", member.key, what))
          .hint = ofState ? fmt::format("it is a key of \"state\": {{ \"{}\": … }}", member.key)
                  : !theirs.hint.empty() ? theirs.hint
                  : nearest.empty()      ? fmt::format("known: {}", fmt::join(known, ", "))
                                         : fmt::format("did you mean \"{}\"?", nearest);
      meant.push_back(nearest);
      if constexpr (kMends) member.key = nearest;
    }
    if (kMends) return;
    for (const std::span<const KeySpec> keys : lists)
      for (const KeySpec& spec : keys)
        if (spec.required && (!alike_ || spec.key == "name") && !object.find(spec.key) &&
            std::ranges::find(meant, spec.key) == meant.end())
          said_.error(Code::missingKey, object.place, fmt::format("{} lacks the key \"{}\"", what, spec.key))
              .hint = fmt::format("\"{}\": {}", spec.key, spec.doc);
  }

  bool overlay_, alike_ = false;  // alike_: the pass at hand takes its keys from another
  ReadContext said_;
};

}  // namespace

void mendKeys(JsonValue& root, bool preset, text::Diagnostics& diagnostics) {
  KeyCheck<JsonValue>(preset, diagnostics).run(root);
}

void checkKeys(const JsonValue& root, text::Diagnostics& diagnostics) {
  KeyCheck<const JsonValue>(false, diagnostics).run(root);
}

void mendNames(GraphDesc& desc, text::Diagnostics& diagnostics) {
  constexpr std::size_t kShortest = 3;     // shorter names are near to each other by chance
  constexpr std::size_t kMaxUnknown = 64;  // with more, the mistake is another one
  struct Mentions {
    std::uint32_t count = 0;
    Place first;
  };
  std::map<std::string, Mentions, std::less<>> mentioned;  // by the first part of a name
  const auto mention = [&](std::string_view name, const Place& place, std::uint32_t times) {
    Mentions& mentions = mentioned[std::string(name.substr(0, name.find('.')))];
    mentions.count += times;
    if (!mentions.first.file) mentions.first = place;
  };
  const auto addExpr = [&](const Expr& expr) {
    for (const auto& [fact, name] : expr.facts())
      if (!name.starts_with('@') &&
          (fact != Fact::has || std::ranges::find(desc.passes, name, &PassDesc::name) == desc.passes.end()))
        mention(name, expr.place(), 1);
  };
  const auto addRef = [&](const RefDesc& ref) { mention(ref.name, ref.place, ref.import ? 0 : 1); };
  visitMentions(desc, addExpr, addRef);
  std::vector<std::string_view> there(desc.unread.begin(), desc.unread.end());
  for (const ResourceDesc& resource : desc.resources) there.push_back(resource.name);
  for (const PassDesc& pass : desc.passes) {
    if (!pass.include) continue;
    there.push_back(pass.name);
    for (const auto& [input, ref] : pass.include->binds) addRef(ref);
    if (!pass.include->graph) continue;
    // An input that is not bound takes the resource of its name.
    for (const ResourceDesc& input : pass.include->graph->resources)
      if (input.kind == ResourceDesc::Kind::input &&
          std::ranges::none_of(pass.include->binds,
                               [&](const auto& bind) { return bind.first == input.name; }))
        mention(input.name, pass.place, input.optional ? 0 : 1);
  }
  std::vector<std::string> unknown;  // in the order of the alphabet
  for (const auto& [name, mentions] : mentioned)
    if (mentions.count > 1 && name.size() >= kShortest && std::ranges::find(there, name) == there.end())
      unknown.push_back(name);
  if (unknown.size() > kMaxUnknown) return;
  for (ResourceDesc& resource : desc.resources) {
    if (resource.name.size() < kShortest || mentioned.contains(resource.name)) continue;
    const auto meant = std::ranges::find_if(
        unknown, [&](const std::string& name) { return text::editDistance(name, resource.name, 1) <= 1; });
    if (meant == unknown.end()) continue;
    const Mentions& mentions = mentioned.at(*meant);
    auto& d =
        diagnostics.error(Code::unknownResource, resource.place,
                          fmt::format("nothing names the resource '{}', and the resource '{}' is not there",
                                      resource.name, *meant));
    d.resource = resource.name;
    if (mentions.first.file)
      d.found = fmt::format("'{}' at {}:{}:{}", *meant, *mentions.first.file, mentions.first.line,
                            mentions.first.column);
    d.hint = fmt::format("did you mean '{}'?", *meant);
    resource.name = *meant;
    unknown.erase(meant);
  }
}

}  // namespace weft::graph
