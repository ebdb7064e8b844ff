// Pass and include stanzas. Declared in read_context.h.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "engine/graph/language/names.h"
#include "engine/graph/read/read_context.h"
#include "engine/graph/read/ref_parse.h"

namespace weft::graph {

namespace {

using text::Code;
using Type = JsonValue::Type;

// Slots, parameters and defines of a pass are spelled alike in its shader.
constexpr const char* kSharedName = "the slot, parameter or define";

constexpr std::uint64_t kMaxIndices = 8;  // of one repeat

class PassReader {
 public:
  PassReader(ReadContext& context, const JsonValue& value) : context_(context), value_(value) {
    out_.place = value.place;
  }

  std::optional<PassDesc> run() {
    if (!context_.expect(value_, Type::object, "a pass")) return std::nullopt;
    if (const JsonValue* name = value_.find("name"); name && name->is(Type::string))
      context_.pass = name->text.substr(0, text::kMaxNameBytes);
    return value_.find("include") ? readInclude() : readPass();
  }

 private:
  // The text of a key, and its place.
  std::string textAt(const char* key, Place& place) {
    if (const JsonValue* value = value_.find(key)) place = value->place;
    return context_.text(value_, key);
  }

  // ---- include ----

  std::optional<PassDesc> readInclude() {
    IncludeDesc& include = out_.include.emplace();
    include.file = textAt("include", include.filePlace);
    out_.namePlace = include.filePlace;
    out_.enabled = context_.expr(value_, "enabled");
    for (const JsonMember& member : context_.members(value_, "bind")) {
      const bool named = context_.checkName(member.key, member.place, {"an input"});
      std::optional<RefDesc> ref =
          context_.refOf(member.value, fmt::format("the binding of '{}'", member.key));
      if (!named || !ref) continue;
      include.binds.emplace_back(member.key, *std::move(ref));
      include.bindPlaces.push_back(member.place);
    }
    const JsonValue& file = *value_.find("include");
    if (include.file.empty()) {
      if (file.is(Type::string))
        context_.error(Code::notAName, file, "an include without a path").hint =
            "write the path of a graph, from this file's folder";
      return std::nullopt;
    }
    if (const JsonValue* as = value_.find("as")) {
      include.as = textAt("as", out_.namePlace);
      if (!as->is(Type::string) || !context_.checkName(include.as, as->place, {"an include"}))
        include.as = "include";
    } else {
      include.as = std::filesystem::path(include.file).stem().string();
      if (!isIdent(include.as) || isReservedWord(include.as)) {
        auto& d =
            context_.error(Code::notAName, file,
                           fmt::format("the file's name \"{}\" cannot be a prefix of names", include.as));
        d.expected = "letters, digits and '_', not beginning with a digit";
        d.hint = "say the prefix: \"as\": \"name\"";
        include.as = "include";
      }
    }
    out_.name = include.as;
    return std::move(out_);
  }

  // ---- pass ----

  std::optional<PassDesc> readPass() {
    if (const JsonValue* like = value_.find("like")) {
      out_.like = like->text;
      out_.likePlace = like->place;
    }
    out_.name = textAt("name", out_.namePlace);
    // The rest of a stanza whose name cannot be one is checked too. Nothing refers to passes by slots, so no second mistake
    // comes of another name.
    if (const JsonValue* name = value_.find("name");
        name && name->is(Type::string) && !context_.checkName(out_.name, name->place, {"a pass"})) {
      out_.name = (isIdent(context_.pass) || context_.pass.empty() ? "" : "_") + context_.pass;
      for (char& c : out_.name)
        if (!isIdentChar(c)) c = '_';
    }
    out_.type = textAt("type", out_.typePlace);
    readShader();
    out_.list = textAt("list", out_.listPlace);
    if (const std::string geometry = textAt("geometry", out_.geometryPlace); value_.find("geometry")) {
      text::Diagnostics said;
      if (std::optional<CallText> call =
              parseCallText(geometry, value_.find("geometry")->textPlace(), said)) {
        out_.geometry = std::move(call->name);
        out_.geometryArguments = std::move(call->arguments);
      }
      if (value_.find("geometry")->is(Type::string)) context_.adopt(said);
    }
    const std::string update = context_.word(value_, "update", kUpdateWords).value_or("always");
    out_.cadence = static_cast<Cadence>(std::ranges::find(kUpdateWords, update) - kUpdateWords.begin());
    out_.feedback = context_.flag(value_, "feedback");
    out_.sideEffect = context_.flag(value_, "side_effect");
    out_.view = context_.ref(value_, "view");
    out_.enabled = context_.expr(value_, "enabled");
    out_.slices = context_.expr(value_, "slices");
    out_.threads = context_.expr(value_, "threads");
    out_.instances = context_.expr(value_, "instances");
    readRepeat();
    readSlots();
    readParameters();
    readDefines();
    readState();
    // What the pass says with indices that nobody knows is not looked at, nor what none of a kind says.
    return out_.name.empty() || indexless_ || !value_.find("type") ? std::nullopt
                                                                   : std::optional(std::move(out_));
  }

  // One path, or of a draw two.
  void readShader() {
    const JsonValue* shader = value_.find("shader");
    if (!shader) return;
    out_.shaderPlace = shader->place;
    if (shader->is(Type::object)) {
      out_.vertexShader = context_.text(*shader, "vertex");
      out_.shader = context_.text(*shader, "fragment");
    } else {
      out_.shader = context_.text(value_, "shader");
    }
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
      if (seen.size() >= text::raised(kMaxIndices) && !seen.contains(member.key)) {
        if (std::exchange(tooManyIndices_, true)) return;
        auto& d = context_.error(
            Code::limitExceeded, value,
            fmt::format("\"repeat\" has more indices than a pass can have, '{}' is one too many",
                        member.key));
        d.expected = fmt::format("at most {} indices of one repeat", text::raised(kMaxIndices));
        d.hint = text::hintToRaise(kMaxIndices);
        return;
      }
      bool good = context_.checkName(member.key, member.place, {"an index"});
      good = context_.checkFresh(seen, member.key, member.place, "index") && good;
      if (!value.is(Type::array) || value.items.size() < 2 || value.items.size() > 3) {
        auto& d = context_.wrongType(value, fmt::format("the range of '{}'", member.key),
                                     "[first, last] or [first, last, step]");
        if (value.is(Type::number) && value.number >= 1)
          d.hint =
              fmt::format("for {} times, write \"{}\": [0, {}]", value.number, member.key, value.number - 1);
        indexless_ = true;
        continue;
      }
      RangeDesc range{member.key, member.place, {}, {}, {}};
      Expr* const bounds[] = {&range.first, &range.last, &range.step};
      for (std::size_t i = 0; i < value.items.size(); ++i) {
        if (value.items[i].is(Type::number) || value.items[i].is(Type::string))
          *bounds[i] = context_.exprOf(value.items[i], "a bound of \"repeat\"");
        else
          context_.wrongType(value.items[i], "a bound of \"repeat\"", "a number or an expression");
        good = good && bounds[i]->present();
      }
      indexless_ = indexless_ || !good;
      if (good) out_.repeat.push_back(std::move(range));
    }
  }

  void readSlots() {
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
        bool good = context_.checkName(slot.key, slot.place, {"a slot", true});
        good = context_.checkFresh(names_, slot.key, slot.place, kSharedName) && good;
        std::optional<RefDesc> ref = context_.refOf(slot.value, what);
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
    for (const JsonMember& member : context_.members(value_, "parameters")) {
      PassParameterDesc parameter{member.key, member.place, {}, {}};
      bool good = context_.checkFresh(names_, member.key, member.place, kSharedName);
      if (member.value.is(Type::object)) {
        parameter.declared = readParameter(context_, member);
        good = good && parameter.declared;
      } else {
        good = context_.checkName(member.key, member.place, {"a parameter", true, false, true}) && good;
        parameter.value = context_.exprOf(member.value, fmt::format("the parameter '{}'", member.key));
        good = good && parameter.value.present();
      }
      if (good) out_.parameters.push_back(std::move(parameter));
    }
  }

  void readDefines() {
    for (const JsonMember& member : context_.members(value_, "defines")) {
      bool good = context_.checkName(member.key, member.place, {"a define", true, true});
      good = context_.checkFresh(names_, member.key, member.place, kSharedName) && good;
      Expr expr = context_.exprOf(member.value, fmt::format("the define '{}'", member.key));
      if (good && expr.present()) out_.defines.push_back({member.key, member.place, std::move(expr)});
    }
  }

  void readState() {
    for (const JsonMember& member : context_.members(value_, "state")) {
      if (std::ranges::find(kStateKeys, member.key, &KeySpec::key) == kStateKeys.end()) continue;
      const bool bySlot = member.key == "blend" && member.value.is(Type::object);
      if (!bySlot) addState(member.key, member);
      for (std::size_t i = 0; bySlot && i < member.value.members.size(); ++i)
        addState("blend." + member.value.members[i].key, member.value.members[i]);
    }
  }

  void addState(std::string name, const JsonMember& member) {
    const JsonValue& value = member.value;
    // A word of another API is often no expression: ">=", "greater-equal".
    std::string hint = value.is(Type::string) && !isIdent(value.text)
                           ? text::hintForForeign(text::Foreign::state_word, value.text)
                           : "";
    const bool words = value.is(Type::array) && !value.items.empty() && value.items[0].is(Type::string) &&
                       (member.key == "blend" || member.key == "depth_test" || member.key == "cull");
    if (words || !hint.empty()) {
      auto& d = context_.error(Code::badState, value, fmt::format("unknown value for the state '{}'", name));
      d.expected = "one word";
      d.found = foundText(value);
      d.hint = words && member.key == "blend" ? text::hintForForeign(text::Foreign::state_key, "factors")
                                              : std::move(hint);
      return;
    }
    Expr expr = context_.exprOf(value, fmt::format("\"{}\"", member.key));
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
