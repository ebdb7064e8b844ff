// Pass and include stanzas. Declared in read_context.h.
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "engine/base/nearest.h"
#include "engine/graph/language/names.h"
#include "engine/graph/read/read_context.h"
#include "engine/graph/read/ref_parse.h"

namespace weft::graph {

namespace {

using base::Code;
using Type = JsonValue::Type;

// Slots, parameters and defines of a pass are spelled alike in its shader.
constexpr const char* kSharedName = "the slot, parameter or define";

constexpr std::uint64_t kMostIndices = 8;  // of one repeat

class PassReader {
 public:
  PassReader(ReadContext& context, const JsonValue& value) : context_(context), value_(value) {
    out_.place = value.place;
  }

  std::optional<PassDesc> run() {
    if (!context_.expect(value_, Type::object, "a pass")) return std::nullopt;
    if (const JsonValue* name = value_.find("name"); name && name->is(Type::string))
      context_.pass = name->text.substr(0, base::kMostNameBytes);
    return isInclude() ? readInclude() : readPass();
  }

 private:
  // Also when "include" is misspelt: "incldue" is nearer to it than to any key of a pass.
  bool isInclude() const {
    if (value_.find("include")) return true;
    if (value_.find("type") || value_.find("name")) return false;
    const std::vector<std::string> include = {"include"};
    for (const JsonMember& member : value_.members)
      if (!base::nearestName(member.key, include).empty()) return true;
    return false;
  }

  // The members of an object, or nothing, with an error, for another type.
  const std::vector<JsonMember>& membersOf(const char* key) {
    static const std::vector<JsonMember> none;
    const JsonValue* value = value_.find(key);
    return value && context_.expect(*value, Type::object, fmt::format("\"{}\"", key)) ? value->members : none;
  }

  // ---- include ----

  std::optional<PassDesc> readInclude() {
    context_.checkKeys(value_, kIncludeKeys, "an include");
    const JsonValue* file = value_.find("include");
    IncludeDesc& include = out_.include.emplace();
    include.file = context_.text(file, "\"include\"");
    include.group = context_.text(value_.find("group"), "\"group\"");
    out_.enabled = context_.expr(value_.find("enabled"), "\"enabled\"");
    readBinds(include);
    if (include.file.empty()) {
      if (file && file->is(Type::string))
        context_.error(Code::notAName, *file, "an include without a path").hint =
            "write the path of a graph, from this file's folder";
      return std::nullopt;
    }
    out_.namePlace = include.filePlace = file->place;
    if (const JsonValue* as = value_.find("as")) {
      include.as = context_.text(as, "\"as\"");
      out_.namePlace = as->place;
      if (!as->is(Type::string) || !context_.checkName(include.as, as->place, "an include"))
        include.as = std::string("include");
    } else {
      include.as = std::filesystem::path(include.file).stem().string();
      if (!isIdent(include.as) || isReservedWord(include.as)) {
        auto& d =
            context_.error(Code::notAName, *file,
                           fmt::format("the file's name \"{}\" cannot be a prefix of names", include.as));
        d.expected = "letters, digits and '_', not beginning with a digit";
        d.hint = "say the prefix: \"as\": \"name\"";
        include.as = "include";
      }
    }
    out_.name = include.as;
    return std::move(out_);
  }

  void readBinds(IncludeDesc& include) {
    for (const JsonMember& member : membersOf("bind")) {
      const bool named = context_.checkName(member.key, member.place, "an input");
      std::optional<RefDesc> ref =
          context_.ref(&member.value, fmt::format("the binding of '{}'", member.key));
      if (!named || !ref) continue;
      include.binds.emplace_back(member.key, *std::move(ref));
      include.bindPlaces.push_back(member.place);
    }
  }

  // ---- pass ----

  // A name for a pass whose own cannot be one; nothing refers to passes by slots, so no second mistake comes
  // of it.
  static std::string standIn(const std::string& name) {
    std::string out = name.empty() ? name : "_" + name;
    for (char& c : out)
      if (!isIdentChar(c)) c = '_';
    return out;
  }

  std::optional<PassDesc> readPass() {
    context_.checkKeys(value_, kPassKeys, "a pass", base::Foreign::pass_key);
    if (const JsonValue* like = value_.find("like")) {
      out_.like = like->text;
      out_.likePlace = like->place;
    }
    if (const JsonValue* name = value_.find("name")) {
      out_.namePlace = name->place;
      out_.name = context_.text(name, "\"name\"");
      if (name->is(Type::string) && !context_.checkName(out_.name, name->place, "a pass"))
        out_.name = isIdent(context_.pass) ? context_.pass
                                           : standIn(context_.pass);  // the rest of the stanza is checked too
    }
    readWords();
    readValues();
    readRepeat();
    readSlots();
    readParameters();
    readDefines();
    readState();
    // What the pass says with indices that nobody knows is not looked at, nor what none of a kind says.
    return out_.name.empty() || indexless_ || !value_.find("type") ? std::nullopt
                                                                   : std::optional(std::move(out_));
  }

  void readWords() {
    if (const JsonValue* type = value_.find("type")) {
      out_.type = context_.text(type, "\"type\"");
      out_.typePlace = type->place;
    }
    if (const JsonValue* shader = value_.find("shader")) {
      readShader(*shader);
      out_.shaderPlace = shader->place;
    }
    if (const JsonValue* list = value_.find("list")) {
      out_.list = context_.text(list, "\"list\"");
      out_.listPlace = list->place;
    }
    if (const JsonValue* geometry = value_.find("geometry");
        geometry && context_.expect(*geometry, Type::string, "\"geometry\"")) {
      out_.geometryPlace = geometry->place;
      base::Diagnostics said;
      if (std::optional<CallText> call = parseCallText(geometry->text, geometry->textPlace(), said)) {
        out_.geometry = std::move(call->name);
        out_.geometryArguments = std::move(call->arguments);
      }
      context_.adopt(said);
    }
    const std::string update =
        context_.word(value_.find("update"), kUpdateWords, "\"update\"").value_or("always");
    out_.cadence = update == "once"        ? Cadence::once
                   : update == "on_change" ? Cadence::on_change
                                           : Cadence::always;
    out_.group = context_.text(value_.find("group"), "\"group\"");
    out_.feedback = context_.flag(value_.find("feedback"), "\"feedback\"");
    out_.sideEffect = context_.flag(value_.find("side_effect"), "\"side_effect\"");
    out_.view = context_.ref(value_.find("view"), "\"view\"");
  }

  // One path, or of a draw two.
  void readShader(const JsonValue& shader) {
    if (!shader.is(Type::object)) {
      out_.shader = context_.text(&shader, "\"shader\"");
      return;
    }
    context_.checkKeys(shader, kShaderKeys, "\"shader\"");
    out_.vertexShader = context_.text(shader.find("vertex"), "\"vertex\"");
    out_.shader = context_.text(shader.find("fragment"), "\"fragment\"");
  }

  void readValues() {
    out_.enabled = context_.expr(value_.find("enabled"), "\"enabled\"");
    out_.slices = context_.expr(value_.find("slices"), "\"slices\"");
    out_.threads = context_.expr(value_.find("threads"), "\"threads\"");
    out_.instances = context_.expr(value_.find("instances"), "\"instances\"");
  }

  void readRepeat() {
    const JsonValue* repeat = value_.find("repeat");
    if (!repeat) return;
    ReadContext::Seen seen;
    const bool bare = repeat->is(Type::array) && !repeat->items.empty() && !repeat->items[0].is(Type::object);
    if (bare || !(repeat->is(Type::array) || repeat->is(Type::object))) {
      indexless_ = true;
      context_.expect(*repeat, Type::object, "\"repeat\"",
                      "name the index: \"repeat\": { \"i\": [first, last] }");
    } else if (repeat->is(Type::array) && !repeat->items.empty()) {
      for (const JsonValue& item : repeat->items) readRanges(item, seen);
    } else {
      readRanges(*repeat, seen);
    }
  }

  void readRanges(const JsonValue& ranges, ReadContext::Seen& seen) {
    if (!context_.expect(ranges, Type::object, "\"repeat\"")) return;
    if (ranges.members.empty())
      context_.error(Code::missingKey, ranges, "\"repeat\" without an index").hint =
          "write { \"i\": [0, 3] }";
    for (const JsonMember& member : ranges.members) {
      const JsonValue& value = member.value;
      if (seen.size() >= base::raised(kMostIndices) && !seen.contains(member.key)) {
        if (std::exchange(tooManyIndices_, true)) return;
        auto& d = context_.error(
            Code::limitExceeded, value,
            fmt::format("\"repeat\" has more indices than a pass can have, '{}' is one too many",
                        member.key));
        d.expected = fmt::format("at most {} indices of one repeat", base::raised(kMostIndices));
        d.hint = base::hintToRaise(kMostIndices);
        return;
      }
      bool good = context_.checkName(member.key, member.place, "an index");
      good = context_.checkFresh(seen, member.key, member.place, "index") && good;
      if (!value.is(Type::array) || value.items.size() < 2 || value.items.size() > 3) {
        auto& d = context_.error(Code::wrongType, value,
                                 fmt::format("the range of '{}' has the wrong type", member.key));
        d.expected = "[first, last] or [first, last, step]";
        d.found = value.is(Type::array) ? fmt::format("an array of {}", value.items.size()) : describe(value);
        if (value.is(Type::number) && value.number >= 1)
          d.hint =
              fmt::format("for {} times, write \"{}\": [0, {}]", value.number, member.key, value.number - 1);
        indexless_ = true;
        continue;
      }
      RangeDesc range;
      range.index = member.key;
      range.place = member.place;
      range.first = bound(value.items[0]);
      range.last = bound(value.items[1]);
      if (value.items.size() == 3) range.step = bound(value.items[2]);
      good = good && range.first.present() && range.last.present() &&
             (value.items.size() == 2 || range.step.present());
      indexless_ = indexless_ || !good;
      if (good) out_.repeat.push_back(std::move(range));
    }
  }

  Expr bound(const JsonValue& value) {
    if (value.is(Type::number) || value.is(Type::string))
      return context_.expr(&value, "a bound of \"repeat\"");
    auto& d = context_.error(Code::wrongType, value, "a bound of \"repeat\" has the wrong type");
    d.expected = "a number or an expression";
    d.found = describe(value);
    return {};
  }

  void readSlots() {
    std::size_t count = 0;
    for (const char* key : {"read", "write", "modify"})
      if (const JsonValue* slots = value_.find(key)) count += slots->members.size();
    out_.slots.reserve(count);
    // In file order, whichever of the three comes first.
    for (const JsonMember& member : value_.members) {
      const Access access = member.key == "write"    ? Access::write
                            : member.key == "modify" ? Access::modify
                                                     : Access::read;
      if (access == Access::read && member.key != "read") continue;
      if (!context_.expect(member.value, Type::object, fmt::format("\"{}\"", member.key),
                           fmt::format("name the slot, as the shader does: \"{}\": {{ \"{}\": {} }}",
                                       member.key, access == Access::read ? "source" : "result",
                                       member.value.is(Type::string) ? '"' + member.value.text + '"' : "…")))
        continue;
      for (const JsonMember& slot : member.value.members) {
        if (!context_.goesOn()) return;
        const std::string what = fmt::format("the slot '{}'", slot.key);
        bool good = context_.checkShaderName(slot.key, slot.place, "a slot");
        good = context_.checkFresh(names_, slot.key, slot.place, kSharedName) && good;
        std::optional<RefDesc> ref = context_.ref(&slot.value, what);
        // Only a part may be missing, at some size.
        if (ref && ref->optional && access == Access::write && !ref->mip && !ref->layer && !ref->face &&
            !ref->element) {
          auto& d =
              context_.error(Code::badReference, slot.value, fmt::format("{} has a '?' in \"write\"", what));
          d.found = fmt::format("\"{}\"", ref->text);
          d.hint =
              "leave the '?' out: what a pass writes is always there, and costs nothing where nobody reads "
              "it";
        }
        if (good && ref) out_.slots.push_back({slot.key, slot.place, access, *std::move(ref)});
      }
    }
  }

  void readParameters() {
    for (const JsonMember& member : membersOf("parameters")) {
      PassParameterDesc parameter{member.key, member.place, {}, {}};
      bool good = context_.checkFresh(names_, member.key, member.place, kSharedName);
      if (member.value.is(Type::object)) {
        parameter.declared = readParameter(context_, member);
        good = good && parameter.declared;
      } else {
        good = context_.checkShaderName(member.key, member.place, "a parameter") && good;
        parameter.value = context_.expr(&member.value, fmt::format("the parameter '{}'", member.key));
        good = good && parameter.value.present();
      }
      if (good) out_.parameters.push_back(std::move(parameter));
    }
  }

  void readDefines() {
    for (const JsonMember& member : membersOf("defines")) {
      bool good = context_.checkShaderName(member.key, member.place, "a define");
      good = context_.checkFresh(names_, member.key, member.place, kSharedName) && good;
      Expr expr = context_.expr(&member.value, fmt::format("the define '{}'", member.key));
      if (good && expr.present()) out_.defines.push_back({member.key, member.place, std::move(expr)});
    }
  }

  void readState() {
    const JsonValue* state = value_.find("state");
    if (!state || !context_.expect(*state, Type::object, "\"state\"")) return;
    context_.checkKeys(*state, kStateKeys, "\"state\"", base::Foreign::state_key);
    for (const JsonMember& member : state->members) {
      bool known = false;
      for (const KeySpec& spec : kStateKeys) known = known || spec.key == member.key;
      if (!known) continue;
      if (member.key == "blend" && member.value.is(Type::object)) {
        for (const JsonMember& slot : member.value.members) addState("blend." + slot.key, slot);
        continue;
      }
      addState(member.key, member);
    }
  }

  void addState(std::string name, const JsonMember& member) {
    // A word of another API is often no expression: ">=", "greater-equal".
    if (member.value.is(Type::string) && !isIdent(member.value.text))
      if (std::string hint = base::hintForForeign(base::Foreign::state_word, member.value.text);
          !hint.empty()) {
        auto& d = context_.error(Code::badState, member.value,
                                 fmt::format("unknown value for the state '{}'", name));
        d.found = fmt::format("\"{}\"", member.value.text);
        d.hint = std::move(hint);
        return;
      }
    const bool words =
        member.value.is(Type::array) && !member.value.items.empty() && member.value.items[0].is(Type::string);
    if (words && (member.key == "blend" || member.key == "depth_test" || member.key == "cull")) {
      auto& d = context_.error(Code::badState, member.value,
                               fmt::format("the state '{}' is a list of words", name));
      d.expected = "one word";
      if (member.key == "blend") d.hint = base::hintForForeign(base::Foreign::state_key, "factors");
      return;
    }
    Expr expr = context_.expr(&member.value, fmt::format("\"{}\"", member.key));
    if (expr.present()) out_.state.push_back({std::move(name), member.place, std::move(expr)});
  }

  ReadContext& context_;
  const JsonValue& value_;
  PassDesc out_;
  ReadContext::Seen names_;  // slots, parameters and defines share one namespace
  bool tooManyIndices_ = false;
  bool indexless_ = false;  // its "repeat" gives no index, or not from where to where
};

}  // namespace

std::optional<PassDesc> readPass(ReadContext& context, const JsonValue& value) {
  std::optional<PassDesc> pass = PassReader(context, value).run();
  context.pass.clear();
  return pass;
}

}  // namespace weft::graph
