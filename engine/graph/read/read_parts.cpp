// Parameters, resources, passes and includes. Declared in read_context.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <utility>

#include "engine/graph/language/names.h"
#include "engine/graph/read/overlay.h"
#include "engine/graph/read/read_context.h"
#include "engine/graph/read/ref_parse.h"
#include "engine/graph/subresource.h"
#include "engine/text/files/file.h"
#include "engine/text/nearest.h"
#include "graph_sentences.h"

namespace weft::graph {

using text::Code;
using Type = JsonValue::Type;

// ---- parameters: type, default, range, choices ----

namespace {

using ValueKind = ParameterDesc::Type;

struct ParameterKind {
  Type json;          // of the default
  std::size_t count;  // of an array
  bool numeric;
};
// In the order of ParameterDesc::Type, and so of kParameterTypes.
constexpr ParameterKind kParameterKinds[] = {
    {Type::boolean, 0, false}, {Type::number, 0, true}, {Type::number, 0, true},  {Type::array, 2, true},
    {Type::array, 3, true},    {Type::array, 4, true},  {Type::string, 0, false}, {Type::string, 0, false}};

std::string typeName(ValueKind kind) {
  return std::string(kParameterTypes[static_cast<std::size_t>(kind)]);
}

std::vector<std::string> readChoices(ReadContext& context, const JsonValue& object) {
  std::vector<std::string> words;
  ReadContext::Seen seen;
  if (const JsonValue* choices = valueIn(object, "choices"))
    for (const JsonValue& choice : choices->items)
      if (context.checkName(choice.text, choice.place, {"a choice"}) &&
          context.checkFresh(seen, choice.text, choice.place, "choice"))
        words.push_back(choice.text);
  return words;
}

// The type that is written, else the one the default shows.
std::optional<ValueKind> findKind(ReadContext& context, const JsonValue& object, const JsonValue& initial) {
  if (object.find("type")) {
    const auto found = std::ranges::find(kParameterTypes, textIn(object, "type"));
    if (found == kParameterTypes.end()) return std::nullopt;
    return static_cast<ValueKind>(found - kParameterTypes.begin());
  }
  if (initial.is(Type::boolean)) return ValueKind::boolean;
  if (initial.is(Type::number)) {
    const bool whole = std::ranges::all_of(object.members, [](const JsonMember& member) {
      return !member.value.is(Type::number) || member.value.whole;
    });
    return whole ? ValueKind::integer : ValueKind::number;
  }
  if (initial.is(Type::array))
    return static_cast<ValueKind>(static_cast<std::size_t>(ValueKind::vec2) + initial.items.size() - 2);
  if (object.find("choices")) return ValueKind::choice;
  context.error(say::stringWithoutChoices, object,
                parseValue(initial.text).type == Value::Type::symbol
                    ? "list the \"choices\", or say \"type\": \"file\""
                    : fmt::format("write {}, without quotes", initial.text));
  return std::nullopt;
}

// The default of a parameter whose type and choices are known. False after a report, unless another value can be taken.
bool readDefault(ReadContext& context, const JsonValue& object, const JsonValue& initial,
                 ParameterDesc& out) {
  const ParameterKind& kind = kParameterKinds[static_cast<std::size_t>(out.type)];
  const std::optional<Value> value = valueOf(initial);
  if (!value || !initial.is(kind.json) || initial.items.size() != kind.count ||
      (out.type == ValueKind::integer && initial.number != std::floor(initial.number))) {
    auto& d =
        context.error(say::defaultDoesNotFitType, initial, typeName(out.type),
                      kind.count > 0 ? fmt::format("a list of {} numbers", kind.count) : nameOf(kind.json));
    if (out.type == ValueKind::integer) d.expected = "a whole number";
    d.found = foundText(initial);
    return false;
  }
  out.initialPlace = initial.place;
  out.initial = *value;
  if (out.type == ValueKind::file)
    out.initial = Value::text(text::besideFile(initial.textPlace(), initial.text));
  if (out.type != ValueKind::choice) return true;
  if (!object.find("choices")) {
    context.error(say::choiceWithoutChoices, object);
    return false;
  }
  if (out.choices.empty() || std::ranges::find(out.choices, initial.text) != out.choices.end()) return true;
  auto& d = context.error(say::defaultNotAChoice, initial, initial.text, fmt::join(out.choices, ", "));
  if (const std::string nearest = text::nearestName(initial.text, out.choices); !nearest.empty())
    d.hint = fmt::format("did you mean \"{}\"?", nearest);
  out.initial = Value::text(out.choices[0]);  // expressions that it stands in have no mistake of their own
  return true;
}

void checkRange(ReadContext& context, const JsonValue& object, const JsonValue& initial,
                const ParameterDesc& out) {
  if (const JsonValue* min = object.find("min"); out.min && out.max && *out.min > *out.max) {
    context.error(say::emptyRange, *min, *out.max, foundText(*min));
    return;
  }
  if (const JsonValue* step = object.find("step"); out.step && *out.step <= 0)
    context.error(say::stepNotAboveZero, *step, foundText(*step));
  for (std::size_t i = 0; i < out.initial.count; ++i)
    if ((out.min && out.initial.v[i] < *out.min) || (out.max && out.initial.v[i] > *out.max)) {
      const JsonValue& at = initial.is(Type::array) ? initial.items[i] : initial;
      context.error(say::defaultOutOfRange, at, out.min ? fmt::format(" from {}", *out.min) : "",
                    out.max ? fmt::format(" up to {}", *out.max) : "", foundText(at));
    }
}

std::optional<double> numberIn(const JsonValue& object, std::string_view key) {
  const JsonValue* value = valueIn(object, key);
  return value ? std::optional(value->number) : std::nullopt;
}

}  // namespace

std::optional<ParameterDesc> readParameter(ReadContext& context, const JsonMember& member) {
  const JsonValue& object = member.value;
  ParameterDesc out;
  out.name = member.key;
  out.place = member.place;
  const bool named = context.checkName(member.key, member.place, {.noun = "a parameter", .ofFile = true});
  out.label = textIn(object, "label");
  if (out.label.empty()) {  // the name in words
    out.label = member.key;
    std::ranges::replace(out.label, '_', ' ');
    out.label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out.label[0])));
  }
  out.doc = textIn(object, "doc");
  if (const JsonValue* define = valueIn(object, "define")) out.define = define->flag;
  out.min = numberIn(object, "min");
  out.max = numberIn(object, "max");
  out.step = numberIn(object, "step");
  out.choices = readChoices(context, object);
  const JsonValue* initial = valueIn(object, "default");
  const std::optional<ValueKind> kind = initial ? findKind(context, object, *initial) : std::nullopt;
  if (!kind) return std::nullopt;
  out.type = *kind;
  if (!readDefault(context, object, *initial, out)) return std::nullopt;
  const bool numeric = kParameterKinds[static_cast<std::size_t>(*kind)].numeric;
  if (numeric) checkRange(context, object, *initial, out);
  // Keys that say nothing about a parameter of this type.
  for (const std::string_view key : {"min", "max", "step", "choices"})
    if (const JsonValue* value = object.find(key);
        value && !(key == "choices" ? *kind == ValueKind::choice : numeric))
      context.error(say::keyMisfitsType, *value, key, typeName(*kind));
  return named ? std::optional(std::move(out)) : std::nullopt;
}

std::optional<Value> valueOf(const JsonValue& value) {
  if (value.is(Type::number)) return Value::number(value.number);
  if (value.is(Type::boolean)) return Value::boolean(value.flag);
  if (value.is(Type::string)) return Value::text(value.text);
  Value list;
  if (value.items.size() < 2 || value.items.size() > list.v.size()) return std::nullopt;
  list.type = Value::Type::list;
  for (const JsonValue& item : value.items) {
    if (!item.is(Type::number)) return std::nullopt;
    list.v[list.count++] = item.number;
  }
  return list;
}

// ---- resources: textures, buffers, imports, inputs, alternatives ----

namespace {

constexpr std::pair<std::string_view, Expr ResourceDesc::*> kResourceValues[] = {
    {"size", &ResourceDesc::size},   {"mips", &ResourceDesc::mips},       {"layers", &ResourceDesc::layers},
    {"array", &ResourceDesc::array}, {"samples", &ResourceDesc::samples}, {"buffer", &ResourceDesc::bytes},
    {"clear", &ResourceDesc::clear}, {"history", &ResourceDesc::history}};

// A string that is a path, and no expression: of an argument that holds a path, unless it begins with '$', and "photo.png" under
// another key. Whoever knows the arguments says what is wrong with that.
bool isPath(std::string_view key, std::string_view text) {
  constexpr std::string_view kEndings[] = {".png", ".jpg",  ".jpeg", ".exr", ".hdr", ".cube",
                                           ".tga", ".webp", ".gltf", ".glb", ".obj", ".json"};
  if (key == "file" || key.ends_with("_file")) return !text.starts_with('$');
  return text.find('$') == std::string_view::npos &&
         std::ranges::any_of(kEndings, [&](std::string_view ending) { return text.ends_with(ending); });
}

// The same for a name that a scene file gives: of an argument whose key ends in "name".
bool isForeignName(std::string_view key, std::string_view text) {
  return key.ends_with("name") && !text.starts_with('$');
}

void readImport(ReadContext& context, const JsonValue& value, ImportDesc& out) {
  out.type = textIn(value, "import");
  for (const auto& member : value.members) {
    if (member.key == "import" || member.key == "sample") continue;
    const bool named = context.checkName(member.key, member.place, {"an argument"});
    const JsonValue& given = member.value;
    const bool isText = given.is(Type::string);
    Expr expr =
        isText && isForeignName(member.key, given.text)
            ? Expr::constant(Value::text(given.text), given.textPlace())
        : isText && isPath(member.key, given.text)
            ? Expr::constant(Value::text(text::besideFile(given.textPlace(), given.text)), given.textPlace())
            : context.exprOf(given);
    if (named && expr.present()) out.arguments.push_back({member.key, member.place, std::move(expr)});
  }
}

// A value, or what to read in its place.
void readFirst(ReadContext& context, const JsonValue& first, ResourceDesc& out) {
  if (!first.is(Type::string) || !looksLikeRef(first.text)) {
    out.first = context.exprOf(first);
    return;
  }
  out.firstRef = context.refOf(first);
  if (!out.firstRef ||
      (!out.firstRef->kind && out.firstRef->sampler == Sampler{} && out.firstRef->history == 0))
    return;
  context.error(say::firstIsMoreThanName, first, out.name);
  out.firstRef.reset();
}

void readHistory(ReadContext& context, const JsonValue& value, ResourceDesc& out) {
  if (const JsonValue* first = valueIn(value, "first")) readFirst(context, *first, out);
  if (const JsonValue* reset = valueIn(value, "reset"))
    for (const JsonValue& item : stringsOf(*reset)) {
      if (!looksLikeRef(item.text)) {
        if (Expr expr = context.exprOf(item); expr.present()) out.resetValues.push_back(std::move(expr));
      } else if (std::optional<RefDesc> ref = context.refOf(item)) {
        out.resetRefs.push_back(*std::move(ref));
      }
    }
  for (const char* key : {"first", "reset"})
    if (const JsonValue* found = value.find(key); found && !value.find("history")) {
      context.error(say::withoutHistory, *found, key, out.name);
      out.history =
          Expr::constant(Value::number(1), found->place);  // what reads it has no mistake of its own
    }
}

// "full", and what other engines call it, which is reported.
bool readFullMips(ReadContext& context, const JsonValue& mips) {
  constexpr std::string_view kAll[] = {"all", "auto", "max", "complete", "true"};
  const bool meant = mips.is(Type::string) ? std::ranges::find(kAll, mips.text) != std::end(kAll)
                                           : mips.is(Type::boolean) && mips.flag;
  if (meant) context.error(say::mipsNoNumber, mips);
  return meant || mips.text == "full";
}

// "specular as linear wrap ?"
bool readInput(ReadContext& context, const JsonValue& input, ResourceDesc& out) {
  std::optional<RefDesc> ref = context.refOf(input);
  if (!ref) return false;
  if (ref->import || ref->selects() || ref->kind || ref->history > 0)
    context.error(say::inputIsMoreThanName, ref->place, out.name);
  out.optional = ref->optional;
  if (ref->samples) out.sample = std::move(ref);
  return true;
}

// What a texture that says no size has.
Expr screenAt(const Place& place) {
  text::Diagnostics none;
  return Expr::parse("screen", place, none).value_or(Expr());
}

bool readResourceInto(ReadContext& context, const JsonValue& value, ResourceDesc& out) {
  using Kind = ResourceDesc::Kind;
  const std::string_view kind = kindOf(value);
  if (kind == "alternatives") {
    out.kind = Kind::alternatives;
    for (const JsonValue& item : stringsOf(value))
      if (std::optional<RefDesc> ref = context.refOf(item, true)) out.alternatives.push_back(*std::move(ref));
    return !out.alternatives.empty();
  }
  if (kind == "inputs") {
    out.kind = Kind::input;
    out.history = context.expr(value, "history");
    readHistory(context, value, out);
    return readInput(context, *value.find("inputs"), out);
  }
  if (const JsonValue* sample = valueIn(value, "sample")) {
    JsonValue words = *sample;  // of a reference, so that all it says stands at its place
    words.text.insert(0, "sample as ");
    words.place.column -= 10;
    out.sample = context.refOf(words);
    if (out.sample) out.sample->place = sample->textPlace();
    if (out.sample && (out.sample->kind || out.sample->optional)) context.error(say::sampleSaysMore, *sample);
  }
  if (kind == "import") {
    out.kind = Kind::import;
    readImport(context, value, out.import);
    return !out.import.type.empty();
  }
  out.kind = kind == "texture" ? Kind::texture : Kind::buffer;
  if (const JsonValue* mips = valueIn(value, "mips")) out.fullMips = readFullMips(context, *mips);
  for (const auto& [key, member] : kResourceValues)
    if (key != "mips" || !out.fullMips) out.*member = context.expr(value, key);
  readHistory(context, value, out);
  if (const JsonValue* format = valueIn(value, "texture"))
    out.format = format->text.find_first_of("$(") == std::string::npos
                     ? Expr::constant(Value::text(format->text), format->place)
                     : context.exprOf(*format);
  out.view = textIn(value, "view");
  if (out.view == "2d") out.view.clear();
  if (const JsonValue* view = value.find("view")) out.viewPlace = view->place;
  if (kind == "texture" && !value.find("size")) out.size = screenAt(value.find("texture")->place);
  return kind == "buffer" ? out.bytes.present() : out.format.present() && out.size.present();
}

}  // namespace

std::optional<ResourceDesc> readResource(ReadContext& context, const JsonMember& member) {
  context.resource = member.key;
  ResourceDesc out;
  out.name = member.key;
  out.place = member.place;
  const bool named = context.checkName(member.key, member.place, {.noun = "a resource", .ofFile = true});
  const bool good = !member.value.is(Type::absent) && readResourceInto(context, member.value, out);
  context.resource.clear();
  return named && good ? std::optional(std::move(out)) : std::nullopt;
}

// ---- passes and includes ----

namespace {

// Slots, parameters and defines of a pass are spelled alike in its shader.
constexpr const char* kSharedName = "the slot, parameter or define";

constexpr std::uint64_t kMaxIndices = 8;  // of one repeat

struct TextKey {
  std::string_view key;
  std::string PassDesc::*text;
  Place PassDesc::*place;
};
constexpr TextKey kPassTexts[] = {{"name", &PassDesc::name, &PassDesc::namePlace},
                                  {"type", &PassDesc::type, &PassDesc::typePlace},
                                  {"shader", &PassDesc::shader, &PassDesc::shaderPlace},
                                  {"list", &PassDesc::list, &PassDesc::listPlace},
                                  {"geometry", &PassDesc::geometry, &PassDesc::geometryPlace}};
constexpr std::pair<std::string_view, Expr PassDesc::*> kPassValues[] = {
    {"enabled", &PassDesc::enabled},     {"slices", &PassDesc::slices}, {"threads", &PassDesc::threads},
    {"instances", &PassDesc::instances}, {"draws", &PassDesc::draws},   {"raster", &PassDesc::raster},
    {"samples", &PassDesc::samples},     {"screen", &PassDesc::screen}};
constexpr std::pair<std::string_view, bool PassDesc::*> kPassFlags[] = {
    {"feedback", &PassDesc::feedback}, {"side_effect", &PassDesc::sideEffect}};

void readInclude(ReadContext& context, const JsonValue& value, PassDesc& out) {
  IncludeDesc& include = out.include.emplace();
  const JsonValue& file = *value.find("include");
  const JsonValue* as = value.find("as");
  include.file = file.text;
  include.filePlace = file.place;
  out.enabled = context.expr(value, "enabled");
  if (const JsonValue* group = value.find("passes"); group && group->find("repeat"))
    context.error(say::includeInRepeat, file);
  include.screen = context.expr(value, "screen");
  for (const JsonMember& member : membersIn(value, "bind")) {
    const bool named = context.checkName(member.key, member.place, {"an input"});
    std::optional<RefDesc> ref = context.refOf(member.value);
    if (!named || !ref) continue;
    include.binds.emplace_back(member.key, *std::move(ref));
    include.bindPlaces.push_back(member.place);
  }
  if (include.file.empty() && file.is(Type::string)) context.error(say::includeWithoutPath, file);
  if (include.file.empty()) return;
  out.namePlace = as ? as->place : file.place;
  include.as = as ? as->text : std::filesystem::path(include.file).stem().string();
  if ((as && !as->is(Type::string)) ||
      !context.checkName(include.as, out.namePlace, {as ? "an include" : "an include: say \"as\": \"name\""}))
    include.as = "include";
  out.name = include.as;
}

// False when the repeat gives no index, or not from where to where: what the pass says with it is not looked at.
bool readRanges(ReadContext& context, const JsonValue& ranges, ReadContext::Seen& seen, PassDesc& out) {
  bool all = !ranges.is(Type::absent);
  if (all && ranges.members.empty()) context.error(say::repeatWithoutIndex, ranges);
  for (const JsonMember& member : ranges.members) {
    if (seen.size() == text::raised(kMaxIndices)) {
      context.error(say::tooManyIndices, member.value, member.key, text::raised(kMaxIndices),
                    text::hintToRaise(kMaxIndices));
      return false;
    }
    bool good = context.checkName(member.key, member.place, {"an index"});
    good = context.checkFresh(seen, member.key, member.place, "index") && good;
    RangeDesc range{member.key, member.place, {}, {}, {}};
    Expr* const bounds[] = {&range.first, &range.last, &range.step};
    for (std::size_t i = 0; i < member.value.items.size(); ++i) {
      *bounds[i] = context.exprOf(member.value.items[i]);
      good = good && bounds[i]->present();
    }
    good = good && !member.value.is(Type::absent);
    all = all && good;
    if (good) out.repeat.push_back(std::move(range));
  }
  return all;
}

bool readRepeat(ReadContext& context, const JsonValue* repeat, ReadContext::Seen& seen, PassDesc& out) {
  if (!repeat || !repeat->is(Type::array)) return !repeat || readRanges(context, *repeat, seen, out);
  bool all = true;
  for (const JsonValue& ranges : repeat->items) all = readRanges(context, ranges, seen, out) && all;
  return all;
}

// What holds for all passes of its group together.
bool readGroup(ReadContext& context, const JsonValue& group, ReadContext::Seen& indices, PassDesc& out) {
  out.group = group.place;
  out.enabled = Expr::both(context.expr(group, "enabled"), out.enabled);
  const bool good = readRepeat(context, group.find("repeat"), indices, out);
  out.looped = out.repeat.size();
  return good;
}

// `own`: those that the stanza has, without its sets; null when it has none. `ofSet`: of its sets, else of itself.
void readSlots(ReadContext& context, const JsonValue& slots, Access access, const JsonValue* own, bool ofSet,
               ReadContext::Seen& names, PassDesc& out) {
  const std::size_t shared = slots.members.size() - (own ? own->members.size() : 0);  // they are in front
  const std::size_t end = ofSet ? shared : slots.members.size();
  for (std::size_t i = ofSet ? 0 : shared; i < end; ++i) {
    const JsonMember& slot = slots.members[i];
    bool good = context.checkName(slot.key, slot.place, {"a slot", true});
    good = context.checkFresh(names, slot.key, slot.place, kSharedName) && good;
    std::optional<RefDesc> ref = context.refOf(slot.value);
    // Only a part may be missing, at some size.
    if (ref && ref->optional && access == Access::write && !ref->mip && !ref->layer && !ref->face &&
        !ref->element)
      context.error(say::optionalWrite, slot.value, slot.key);
    if (good && ref) out.slots.push_back({{slot.key, slot.place, access, ofSet}, *std::move(ref)});
  }
}

// More than a number or a vector.
bool isArrayOrMatrix(const JsonValue& value) {
  return value.items.size() > Value{}.v.size() ||
         std::ranges::any_of(value.items, [](const JsonValue& item) { return item.is(Type::array); });
}

void readParameters(ReadContext& context, const JsonValue& value, ReadContext::Seen& names, PassDesc& out) {
  for (const JsonMember& member : membersIn(value, "parameters")) {
    PassParameterDesc parameter{.name = member.key, .place = member.place};
    bool good = context.checkFresh(names, member.key, member.place, kSharedName);
    if (member.value.is(Type::object)) {
      parameter.declared = readParameter(context, member);
    } else {
      good = context.checkName(member.key, member.place, {"a parameter", true, false, true}) && good;
      if (isArrayOrMatrix(member.value))
        for (const JsonValue& item : member.value.items) parameter.items.push_back(context.exprOf(item));
      else
        parameter.value = context.exprOf(member.value);
    }
    if (good && (parameter.declared || std::ranges::all_of(parameter.values(), &Expr::present)))
      out.parameters.push_back(std::move(parameter));
  }
  for (const JsonMember& member : membersIn(value, "defines")) {
    bool good = context.checkName(member.key, member.place, {"a define", true, true});
    good = context.checkFresh(names, member.key, member.place, kSharedName) && good;
    Expr expr = context.exprOf(member.value);
    if (good && expr.present()) out.defines.push_back({member.key, member.place, std::move(expr)});
  }
}

void readState(ReadContext& context, const JsonValue& value, PassDesc& out) {
  const auto add = [&](std::string name, const JsonMember& member) {
    // A word of another API is often no expression: ">=".
    const bool own = !member.value.is(Type::string) || isIdent(member.value.text);
    const std::string hint = own ? "" : text::hintForForeign("state_word", member.value.text);
    if (!hint.empty()) {
      context.error(say::foreignStateWord, member.value, name, hint);
      return;
    }
    if (Expr expr = context.exprOf(member.value); expr.present())
      out.state.push_back({std::move(name), member.place, std::move(expr)});
  };
  const auto addAll = [&](const auto& self, const std::string& name, const JsonMember& member) -> void {
    if (!findStateKey(name)) return;  // reported
    if (!member.value.is(Type::object)) return add(name, member);
    for (const JsonMember& each : member.value.members) self(self, name + "." + each.key, each);
  };
  ReadContext::Seen keys;
  for (const JsonMember& member : membersIn(value, "state"))
    if (context.checkFresh(keys, member.key, member.place, "the state")) addAll(addAll, member.key, member);
}

// The pass as if it said what its sets hold. Nothing after a report: without one of its sets it is another pass.
std::optional<JsonValue> withSets(ReadContext& context, const JsonValue& pass, const JsonValue& sets,
                                  PassDesc& out) {
  std::vector<const JsonMember*> used;
  const std::span<const JsonValue> names = stringsOf(*pass.find("use"));
  for (const JsonValue& name : names) {
    if (name.is(Type::absent)) continue;
    const auto set = std::ranges::find(sets.members, name.text, &JsonMember::key);
    if (set == sets.members.end()) {
      std::vector<std::string> known;
      for (const JsonMember& each : sets.members) known.push_back(each.key);
      context.error(say::unknownSet, name, name.text, text::nearestHint(name.text, known));
    } else if (std::ranges::find(used, &*set) != used.end()) {
      context.error(say::setUsedTwice, name, name.text);
    } else if (!set->value.is(Type::absent)) {
      out.uses.push_back({name.text, name.place, set->place});
      used.push_back(&*set);
    }
  }
  if (names.empty() || used.size() < names.size()) return std::nullopt;
  JsonValue whole = pass;
  for (auto set = used.rbegin(); set != used.rend(); ++set)
    addSet(whole, (*set)->value, [&](const JsonMember& member) {
      context.error(say::alsoInSet, member.place, member.key, (*set)->key);
    });
  return whole;
}

// What a pass without a "type" is.
void inferType(ReadContext& context, const JsonValue& value, PassDesc& out) {
  if (value.find("type")) return;
  // A set that is missing, which was reported, may be what has them.
  if (const JsonValue* use = value.find("use"); use && out.uses.size() < stringsOf(*use).size()) return;
  out.typePlace = out.shaderPlace;
  if (value.find("shader"))
    out.type = out.shader.ends_with(".comp.glsl")                              ? "compute"
               : value.find("geometry") || !out.shader.ends_with(".frag.glsl") ? "draw"
                                                                               : "fullscreen";
  else if (textIn(value, "name").find('.') == std::string::npos)  // else its name is the mistake
    context.error(say::neitherTypeNorShader, value.place);
}

void readGeometry(ReadContext& context, const JsonValue& value, PassDesc& out) {
  const JsonValue* geometry = valueIn(value, "geometry");
  if (!geometry) return;
  std::optional<CallText> call = context.parsed(*geometry, parseCallText);
  out.geometry = call ? std::move(call->name) : "";
  if (call) out.geometryArguments = std::move(call->arguments);
}

void readUpdate(ReadContext& context, const JsonValue& value, PassDesc& out) {
  const JsonValue* update = valueIn(value, "update");
  if (!update) return;
  const auto word = std::ranges::find(kUpdateWords, update->text);
  out.cadence = static_cast<Cadence>(word - kUpdateWords.begin());
  if (word != kUpdateWords.end()) return;
  const std::optional<CallText> call = context.parsed(*update, parseCallText);
  out.cadence = Cadence::always;
  if (!call) return;
  if (call->name != "every" || call->arguments.size() != 1) {
    context.error(say::unknownUpdate, *update, update->text, fmt::join(kUpdateWords, ", "));
    return;
  }
  out.cadence = Cadence::every;
  out.period = call->arguments[0];
}

// False when the pass cannot be used. `own`: the stanza without what it has of sets.
bool readPassInto(ReadContext& context, const JsonValue& value, const JsonValue& own, PassDesc& out) {
  for (const TextKey& each : kPassTexts)
    if (const JsonValue* found = value.find(each.key)) {
      out.*each.text = found->text;
      out.*each.place = found->place;
    }
  // The rest of a stanza whose name cannot be one is checked too: nothing refers to passes by slots.
  if (const JsonValue* name = valueIn(value, "name");
      name && !context.checkName(out.name, name->place, {.noun = "a pass", .ofFile = true})) {
    out.name.insert(0, "_");
    for (char& c : out.name)
      if (!isIdentChar(c)) c = '_';
  }
  if (const JsonValue* shaders = valueIn(value, "shader"); shaders && shaders->is(Type::object)) {
    out.vertexShader = textIn(*shaders, "vertex");
    out.shader = textIn(*shaders, "fragment");
  }
  inferType(context, value, out);
  readUpdate(context, value, out);
  for (const auto& [key, flag] : kPassFlags)
    if (const JsonValue* found = valueIn(value, key)) out.*flag = found->flag;
  for (const auto& [key, member] : kPassValues) out.*member = context.expr(value, key);
  out.view = context.ref(value, "view");
  readGeometry(context, value, out);
  ReadContext::Seen indices;
  const JsonValue* group = value.find("passes");
  bool indexed = !group || readGroup(context, *group, indices, out);
  indexed = readRepeat(context, value.find("repeat"), indices, out) && indexed;
  ReadContext::Seen names;  // slots, parameters and defines share one namespace
  for (const bool ofSet : {true, false})
    for (const JsonMember& member : value.members)  // in file order
      for (const Access access : {Access::read, Access::write, Access::modify})
        if (member.key == nameOf(access))
          readSlots(context, member.value, access, own.find(member.key), ofSet, names, out);
  readParameters(context, value, names, out);
  readState(context, value, out);
  if (!out.uses.empty()) std::ranges::stable_sort(out.slots, {}, &SlotDesc::access);
  return indexed && !out.name.empty() && (value.find("type") || !out.type.empty());
}

}  // namespace

bool isGroup(std::string_view key) {
  constexpr std::string_view kGroups[] = {"read", "write", "modify", "parameters", "defines", "state"};
  return std::ranges::find(kGroups, key) != std::end(kGroups);
}

void addSet(JsonValue& stanza, const JsonValue& set, const std::function<void(const JsonMember&)>& both) {
  for (const JsonMember& member : set.members) {
    if (!shapeOf("set").find(member.key)) continue;
    JsonMember* there = memberOf(stanza, member.key);
    if (!there)
      stanza.members.push_back(member);
    else if (isGroup(member.key))
      there->value.members.insert(there->value.members.begin(), member.value.members.begin(),
                                  member.value.members.end());
    else
      both(*there);
  }
}

std::optional<PassDesc> readPass(ReadContext& context, const JsonValue& value, const JsonValue& sets) {
  PassDesc out;
  out.place = value.place;
  context.pass = textIn(value, "name").substr(0, text::kMaxNameBytes);
  bool good = !value.is(Type::absent);
  if (good && value.find("include")) {
    readInclude(context, value, out);
    if (const JsonValue* group = value.find("passes"))
      out.enabled = Expr::both(context.expr(*group, "enabled"), out.enabled);
    good = !out.name.empty();
  } else if (good) {
    const bool uses = valueIn(value, "use") != nullptr;
    const std::optional<JsonValue> whole = uses ? withSets(context, value, sets, out) : std::nullopt;
    good = readPassInto(context, whole ? *whole : value, value, out) && whole.has_value() == uses;
  }
  context.pass.clear();
  return good ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace weft::graph
