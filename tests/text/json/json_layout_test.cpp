// The one layout of JSON files: what it looks like, that it stays, and that nothing but white space moves.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "engine/text/json/dom.h"
#include "engine/text/json/edit.h"

using namespace weft::text;

namespace {

std::string layout(std::string_view text) {
  return layoutJson(text);
}

bool isGood(const std::string& text) {
  Diagnostics diagnostics;
  return parseJson(text, {}, diagnostics) && diagnostics.empty();
}

// Comments in order, without white space at their ends.
std::vector<std::string> commentsOf(const std::string& text) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      for (++i; text[i] != '"'; ++i)
        if (text[i] == '\\') ++i;
    } else if (text[i] == '/') {
      const bool line = text[i + 1] == '/';
      std::size_t end = line ? text.find('\n', i) : text.find("*/", i) + 2;
      if (end == std::string::npos) end = text.size();
      std::string comment = text.substr(i, end - i);
      while (comment.back() == ' ' || comment.back() == '\r' || comment.back() == '\t') comment.pop_back();
      found.push_back(comment);
      i = end - 1;
    }
  }
  return found;
}

// Everything that must hold for any text; the laid out one.
std::string checked(const std::string& text) {
  const std::string laid = layout(text);
  INFO(text);
  INFO(laid);
  CHECK(layout(laid) == laid);
  CHECK(commentsOf(laid) == commentsOf(text));
  const auto before = nlohmann::ordered_json::parse(text, nullptr, true, true),
             after = nlohmann::ordered_json::parse(laid, nullptr, true, true);
  CHECK(before == after);
  CHECK(before.dump() == after.dump());  // members too stand in their order
  CHECK(laid.ends_with('\n'));
  CHECK_FALSE(laid.ends_with("\n\n"));
  return laid;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string readAll(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

}  // namespace

TEST_CASE("layout: sections a row each, stanzas with their words first, short objects on one line") {
  CHECK(checked(R"({"name":"a","let":{"n":"1+1"},
"resources":{"hdr":{"texture":"rgba16f","size":"screen"},
"velocity":{"texture":"rg16f","size":[1,2]}},"passes":[
{"name":"fill","type":"fullscreen","shader":"some/folder/with/a/long/name/fill.frag.glsl","enabled":"$one && $two",
"read":{"a":"hdr"},"write":{"b":"hdr"},"parameters":{"amount":{"type":"float","default":1.0,"min":0,"max":8,"label":"Amount of it all"},"b":2,"c":3,
"more":{"default":[]}}},{"name":"b"}],"empty":{},"none":[]})") == R"({
  "name": "a",
  "let": { "n": "1+1" },
  "resources": {
    "hdr":      { "texture": "rgba16f", "size": "screen" },
    "velocity": { "texture": "rg16f", "size": [1, 2] }
  },
  "passes": [
    { "name": "fill", "type": "fullscreen", "shader": "some/folder/with/a/long/name/fill.frag.glsl",
      "enabled": "$one && $two",
      "read": { "a": "hdr" }, "write": { "b": "hdr" },
      "parameters": {
        "amount": { "type": "float", "default": 1.0, "min": 0, "max": 8, "label": "Amount of it all" },
        "b": 2, "c": 3,
        "more": { "default": [] } } },
    { "name": "b" }
  ],
  "empty": {},
  "none": []
}
)");
}

TEST_CASE("layout: a list of slots begins a line as an object of them does, and others follow it") {
  CHECK(
      checked(
          R"({"passes":[{"name":"first_of_two","shader":"folder/first.frag.glsl","read":["alpha","beta",{"gamma":"delta"}],
"write":{"color":"target"},"parameters":{"radius":3,"strength":1}},{"name":"b"}]})") == R"({
  "passes": [
    { "name": "first_of_two", "shader": "folder/first.frag.glsl",
      "read": ["alpha", "beta", { "gamma": "delta" }], "write": { "color": "target" },
      "parameters": { "radius": 3, "strength": 1 } },
    { "name": "b" }
  ]
}
)");
}

TEST_CASE("layout: words in a table of objects stand in its column, words alone and settings do not") {
  CHECK(checked(R"({"resources":{"hdr":{"input":"texture"},"old_hdr":"hdr@-1","order":["a","b"],

"environment":"ibl.environment","brdf":"ibl.brdf"},"set":{"tint":[1,2,3],"exposure":1.5,"a_name_that_is_long":[1,2,3,4],
"another_name_that_is_long":true,"a_third_name":3}})") == R"({
  "resources": {
    "hdr":     { "input": "texture" },
    "old_hdr": "hdr@-1",
    "order":   ["a", "b"],

    "environment": "ibl.environment",
    "brdf": "ibl.brdf"
  },
  "set": {
    "tint": [1, 2, 3], "exposure": 1.5, "a_name_that_is_long": [1, 2, 3, 4], "another_name_that_is_long": true,
    "a_third_name": 3
  }
}
)");
}

TEST_CASE("layout: comments stay beside what they are about, blank lines between entries stay one") {
  CHECK(checked(R"(// before all

/* a block
   of two lines */
{ // about the first
  "a": /* value */ 1 /* one */, // behind one



  // about b
  // two lines of it

  "b": [ 1, // first
    2 ],
  "c": { "d": { "e": 1 } /* inner */,

    "f": { "g": 2 } }, /* of d */ "d": 4
  // last
}
// after all)") == R"(// before all

/* a block
   of two lines */
{
  // about the first
  /* value */
  "a": 1 /* one */, // behind one

  // about b
  // two lines of it

  "b": [
    1, // first
    2
  ],
  "c": {
    "d": { "e": 1 } /* inner */,

    "f": { "g": 2 }
  },
  /* of d */
  "d": 4
  // last
}
// after all
)");
}

TEST_CASE("layout: numbers and strings as they are written, line ends and a byte order mark too") {
  const std::string text =
      "\xEF\xBB\xBF{\r\n\"a\" : [1.0,1e3 , -0.50],\r\n\r\n\"b\":\"caf\\u00e9 \xC3\xA9 \\\" // no comment\" }";
  const std::string laid = layout(text);
  CHECK(laid ==
        "\xEF\xBB\xBF{\r\n  \"a\": [1.0, 1e3, -0.50],\r\n\r\n  \"b\": \"caf\\u00e9 \xC3\xA9 \\\" // no "
        "comment\"\r\n}\r\n");
  CHECK(layout(laid) == laid);
  // 120 characters, not bytes.
  std::string wide = "{ \"a\": { \"b\": \"";
  for (int i = 0; i < 90; ++i) wide += "\xC3\xA9";
  CHECK(linesOf(checked(wide + "\", \"c\": 1 } }")).size() == 3);
}

TEST_CASE("layout: the same values give the same text, however they were laid out") {
  for (const char* folder : {"graphs", "graphs/effects", "graphs/presets"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(WEFT_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".json") continue;
      CAPTURE(entry.path().string());
      const auto value = nlohmann::ordered_json::parse(readAll(entry.path()), nullptr, true, true);
      const std::string minified = value.dump(), airy = value.dump(7);
      CHECK(layout(minified) == layout(airy));
      checked(minified);
    }
}

TEST_CASE("layout: of every JSON file of the repository only white space moves") {
  int files = 0;
  for (const char* folder : {"graphs", "tests", "scenes", "materials", "docs"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(WEFT_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".json" || entry.file_size() > 300'000) continue;
      const std::string text = readAll(entry.path());
      if (!isGood(text)) continue;
      CAPTURE(entry.path().string());
      checked(text);
      ++files;
    }
  CHECK(files > 150);
}

TEST_CASE("layout: random values with comments and blank lines anywhere") {
  std::mt19937 random(20261122);
  const auto pick = [&](unsigned most) { return static_cast<unsigned>(random() % most); };
  int number = 0;
  const auto gap = [&] {
    std::string text;
    for (unsigned i = pick(3); i > 0; --i)
      text += std::string(pick(4), ' ') + std::string(pick(4) == 0 ? pick(4) : 0, '\n');
    if (pick(12) == 0) text += "// line " + std::to_string(number++) + std::string(pick(70), 'x') + "\n";
    if (pick(12) == 0)
      text += "/* block " + std::to_string(number++) + (pick(3) == 0 ? "\n  more */" : " */");
    return text + std::string(pick(2), ' ');
  };
  const auto value = [&](const auto& self, int depth) -> std::string {
    switch (pick(depth > 5 ? 3 : 6)) {
      case 0:
        return std::to_string(static_cast<int>(pick(2000)) - 1000) + (pick(2) ? ".50" : "");
      case 1:
        return pick(2) ? "true" : "null";
      case 2:
        return "\"" + std::string(pick(50), 's') + (pick(4) == 0 ? "\\\"//" : "") + "\"";
      case 3: {
        std::string text = "[" + gap();
        const unsigned count = pick(5);
        for (unsigned i = 0; i < count; ++i) text += (i ? "," : "") + gap() + self(self, depth + 1) + gap();
        return text + "]";
      }
      default: {
        std::string text = "{" + gap();
        const unsigned count = pick(7);
        for (unsigned i = 0; i < count; ++i)
          text += (i ? "," : "") + gap() + "\"k" + std::to_string(i) + std::string(pick(14), 'k') + "\"" +
                  gap() + ":" + gap() + self(self, depth + 1) + gap();
        return text + "}";
      }
    }
  };
  for (int round = 0; round < 4000; ++round) {
    const std::string text = gap() + value(value, 0) + gap();
    REQUIRE_MESSAGE(isGood(text), text);
    checked(text);
  }
}
