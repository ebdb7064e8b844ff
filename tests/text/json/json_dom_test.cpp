#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "engine/text/json/dom.h"

using namespace weft::text;

namespace {

const FileName kFile = "t.json";

JsonValue parse(std::string_view text) {
  Diagnostics diagnostics;
  auto value = parseJson(text, kFile, diagnostics);
  REQUIRE_MESSAGE(value, diagnostics.text());
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  return *std::move(value);
}

std::string at(const weft::text::Where& place) {
  return std::to_string(place.line) + ":" + std::to_string(place.column);
}

// "line:column message" of the only diagnostic.
std::string broken(std::string_view text, Code code = Code::notJson) {
  Diagnostics diagnostics;
  CHECK(!parseJson(text, kFile, diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  const auto& d = diagnostics.items()[0];
  CHECK(d.code == code);
  REQUIRE(d.place.file);
  CHECK(*d.place.file == "t.json");
  return at(d.place) + " " + d.message;
}

}  // namespace

TEST_CASE("every value and key knows its place, and a place its pointer") {
  const JsonValue root = parse(
      "{ // a comment with \"quotes\" \\\" and 12\n"
      "  \"a\": 12, \"b/c~\": [true, -1.5e3 , null],\n"
      "\t\"s\\\"\\\\\": \"x\\\"y\\\\\", /* \"no\" */ \"o\": { \"deep\": \"\xC3\xA9\" }, \"e\": [], \"last\": "
      "7}\n");
  CHECK(at(root.place) == "1:1");
  REQUIRE(root.members.size() == 6);
  CHECK(at(root.members[0].place) == "2:3");
  CHECK(at(root.members[0].value.place) == "2:8");
  CHECK(root.members[0].value.number == 12);
  CHECK(root.members[0].value.whole);
  CHECK(pointerAt(root, root.begin) == "");
  CHECK(pointerAt(root, root.members[0].begin) == "/a");
  CHECK(pointerAt(root, root.members[0].value.begin) == "/a");
  const JsonValue& list = root.members[1].value;
  CHECK(pointerAt(root, list.begin) == "/b~1c~0");
  CHECK(at(list.place) == "2:20");
  CHECK(at(list.items[0].place) == "2:21");
  CHECK(list.items[0].flag);
  CHECK(at(list.items[1].place) == "2:27");
  CHECK(list.items[1].number == -1500);
  CHECK(!list.items[1].whole);
  CHECK(pointerAt(root, list.items[1].begin) == "/b~1c~0/1");
  CHECK(at(list.items[2].place) == "2:36");
  CHECK(root.members[2].key == "s\"\\");
  CHECK(at(root.members[2].place) == "3:2");
  CHECK(root.members[2].value.text == "x\"y\\");
  CHECK(at(root.members[2].value.place) == "3:11");
  CHECK(at(root.members[2].value.textPlace()) == "3:12");
  CHECK(at(root.members[3].place) == "3:32");
  CHECK(root.members[3].value.find("deep")->text == "\xC3\xA9");
  CHECK(pointerAt(root, root.members[3].value.find("deep")->begin + 1) == "/o/deep");
  CHECK(root.find("nothing") == nullptr);
  CHECK(root.find("e")->is(JsonValue::Type::array));
  CHECK(root.find("last")->number == 7);
}

TEST_CASE("numbers at the end, byte order mark, carriage returns, whole numbers") {
  CHECK(parse("42").number == 42);
  CHECK(at(parse("  -0.5").place) == "1:3");
  CHECK(at(parse("[1,2]").items[1].place) == "1:4");
  CHECK(at(parse("\xEF\xBB\xBF{\"a\": 1}").members[0].place) == "1:2");
  CHECK(at(parse("{\r\n\"a\": 1}").members[0].place) == "2:1");
  CHECK(parse("12345678901234567890123").whole);
  CHECK(!parse("1.0").whole);
  CHECK(!parse("1e2").whole);
  CHECK(parse("-9223372036854775808").number == -9223372036854775808.0);
}

TEST_CASE("truncated files end inside what is open") {
  CHECK(broken("{\n  \"a\": [1, 2") == "2:13 the file ends inside the array that opens at 2:8");
  CHECK(broken("{\"a\": {\n\n  ") == "1:8 the file ends inside the object that opens at 1:7");
  CHECK(broken("{\"a\": 1,") == "1:9 the file ends inside the object that opens at 1:1");
  CHECK(broken("{\"a\"") == "1:5 the file ends inside the object that opens at 1:1");
  CHECK(broken("{\"a\": \"xyz") == "1:7 the string that opens here is not closed on its line");
  CHECK(broken("{\"a\": /* x") == "1:7 the comment that opens here is never closed");
  for (const char* nothing : {"", " \n "}) CHECK(broken(nothing) == "1:1 the file holds no value");
  CHECK(broken("// nothing") == "1:11 the file holds no value");
}

TEST_CASE("broken files: the place of the offending token, in words") {
  CHECK(broken("{\"a\": [1, 2,]}") == "1:13 ']' where a value is expected");
  CHECK(broken("{\"a\": 1,}") == "1:9 '}' where a key in double quotes is expected");
  CHECK(broken("{\n \"a\": 1\n \"b\": 2}") == "3:2 '\"b\"' where ',' or '}' is expected");
  CHECK(broken("[1 2]") == "1:4 '2' where ',' or ']' is expected");
  CHECK(broken("[1, 2}") == "1:6 '}' where ',' or ']' is expected");
  CHECK(broken("{\"a\" 1}") == "1:6 '1' where ':' is expected");
  CHECK(broken("{a: 1}") == "1:2 'a' where a key in double quotes is expected");
  CHECK(broken("{'a': 1}") == "1:2 ''a'' where a key in double quotes is expected");
  CHECK(broken("{} {}") == "1:4 '{' where the end of the file is expected");
  CHECK(broken("{}}") == "1:3 '}' where the end of the file is expected");
  CHECK(broken("01") == "1:1 '01' is not a JSON value");
  for (const char* word : {"12-3", "NaN", "-Infinity", "nulL", "true@", "trueX", "1.", ".5", "#", "\xC2\xB5"})
    CHECK(broken("[" + std::string(word) + "]") == "1:2 '" + std::string(word) + "' is not a JSON value");
  CHECK(broken("{\"a\": tru") == "1:7 'tru' is not a JSON value");
  CHECK(broken("[1, 1e999]") == "1:5 1e999 is beyond what a number can be");
  CHECK(broken("[\"a\nb\"]") == "1:2 the string that opens here is not closed on its line");
  CHECK(broken("{ \"a\": \"soft, \"b\": 1 }") == "1:16 'b' where ',' or '}' is expected");
  CHECK(broken("[\"a\tb\"]") == "1:4 a control character in a string");
  for (const char* escape : {"[\"luts\\qx\"]", "[\"luts\\u12x\"]", "[\"luts\\ud800\"]"})
    CHECK(broken(escape) == "1:7 an escape that JSON does not have");
  CHECK(broken("[\"a\xFF\"]") == "1:4 the byte 0xFF is not UTF-8");
  CHECK(broken("[\"\xC3(\"]") == "1:3 the byte 0xC3 is not UTF-8");
  CHECK(broken("[1 / 2]") == "1:4 '/' where ',' or ']' is expected");
  CHECK(broken(std::string_view("{}\0{", 4)).starts_with("1:3 "));
}

TEST_CASE("depth is limited, not the stack") {
  std::string fits, deep;
  for (int i = 0; i < kMaxJsonDepth; ++i) fits += '[';
  deep = fits + "[";
  fits.append(kMaxJsonDepth, ']');
  parse(fits);
  CHECK(broken(deep, Code::nestedTooDeeply) == "1:65 objects and arrays are nested more than 64 levels deep");
  CHECK(broken(std::string(1000000, '['), Code::nestedTooDeeply).substr(0, 4) == "1:65");
}

TEST_CASE("duplicate keys are reported and the first is kept") {
  Diagnostics diagnostics;
  const std::string text = "{\"a\": 1,\n \"b\": {\"a\": 2},\n \"a\": {\"x\": [1]}, \"c\": 3, \"a\": 4}";
  const auto root = parseJson(text, kFile, diagnostics);
  REQUIRE(root);
  REQUIRE(diagnostics.size() == 2);
  CHECK(diagnostics.items()[0].code == Code::duplicateKey);
  CHECK(at(diagnostics.items()[0].place) == "3:2");
  CHECK(diagnostics.items()[0].hint == "remove one; the first is at 1:2");
  CHECK(at(diagnostics.items()[1].place) == "3:27");
  CHECK(root->members.size() == 3);
  CHECK(root->find("a")->number == 1);
  CHECK(root->find("c")->number == 3);
}

TEST_CASE("accepts exactly what nlohmann's own parser accepts") {
  // Every one-byte change of a text with all kinds of tokens in it.
  const std::string text =
      "{\"a\": [1, -2.5e+3, true, false, null], // c\n \"b\\n\\u00e9\": {\"\": \"x\"}, /* d */ \"z\": []}";
  const std::string alphabet = "{}[],:\"\\/ *\n\t019.-+eEtrufalsn\xC3\xA9\x01";
  int accepted = 0, refused = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    for (const char c : alphabet) {
      std::string mutant = text;
      mutant[i] = c;
      Diagnostics diagnostics;
      const bool ours = parseJson(mutant, kFile, diagnostics).has_value();
      CHECK_MESSAGE(ours == nlohmann::ordered_json::accept(mutant, true), mutant);
      if (!ours) CHECK(diagnostics.size() >= 1);
      ++(ours ? accepted : refused);
    }
  CHECK(accepted > 100);
  CHECK(refused > 100);
}

TEST_CASE("a tree of any text: what is broken is passed over, comments are listed") {
  const JsonTree tree =
      parseJsonTree("{ \"a\": [1, tru, 2 /* c */, \"x\n], \"b\" \"c\": { , \"d\": \n /* open\n \"e\": 3");
  REQUIRE(tree.root.members.size() == 3);
  CHECK_FALSE(tree.root.closed);
  const JsonMember &a = tree.root.members[0], &b = tree.root.members[1], &c = tree.root.members[2];
  REQUIRE(a.value.items.size() == 4);
  CHECK(a.value.items[1].is(JsonValue::Type::broken));
  CHECK(a.value.items[2].number == 2);
  CHECK(a.value.items[3].text == "x");
  CHECK_FALSE(a.value.items[3].closed);
  CHECK(b.key == "b");
  CHECK_FALSE(b.hasValue);
  CHECK(b.value.is(JsonValue::Type::absent));
  REQUIRE(c.value.members.size() == 1);
  CHECK(c.value.members[0].value.text ==
        "e");  // a value of the next line: the comma in between is not there yet
  CHECK(tree.comments.size() == 2);
  CHECK(tree.behindComment(tree.comments[0].begin) == tree.comments[0].end);
  CHECK(tree.behindComment(0) == 0);
}
