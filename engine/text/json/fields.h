// Reads the members of a JSON object by key. A key that was asked for is known; finish() reports all other keys as
// W004, with the nearest known name. An absent key yields nothing. A wrong value is reported (W003, or the range
// code given to the constructor) and yields nothing, too.
#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/json/dom.h"

namespace weft::text {

struct NumberRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool aboveMin = false;  // min itself is outside
  bool whole = false;
};

// The value as a number in range, or a report: `name` stands in the message ("radius of spheres[3]").
std::optional<double> readNumber(const JsonValue& value, std::string_view name, const NumberRange& range,
                                 Code rangeCode, Diagnostics& diagnostics);
std::optional<std::string> readText(const JsonValue& value, std::string_view name, Diagnostics& diagnostics);
// An array of `count` numbers, three or two; the third of two is 0.
std::optional<std::array<double, 3>> readNumbers(const JsonValue& value, std::string_view name,
                                                 const NumberRange& range, Code rangeCode,
                                                 Diagnostics& diagnostics, std::size_t count = 3);
// False after a W003 that says what was expected.
bool expectType(const JsonValue& value, std::string_view name, JsonValue::Type type,
                Diagnostics& diagnostics);

class JsonFields {
 public:
  // `what` names the object in messages: "camera 'front'". Reports W003 when `object` is none; then it has no members.
  JsonFields(const JsonValue& object, std::string what, Code rangeCode, Diagnostics& diagnostics);

  // The member, or null.
  const JsonValue* find(std::string_view key);
  // Reports W005 for each key that is absent.
  void require(std::initializer_list<std::string_view> keys);

  std::optional<double> number(std::string_view key, const NumberRange& range = {});
  std::optional<std::array<double, 3>> numbers(std::string_view key, const NumberRange& range = {},
                                               std::size_t count = 3);
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  // A member that must be an object or an array, or null.
  const JsonValue* object(std::string_view key) { return find(key, JsonValue::Type::object); }
  const JsonValue* array(std::string_view key) { return find(key, JsonValue::Type::array); }

  // Reports every key that was not asked for. "$schema" is always known.
  void finish();

 private:
  const JsonValue* find(std::string_view key, JsonValue::Type type);
  std::string nameOf(std::string_view key) const;

  const JsonValue& object_;
  std::string what_;
  Code rangeCode_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_{"$schema"};
};

}  // namespace weft::text
