#include "engine/text/json/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/text/nearest.h"
#include "text_sentences.h"

namespace weft::text {

namespace {

std::string describeRange(const NumberRange& range) {
  std::string text = range.whole ? "a whole number" : "a number";
  if (std::isfinite(range.min)) text += fmt::format(" {} {}", range.aboveMin ? "over" : "from", range.min);
  if (std::isfinite(range.max)) text += fmt::format(" up to {}", range.max);
  return text;
}

void reportType(const JsonValue& value, std::string_view name, Diagnostics& diagnostics,
                std::string expected) {
  diagnostics.error(say::wrongType, value.place, name, expected, describe(value));
}

}  // namespace

std::optional<double> readNumber(const JsonValue& value, std::string_view name, const NumberRange& range,
                                 Code rangeCode, Diagnostics& diagnostics) {
  if (!value.is(JsonValue::Type::number)) {
    reportType(value, name, diagnostics, describeRange(range));
    return {};
  }
  const double number = value.number;
  const bool inside = (range.aboveMin ? number > range.min : number >= range.min) && number <= range.max &&
                      (!range.whole || number == std::floor(number));
  if (inside) return number;
  diagnostics.add({.code = rangeCode,
                   .message = fmt::format("{} is out of range", name),
                   .place = value.place,
                   .expected = describeRange(range),
                   .found = describe(value)});
  return {};
}

std::optional<std::string> readText(const JsonValue& value, std::string_view name, Diagnostics& diagnostics) {
  if (!expectType(value, name, JsonValue::Type::string, diagnostics)) return {};
  return value.text;
}

std::optional<std::array<double, 3>> readNumbers(const JsonValue& value, std::string_view name,
                                                 const NumberRange& range, Code rangeCode,
                                                 Diagnostics& diagnostics, std::size_t count) {
  if (!value.is(JsonValue::Type::array) || value.items.size() != count) {
    reportType(value, name, diagnostics, fmt::format("an array of {} numbers", count == 2 ? "two" : "three"));
    return {};
  }
  std::array<double, 3> numbers{};
  bool good = true;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number =
        readNumber(value.items[i], fmt::format("{}[{}]", name, i), range, rangeCode, diagnostics);
    good = good && number.has_value();
    numbers[i] = number.value_or(0);
  }
  if (!good) return {};
  return numbers;
}

bool expectType(const JsonValue& value, std::string_view name, JsonValue::Type type,
                Diagnostics& diagnostics) {
  if (value.is(type)) return true;
  reportType(value, name, diagnostics, nameOf(type));
  return false;
}

JsonFields::JsonFields(const JsonValue& object, std::string what, Code rangeCode, Diagnostics& diagnostics)
    : object_(object), what_(std::move(what)), rangeCode_(rangeCode), diagnostics_(diagnostics) {
  expectType(object, what_, JsonValue::Type::object, diagnostics);
}

std::string JsonFields::nameOf(std::string_view key) const {
  return fmt::format("'{}' of {}", key, what_);
}

const JsonValue* JsonFields::find(std::string_view key) {
  if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
  return object_.find(key);
}

const JsonValue* JsonFields::find(std::string_view key, JsonValue::Type type) {
  const JsonValue* value = find(key);
  return value && expectType(*value, nameOf(key), type, diagnostics_) ? value : nullptr;
}

void JsonFields::require(std::initializer_list<std::string_view> keys) {
  if (!object_.is(JsonValue::Type::object)) return;
  for (const std::string_view key : keys) {
    if (!object_.find(key)) diagnostics_.error(say::missingKey, object_.place, what_, key);
  }
}

std::optional<double> JsonFields::number(std::string_view key, const NumberRange& range) {
  const JsonValue* value = find(key);
  return value ? readNumber(*value, nameOf(key), range, rangeCode_, diagnostics_) : std::nullopt;
}

std::optional<std::array<double, 3>> JsonFields::numbers(std::string_view key, const NumberRange& range,
                                                         std::size_t count) {
  const JsonValue* value = find(key);
  return value ? readNumbers(*value, nameOf(key), range, rangeCode_, diagnostics_, count) : std::nullopt;
}

std::optional<bool> JsonFields::boolean(std::string_view key) {
  const JsonValue* value = find(key, JsonValue::Type::boolean);
  return value ? std::optional(value->flag) : std::nullopt;
}

std::optional<std::string> JsonFields::text(std::string_view key) {
  const JsonValue* value = find(key, JsonValue::Type::string);
  return value ? std::optional(value->text) : std::nullopt;
}

void JsonFields::finish() {
  for (const JsonMember& member : object_.members) {
    if (std::ranges::find(known_, member.key) != known_.end()) continue;
    diagnostics_.error(say::unknownKey, member.place, what_, member.key, nearestHint(member.key, known_));
  }
}

}  // namespace weft::text
