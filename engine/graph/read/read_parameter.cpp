// Parameters, of the graph and of passes: type, default, range, choices.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/files/file.h"
#include "engine/base/nearest.h"
#include "engine/graph/read/read_context.h"

namespace weft::graph {

namespace {

using base::Code;
using ParameterType = ParameterDesc::Type;

// In the order of kParameterTypes.
constexpr std::array kTypes = {ParameterType::boolean, ParameterType::integer, ParameterType::number,
                               ParameterType::vec2,    ParameterType::vec3,    ParameterType::vec4,
                               ParameterType::choice,  ParameterType::file};

std::string_view nameOf(ParameterType type) {
  return kParameterTypes[static_cast<std::size_t>(std::find(kTypes.begin(), kTypes.end(), type) -
                                                  kTypes.begin())];
}

bool isNumeric(ParameterType type) {
  return type != ParameterType::boolean && type != ParameterType::choice && type != ParameterType::file;
}
std::size_t componentCount(ParameterType type) {
  return type == ParameterType::vec2   ? 2
         : type == ParameterType::vec3 ? 3
         : type == ParameterType::vec4 ? 4
                                       : 1;
}

class ParameterReader {
 public:
  ParameterReader(ReadContext& context, const JsonMember& member) : context_(context), object_(member.value) {
    out_.name = member.key;
    out_.place = member.place;
    what_ = fmt::format("the parameter '{}'", member.key);
  }

  std::optional<ParameterDesc> run() {
    if (!object_.is(JsonValue::Type::object)) {
      auto& d = context_.error(Code::wrongType, object_, fmt::format("{} has the wrong type", what_));
      d.expected = "an object with a \"default\"";
      d.found = describe(object_);
      if (object_.is(JsonValue::Type::number) || object_.is(JsonValue::Type::boolean))
        d.hint = fmt::format("write {{ \"default\": {} }}", object_.is(JsonValue::Type::boolean)
                                                                ? describe(object_)
                                                                : fmt::format("{}", object_.number));
      else if (object_.is(JsonValue::Type::array))
        d.hint = "write { \"default\": […] }";
      else if (object_.text.starts_with('#'))
        d.hint = "a colour is three numbers: { \"default\": [1.0, 0.5, 0.0] }";
      return std::nullopt;
    }
    context_.checkKeys(object_, kParameterKeys, what_, base::Foreign::value_key);
    out_.label = context_.text(object_.find("label"), "\"label\"");
    out_.doc = context_.text(object_.find("doc"), "\"doc\"");
    out_.define = context_.flag(object_.find("define"), "\"define\"");
    out_.min = context_.number(object_.find("min"), "\"min\"");
    out_.max = context_.number(object_.find("max"), "\"max\"");
    out_.step = context_.number(object_.find("step"), "\"step\"");
    readChoices();
    const JsonValue* initial = object_.find("default");
    if (!initial) return std::nullopt;
    out_.initialPlace = initial->place;
    const std::optional<ParameterType> type = typeOf(*initial);
    if (!type) return std::nullopt;
    out_.type = *type;
    if (!readDefault(*initial)) return std::nullopt;
    checkRange(*initial);
    checkCompany();
    return std::move(out_);
  }

 private:
  void readChoices() {
    const JsonValue* choices = object_.find("choices");
    if (!choices || !context_.expect(*choices, JsonValue::Type::array, "\"choices\"")) return;
    ReadContext::Seen seen;
    for (const JsonValue& choice : choices->items) {
      if (!context_.expect(choice, JsonValue::Type::string, "a choice")) continue;
      if (!context_.checkName(choice.text, choice.place, "a choice")) continue;
      if (context_.checkFresh(seen, choice.text, choice.place, "choice")) out_.choices.push_back(choice.text);
    }
    if (choices->items.empty()) {
      auto& d = context_.error(Code::wrongType, *choices, "\"choices\" is empty");
      d.expected = "an array of words";
    }
  }

  bool allWhole() const {
    for (const char* key : {"default", "min", "max", "step"}) {
      const JsonValue* value = object_.find(key);
      if (value && value->is(JsonValue::Type::number) && !value->whole) return false;
    }
    return true;
  }

  // What a text in the place of a number, or of a word among "choices", is meant as.
  static std::string hintForText(const std::string& text) {
    if (std::string color = text.starts_with('#') ? hintForSize(text) : ""; !color.empty()) return color;
    std::string number = text;
    std::ranges::replace(number, ',', '.');
    double value = 0;
    const char* const end = number.data() + number.size();
    const auto [at, error] = std::from_chars(number.data(), end, value);
    if (!number.empty() && error == std::errc() && at == end)
      return fmt::format("write {}, without quotes", number);
    if (text == "true" || text == "false") return fmt::format("write {}, without quotes", text);
    return "list the \"choices\", or say \"type\": \"file\"";
  }

  // The type that is written, else the one the default shows.
  std::optional<ParameterType> typeOf(const JsonValue& initial) {
    if (const JsonValue* written = object_.find("type")) {
      const std::optional<std::string> word = context_.word(written, kParameterTypes, "\"type\"");
      if (!word) return std::nullopt;
      return kTypes[static_cast<std::size_t>(
          std::find(kParameterTypes.begin(), kParameterTypes.end(), *word) - kParameterTypes.begin())];
    }
    switch (initial.type) {
      case JsonValue::Type::boolean:
        return ParameterType::boolean;
      case JsonValue::Type::number:
        return allWhole() ? ParameterType::integer : ParameterType::number;
      case JsonValue::Type::array:
        if (initial.items.size() == 2) return ParameterType::vec2;
        if (initial.items.size() == 3) return ParameterType::vec3;
        if (initial.items.size() == 4) return ParameterType::vec4;
        break;
      case JsonValue::Type::string: {
        if (object_.find("choices")) return ParameterType::choice;
        auto& d = context_.error(Code::missingKey, object_,
                                 fmt::format("{} has a string as its default, but no \"choices\"", what_));
        d.hint = hintForText(initial.text);
        return std::nullopt;
      }
      default:
        break;
    }
    auto& d =
        context_.error(Code::wrongType, initial, fmt::format("the default of {} has the wrong type", what_));
    d.expected = "a number, a boolean, a list of 2 to 4 numbers, or a word among \"choices\"";
    d.found = initial.is(JsonValue::Type::array) ? fmt::format("an array of {}", initial.items.size())
                                                 : describe(initial);
    return std::nullopt;
  }

  bool wrongDefault(const JsonValue& initial, std::string expected) {
    auto& d = context_.error(
        Code::wrongType, initial,
        fmt::format("the default of {} does not fit its type \"{}\"", what_, nameOf(out_.type)));
    d.expected = std::move(expected);
    d.found = initial.is(JsonValue::Type::array) ? fmt::format("an array of {}", initial.items.size())
                                                 : describe(initial);
    if (out_.type == ParameterType::boolean && initial.is(JsonValue::Type::number))
      d.hint = initial.number == 0 ? "write false" : "write true";
    return false;
  }

  bool readDefault(const JsonValue& initial) {
    switch (out_.type) {
      case ParameterType::boolean:
        if (!initial.is(JsonValue::Type::boolean)) return wrongDefault(initial, "true or false");
        out_.initial = Value::boolean(initial.flag);
        return true;
      case ParameterType::integer:
        if (!initial.is(JsonValue::Type::number) || initial.number != std::floor(initial.number))
          return wrongDefault(initial, "a whole number");
        out_.initial = Value::number(initial.number);
        return true;
      case ParameterType::number:
        if (!initial.is(JsonValue::Type::number)) return wrongDefault(initial, "a number");
        out_.initial = Value::number(initial.number);
        return true;
      case ParameterType::file:
        if (!initial.is(JsonValue::Type::string)) return wrongDefault(initial, "a path in a string, or \"\"");
        out_.initial = Value::text(base::besideFile(initial.textPlace(), initial.text));
        return true;
      case ParameterType::choice: {
        if (!initial.is(JsonValue::Type::string)) return wrongDefault(initial, "one of the \"choices\"");
        out_.initial = Value::text(initial.text);
        if (!object_.find("choices")) {
          context_.error(Code::missingKey, object_, fmt::format("{} is a choice without \"choices\"", what_))
              .hint = "list the words it may be";
          return false;
        }
        if (out_.choices.empty() ||
            std::find(out_.choices.begin(), out_.choices.end(), initial.text) != out_.choices.end())
          return true;
        auto& d = context_.error(Code::notAChoice, initial,
                                 fmt::format("the default of {} is not one of its choices", what_));
        d.expected = fmt::format("{}", fmt::join(out_.choices, ", "));
        d.found = initial.text;
        if (const std::string nearest = base::nearestName(initial.text, out_.choices); !nearest.empty())
          d.hint = fmt::format("did you mean \"{}\"?", nearest);
        out_.initial =
            Value::text(out_.choices[0]);  // expressions that it stands in have no mistake of their own
        return true;
      }
      default:
        break;
    }
    const std::size_t count = componentCount(out_.type);
    if (!initial.is(JsonValue::Type::array) || initial.items.size() != count)
      return wrongDefault(initial, fmt::format("a list of {} numbers", count));
    out_.initial.type = Value::Type::list;
    for (const JsonValue& item : initial.items) {
      if (!context_.expect(item, JsonValue::Type::number,
                           fmt::format("a component of the default of {}", what_)))
        return false;
      out_.initial.v[out_.initial.count++] = item.number;
    }
    return true;
  }

  void checkRange(const JsonValue& initial) {
    if (!isNumeric(out_.type)) return;
    if (out_.min && out_.max && *out_.min > *out_.max) {
      auto& d = context_.error(Code::outOfRange, *object_.find("min"),
                               fmt::format("the range of {} is empty", what_));
      d.found = fmt::format("min {}, max {}", *out_.min, *out_.max);
      d.hint = "min is the smaller one";
      return;
    }
    if (out_.step && *out_.step <= 0)
      context_
          .error(Code::outOfRange, *object_.find("step"),
                 fmt::format("the step of {} is not above zero", what_))
          .found = fmt::format("{}", *out_.step);
    if (out_.type == ParameterType::integer)
      for (const char* key : {"min", "max", "step"})
        if (const JsonValue* bound = object_.find(key);
            bound && bound->is(JsonValue::Type::number) && bound->number != std::floor(bound->number))
          context_
              .error(Code::wrongType, *bound,
                     fmt::format("\"{}\" of {}, which is an int, is not whole", key, what_))
              .expected = "a whole number";
    for (std::size_t i = 0; i < out_.initial.count; ++i) {
      const double x = out_.initial.v[i];
      if (!(out_.min && x < *out_.min) && !(out_.max && x > *out_.max)) continue;
      const JsonValue& at = initial.is(JsonValue::Type::array) ? initial.items[i] : initial;
      auto& d =
          context_.error(Code::outOfRange, at, fmt::format("the default of {} is out of its range", what_));
      d.expected = out_.min && out_.max ? fmt::format("a number from {} to {}", *out_.min, *out_.max)
                   : out_.min           ? fmt::format("a number from {} up", *out_.min)
                                        : fmt::format("a number up to {}", *out_.max);
      d.found = fmt::format("{}", x);
    }
  }

  // Keys that say nothing about a parameter of this type.
  void checkCompany() {
    const auto reject = [&](const char* key) {
      if (const JsonValue* value = object_.find(key)) {
        auto& d = context_.error(
            Code::keysExclude, *value,
            fmt::format("\"{}\" does not go with a parameter of type \"{}\"", key, nameOf(out_.type)));
        d.hint = "remove the key, or change the type";
      }
    };
    if (!isNumeric(out_.type))
      for (const char* key : {"min", "max", "step"}) reject(key);
    if (out_.type != ParameterType::choice) reject("choices");
  }

  ReadContext& context_;
  const JsonValue& object_;
  ParameterDesc out_;
  std::string what_;
};

}  // namespace

std::optional<ParameterDesc> readParameter(ReadContext& context, const JsonMember& member) {
  const bool named = context.checkName(member.key, member.place, "a parameter");
  std::optional<ParameterDesc> parameter = ParameterReader(context, member).run();
  return named ? parameter : std::nullopt;
}

std::optional<Value> readValue(ReadContext& context, const JsonMember& member) {
  const JsonValue& value = member.value;
  switch (value.type) {
    case JsonValue::Type::number:
      return Value::number(value.number);
    case JsonValue::Type::boolean:
      return Value::boolean(value.flag);
    case JsonValue::Type::string:
      return Value::text(value.text);
    case JsonValue::Type::array: {
      Value list;
      list.type = Value::Type::list;
      for (const JsonValue& item : value.items)
        if (item.is(JsonValue::Type::number) && list.count < list.v.size())
          list.v[list.count++] = item.number;
      if (value.items.size() >= 2 && list.count == value.items.size()) return list;
      break;
    }
    default:
      break;
  }
  auto& d =
      context.error(Code::wrongType, value, fmt::format("the value of '{}' has the wrong type", member.key));
  d.expected = "a number, true or false, a word, a path, or a list of two to four numbers";
  d.found = describe(value);
  return std::nullopt;
}

}  // namespace weft::graph
