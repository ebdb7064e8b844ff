#include <doctest/doctest.h>

#include "engine/text/json/fields.h"

using namespace weft::text;

static JsonValue parseGood(std::string_view text) {
  Diagnostics diagnostics;
  auto value = parseJson(text, "f.json", diagnostics);
  REQUIRE_MESSAGE(value, diagnostics.text());
  return *value;
}

TEST_CASE("present members are read, absent ones are nothing, and neither is an error") {
  const JsonValue value = parseGood(R"({"n": 2.5, "b": true, "t": "x", "v": [1, 2, 3], "o": {}, "a": []})");
  Diagnostics diagnostics;
  JsonFields fields(value, "the thing", Code::badSceneValue, diagnostics);
  CHECK(fields.number("n") == 2.5);
  CHECK(fields.boolean("b") == true);
  CHECK(fields.text("t") == "x");
  CHECK(fields.numbers("v") == std::array<double, 3>{1, 2, 3});
  CHECK(fields.object("o"));
  CHECK(fields.array("a"));
  CHECK_FALSE(fields.number("absent"));
  CHECK_FALSE(fields.object("missing"));
  fields.finish();
  CHECK(diagnostics.empty());
}

TEST_CASE("wrong types, ranges, unknown and missing keys") {
  const std::string text = "{\"n\": \"x\",\n \"m\": 3, \"v\": [1, 2], \"w\": [1, null, 9], \"lenght\": 1}";
  const JsonValue value = parseGood(text);
  Diagnostics diagnostics;
  JsonFields fields(value, "the thing", Code::badSceneValue, diagnostics);
  fields.require({"n", "absent"});
  CHECK_FALSE(fields.number("n"));
  CHECK_FALSE(fields.number("m", {.min = 0, .max = 1}));
  CHECK_FALSE(fields.numbers("v"));
  CHECK_FALSE(fields.numbers("w", {.max = 5}));
  fields.number("length");
  fields.finish();
  REQUIRE(diagnostics.size() == 7);
  CHECK(diagnostics.items()[0].code == Code::missingKey);
  CHECK(diagnostics.items()[1].code == Code::wrongType);
  CHECK(diagnostics.items()[2].code == Code::badSceneValue);
  CHECK(diagnostics.items()[2].place.line == 2);
  CHECK(diagnostics.items()[2].expected == "a number from 0 up to 1");
  CHECK(diagnostics.items()[3].expected == "an array of three numbers");
  CHECK(diagnostics.items()[4].code == Code::wrongType);
  CHECK(diagnostics.items()[5].place.column == 38);
  CHECK(diagnostics.items()[6].hint == "did you mean 'length'?");
}

TEST_CASE("whole numbers and open ends") {
  const JsonValue value = parseGood(R"({"a": 1.5, "b": 0, "c": 3})");
  Diagnostics diagnostics;
  JsonFields fields(value, "the thing", Code::badSceneValue, diagnostics);
  CHECK_FALSE(fields.number("a", {.whole = true}));
  CHECK_FALSE(fields.number("b", {.min = 0, .aboveMin = true}));
  CHECK(fields.number("c", {.min = 0, .aboveMin = true, .whole = true}) == 3);
  CHECK(diagnostics.errorCount() == 2);
}

TEST_CASE("something that is no object is one error") {
  const JsonValue value = parseGood("[1]");
  Diagnostics diagnostics;
  JsonFields fields(value, "the thing", Code::badSceneValue, diagnostics);
  fields.require({"a"});
  CHECK_FALSE(fields.number("a"));
  fields.finish();
  CHECK(diagnostics.errorCount() == 1);
}
