#include <doctest/doctest.h>

#include <optional>

#include "engine/text/json/edit.h"
#include "tests/json_pointer.h"

using namespace weft::text;

namespace {

// Nothing when the text has mistakes, or the pointer leads nowhere.
template <class Change>
std::optional<std::string> changed(std::string_view text, std::string_view pointer, const Change& change) {
  const JsonEdit edit(text);
  const JsonValue* value = edit ? weft::test::findPointer(edit.root(), pointer) : nullptr;
  return value ? std::optional(change(edit, *value)) : std::nullopt;
}
std::optional<std::string> replaceValue(std::string_view text, std::string_view pointer,
                                        std::string_view json) {
  return changed(text, pointer,
                 [&](const JsonEdit& edit, const JsonValue& value) { return edit.withValue(value, json); });
}
std::optional<std::string> insertMember(std::string_view text, std::string_view pointer, std::string_view key,
                                        std::string_view json, std::string_view after = {}) {
  return changed(text, pointer, [&](const JsonEdit& edit, const JsonValue& value) {
    return edit.withMember(value, key, json, after);
  });
}
std::optional<std::string> appendItem(std::string_view text, std::string_view pointer,
                                      std::string_view json) {
  return changed(text, pointer,
                 [&](const JsonEdit& edit, const JsonValue& value) { return edit.withItem(value, json); });
}

}  // namespace

TEST_CASE("a replaced value changes and no other byte") {
  const std::string text =
      "// head \"a\": 0\r\n{\t\"a\" : 1.5 , /* b */ \"b\":[1,{\"c\":\"x\\\"}y\"}] ,\r\n \"a/b~\": true // "
      "tail\r\n}\r\n";
  CHECK(replaceValue(text, "/a", "-2e3") ==
        "// head \"a\": 0\r\n{\t\"a\" : -2e3 , /* b */ \"b\":[1,{\"c\":\"x\\\"}y\"}] ,\r\n \"a/b~\": true // "
        "tail\r\n}\r\n");
  CHECK(replaceValue(text, "/b/1/c", "\"z\"") ==
        "// head \"a\": 0\r\n{\t\"a\" : 1.5 , /* b */ \"b\":[1,{\"c\":\"z\"}] ,\r\n \"a/b~\": true // "
        "tail\r\n}\r\n");
  CHECK(replaceValue(text, "/b", "[]") ==
        "// head \"a\": 0\r\n{\t\"a\" : 1.5 , /* b */ \"b\":[] ,\r\n \"a/b~\": true // tail\r\n}\r\n");
  CHECK(replaceValue(text, "/a~1b~0", "false") ==
        "// head \"a\": 0\r\n{\t\"a\" : 1.5 , /* b */ \"b\":[1,{\"c\":\"x\\\"}y\"}] ,\r\n \"a/b~\": false // "
        "tail\r\n}\r\n");
  CHECK_FALSE(replaceValue(text, "/c", "1"));
  CHECK_FALSE(replaceValue("{", "/c", "1"));
}

TEST_CASE("a byte order mark and characters beyond ASCII do not move places") {
  CHECK(replaceValue("\xEF\xBB\xBF{ \"k\": 1 }", "/k", "2") == "\xEF\xBB\xBF{ \"k\": 2 }");
  CHECK(replaceValue("\xEF\xBB\xBF{ \"name\": \"Größe → ∞\", \"k\": 1 }", "/k", "2") ==
        "\xEF\xBB\xBF{ \"name\": \"Größe → ∞\", \"k\": 2 }");
}

TEST_CASE("a new member stands where the others stand") {
  CHECK(insertMember("{}", "", "k", "1") == "{ \"k\": 1 }");
  CHECK(insertMember("{ \"a\": 1 }", "", "k", "1") == "{ \"a\": 1, \"k\": 1 }");
  CHECK(insertMember("{ \"a\": 1, \"b\": 2 }", "", "k", "1", "a") == "{ \"a\": 1, \"k\": 1, \"b\": 2 }");
  CHECK(insertMember("{\n\t\"a\": 1\n}\n", "", "k", "1") == "{\n\t\"a\": 1,\n\t\"k\": 1\n}\n");
  CHECK(insertMember("{\r\n  \"a\": 1, // one\r\n  \"b\": 2 // two\r\n}\r\n", "", "k", "3") ==
        "{\r\n  \"a\": 1, // one\r\n  \"b\": 2, // two\r\n  \"k\": 3\r\n}\r\n");
  CHECK(insertMember("{\n  \"a\": 1, // one\n  \"b\": 2\n}\n", "", "k", "3", "a") ==
        "{\n  \"a\": 1, // one\n  \"k\": 3,\n  \"b\": 2\n}\n");
  // Members that share lines: the new one does too.
  CHECK(
      insertMember("{ \"passes\": [\n  { \"name\": \"a\", \"type\": \"t\",\n    \"read\": {} }\n] }",
                   "/passes/0", "enabled", "false", "type") ==
      "{ \"passes\": [\n  { \"name\": \"a\", \"type\": \"t\", \"enabled\": false,\n    \"read\": {} }\n] }");
  CHECK_FALSE(insertMember("{ \"k\": 1", "", "l", "2"));
}

TEST_CASE("a new item stands behind the last") {
  CHECK(appendItem("{ \"p\": [] }", "/p", "{}") == "{ \"p\": [{}] }");
  CHECK(appendItem("[1, 2]", "", "3") == "[1, 2, 3]");
  CHECK(appendItem("[\n  1, // one\n  2 /* two */ // zwei\n]", "", "3") ==
        "[\n  1, // one\n  2, /* two */ // zwei\n  3\n]");
}

TEST_CASE("strings are escaped as JSON wants it") {
  CHECK(quoteJson("a \"b\" \\ \n ü") == "\"a \\\"b\\\" \\\\ \\n ü\"");
}
