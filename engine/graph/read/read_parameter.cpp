// Parameters, of the graph and of passes: type, default, range, choices. Declared in read_context.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/graph/read/read_context.h"
#include "engine/text/files/file.h"
#include "engine/text/nearest.h"

namespace weft::graph {

namespace {

using text::Code;
using Type = JsonValue::Type;
using ValueKind = ParameterDesc::Type;

struct ParameterKind {
  ValueKind kind;
  Type json;
  std::size_t count;  // of an array
  bool numeric;
  const char* expected;  // of the default
};
// In the order of kParameterTypes.
constexpr ParameterKind kParameterKinds[] = {
    {ValueKind::boolean, Type::boolean, 0, false, "true or false"},
    {ValueKind::integer, Type::number, 0, true, "a whole number"},
    {ValueKind::number, Type::number, 0, true, "a number"},
    {ValueKind::vec2, Type::array, 2, true, "a list of 2 numbers"},
    {ValueKind::vec3, Type::array, 3, true, "a list of 3 numbers"},
    {ValueKind::vec4, Type::array, 4, true, "a list of 4 numbers"},
    {ValueKind::choice, Type::string, 0, false, "one of the \"choices\""},
    {ValueKind::file, Type::string, 0, false, "a path in a string, or \"\""}};

class ParameterReader {
 public:
  ParameterReader(ReadContext& context, const JsonMember& member)
      : context_(context), object_(member.value), what_(fmt::format("the parameter '{}'", member.key)) {
    out_.name = member.key;
    out_.place = member.place;
  }

  std::optional<ParameterDesc> run() {
    if (!object_.is(Type::object)) {
      context_.wrongType(object_, what_, "an object with a \"default\"").hint =
          "write { \"default\": … }; a color is a list of three numbers";
      return std::nullopt;
    }
    out_.label = context_.text(object_, "label");
    out_.doc = context_.text(object_, "doc");
    out_.define = context_.flag(object_, "define");
    out_.min = context_.number(object_, "min");
    out_.max = context_.number(object_, "max");
    out_.step = context_.number(object_, "step");
    readChoices();
    const JsonValue* initial = object_.find("default");
    if (!initial || !findKind(*initial) || !readDefault(*initial)) return std::nullopt;
    checkRange(*initial);
    // Keys that say nothing about a parameter of this type.
    for (const char* key : {"min", "max", "step", "choices"}) {
      const bool fits =
          std::string_view(key) == "choices" ? kind_->kind == ValueKind::choice : kind_->numeric;
      if (const JsonValue* value = object_.find(key); value && !fits)
        context_
            .error(Code::keysExclude, *value,
                   fmt::format("\"{}\" does not go with a parameter of type \"{}\"", key, typeName()))
            .hint = "remove the key, or change the type";
    }
    return std::move(out_);
  }

 private:
  std::string_view typeName() const {
    return kParameterTypes[static_cast<std::size_t>(kind_ - kParameterKinds)];
  }

  void readChoices() {
    const JsonValue* choices = object_.find("choices");
    if (!choices || !context_.expect(*choices, Type::array, "\"choices\"")) return;
    ReadContext::Seen seen;
    for (const JsonValue& choice : choices->items)
      if (context_.expect(choice, Type::string, "a choice") &&
          context_.checkName(choice.text, choice.place, {"a choice"}) &&
          context_.checkFresh(seen, choice.text, choice.place, "choice"))
        out_.choices.push_back(choice.text);
    if (choices->items.empty()) context_.wrongType(*choices, "\"choices\"", "an array of words");
  }

  // The type that is written, else the one the default shows. False after a report.
  bool findKind(const JsonValue& initial) {
    const auto choose = [&](ValueKind kind) {
      kind_ = std::ranges::find(kParameterKinds, kind, &ParameterKind::kind);
      out_.type = kind;
      return true;
    };
    if (object_.find("type")) {
      const std::optional<std::string> word = context_.word(object_, "type", kParameterTypes);
      return word &&
             choose(
                 kParameterKinds[std::ranges::find(kParameterTypes, *word) - kParameterTypes.begin()].kind);
    }
    if (initial.is(Type::boolean)) return choose(ValueKind::boolean);
    if (initial.is(Type::number)) {
      const bool whole = std::ranges::all_of(object_.members, [](const JsonMember& member) {
        return !member.value.is(Type::number) || member.value.whole;
      });
      return choose(whole ? ValueKind::integer : ValueKind::number);
    }
    for (const ParameterKind& kind : kParameterKinds)
      if (kind.count > 0 && initial.is(Type::array) && initial.items.size() == kind.count)
        return choose(kind.kind);
    if (initial.is(Type::string) && object_.find("choices")) return choose(ValueKind::choice);
    if (!initial.is(Type::string)) {
      context_.wrongType(initial, fmt::format("the default of {}", what_),
                         "a number, a boolean, a list of 2 to 4 numbers, or a word among \"choices\"");
      return false;
    }
    auto& d = context_.error(Code::missingKey, object_,
                             fmt::format("{} has a string as its default, but no \"choices\"", what_));
    d.hint = hintForSize(initial.text);
    if (d.hint.empty())
      d.hint = parseValue(initial.text).type == Value::Type::symbol
                   ? "list the \"choices\", or say \"type\": \"file\""
                   : fmt::format("write {}, without quotes", initial.text);
    return false;
  }

  bool readDefault(const JsonValue& initial) {
    out_.initialPlace = initial.place;
    if (kind_->count > 0 && initial.is(Type::array) && initial.items.size() == kind_->count)
      for (const JsonValue& item : initial.items)
        if (!context_.expect(item, Type::number, fmt::format("a component of the default of {}", what_)))
          return false;
    const std::optional<Value> value = valueOf(initial);
    if (!value || !initial.is(kind_->json) || initial.items.size() != kind_->count ||
        (kind_->kind == ValueKind::integer && initial.number != std::floor(initial.number))) {
      auto& d =
          context_.error(Code::wrongType, initial,
                         fmt::format("the default of {} does not fit its type \"{}\"", what_, typeName()));
      d.expected = kind_->expected;
      d.found = foundText(initial);
      return false;
    }
    out_.initial = *value;
    if (kind_->kind == ValueKind::file)
      out_.initial = Value::text(text::besideFile(initial.textPlace(), initial.text));
    if (kind_->kind != ValueKind::choice) return true;
    if (!object_.find("choices")) {
      context_.error(Code::missingKey, object_, fmt::format("{} is a choice without \"choices\"", what_))
          .hint = "list the words it may be";
      return false;
    }
    if (out_.choices.empty() || std::ranges::find(out_.choices, initial.text) != out_.choices.end())
      return true;
    auto& d = context_.error(Code::notAChoice, initial,
                             fmt::format("the default of {} is not one of its choices", what_));
    d.expected = fmt::format("{}", fmt::join(out_.choices, ", "));
    d.found = initial.text;
    if (const std::string nearest = text::nearestName(initial.text, out_.choices); !nearest.empty())
      d.hint = fmt::format("did you mean \"{}\"?", nearest);
    out_.initial =
        Value::text(out_.choices[0]);  // expressions that it stands in have no mistake of their own
    return true;
  }

  void checkRange(const JsonValue& initial) {
    if (!kind_->numeric) return;
    const auto report = [&](const JsonValue& at, std::string message, std::string found,
                            std::string expected) {
      auto& d = context_.error(Code::outOfRange, at, std::move(message));
      d.found = std::move(found);
      d.expected = std::move(expected);
    };
    if (out_.min && out_.max && *out_.min > *out_.max)
      return report(*object_.find("min"), fmt::format("the range of {} is empty", what_),
                    fmt::format("min {}, max {}", *out_.min, *out_.max), "a \"min\" below \"max\"");
    if (out_.step && *out_.step <= 0)
      report(*object_.find("step"), fmt::format("the step of {} is not above zero", what_),
             fmt::format("{}", *out_.step), "a number above zero");
    if (kind_->kind == ValueKind::integer)
      for (const char* key : {"min", "max", "step"})
        if (const JsonValue* bound = object_.find(key);
            bound && bound->is(Type::number) && bound->number != std::floor(bound->number))
          context_.wrongType(*bound, fmt::format("\"{}\" of {}, which is an int,", key, what_),
                             "a whole number");
    for (std::size_t i = 0; i < out_.initial.count; ++i) {
      const double x = out_.initial.v[i];
      if (!(out_.min && x < *out_.min) && !(out_.max && x > *out_.max)) continue;
      report(initial.is(Type::array) ? initial.items[i] : initial,
             fmt::format("the default of {} is out of its range", what_), fmt::format("{}", x),
             out_.min && out_.max ? fmt::format("a number from {} to {}", *out_.min, *out_.max)
             : out_.min           ? fmt::format("a number from {} up", *out_.min)
                                  : fmt::format("a number up to {}", *out_.max));
    }
  }

  ReadContext& context_;
  const JsonValue& object_;
  const ParameterKind* kind_ = nullptr;
  ParameterDesc out_;
  std::string what_;
};

}  // namespace

std::optional<ParameterDesc> readParameter(ReadContext& context, const JsonMember& member) {
  const bool named = context.checkName(member.key, member.place, {"a parameter"});
  std::optional<ParameterDesc> parameter = ParameterReader(context, member).run();
  return named ? parameter : std::nullopt;
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

}  // namespace weft::graph
