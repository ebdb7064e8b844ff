// What is declared and never used (W089), and what only looks like it. tests/bad_graphs has each of the warnings.
#include <doctest/doctest.h>

#include <string>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// Without resources that nobody names: of these is unnamed_test.cpp.
std::size_t countOf(const Expanded& expanded) {
  std::size_t count = 0;
  for (const text::Diagnostic& d : expanded.diagnostics.items())
    count += d.code == Code::unusedDeclaration && !d.message.starts_with("the resource") &&
             d.message.find("keeps what") == std::string::npos;
  return count;
}

// A graph of one parameter `p` (a file for an import, else a number) and a `let` q, each named once at `where`.
std::string graphWith(const std::string& let, const std::string& resources, const std::string& pass,
                      const std::string& behind = "") {
  return R"J({ "parameters": { "p": { "default": 1, "min": 0, "max": 4 } }, "let": { )J" + let + R"J( },
  "resources": { "out": { "texture": "rgba8", "size": 8 } )J" +
         resources + R"J( },
  "passes": [ { "name": "fill", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "out" } )J" +
         pass + R"J( } ], "present": "out" )J" + behind + " }";
}

}  // namespace

TEST_CASE("a parameter is read wherever an expression may stand, also where it decides nothing now") {
  CHECK(countOf(expandText(graphWith("", "", ""))) == 1);
  const std::string kRead[][3] = {
      {"", R"J(, "tex": { "texture": "rgba8", "size": "$p" })J", ""},
      {"", R"J(, "tex": { "texture": "rgba8", "size": 8, "mips": "$p" })J", ""},
      {"", R"J(, "tex": { "texture": "rgba8", "size": 8, "clear": "$p" })J", ""},
      {"", R"J(, "tex": { "texture": "rgba8", "size": 8, "history": 1, "first": 0, "reset": ["$p"] })J", ""},
      {"", R"J(, "tex": { "buffer": "$p * 4" })J", ""},
      {"", R"J(, "tex": ["out if $p == 7", "out"])J", ""},
      {"", "", R"J(, "enabled": "$p > 9 || true")J"},
      {"", "", R"J(, "enabled": "true || $p > 9")J"},
      {"", "", R"J(, "parameters": { "gain": "$p" })J"},
      {"", "", R"J(, "defines": { "GAIN": "$p" })J"},
      {"", "", R"J(, "repeat": { "i": [0, "$p - $p"] })J"},
      {"", "", R"J(, "state": { "polygon": "$p > 9 ? line : fill" })J"},
      {"", R"J(, "tex": { "texture": "rgba8", "size": 8, "clear": 0 }, "maybe": ["tex if $p > 8"])J",
       R"J(, "read": { "s": "maybe ?" })J"},
      {R"J("q": "$p")J", "", R"J(, "parameters": { "gain": "$q" })J"},
  };
  for (const auto& [let, resources, pass] : kRead) {
    const Expanded expanded = expandText(graphWith(let, resources, pass));
    INFO(let, resources, pass, expanded.text());
    CHECK(expanded.graph);
    CHECK(countOf(expanded) == 0);
  }
  // What only an unread let reads is one mistake: that of the let.
  const Expanded let = expandText(graphWith(R"J("q": "$p")J", "", ""));
  CHECK(countOf(let) == 1);
  CHECK(let.of(Code::unusedDeclaration).message.find("'q'") != std::string::npos);
}

TEST_CASE("names are read across files, and a file that is included twice says it once") {
  const auto files = [](const std::string& outer, const std::string& inner, const std::string& binding) {
    return expandFiles(
        "expand_unused",
        {{"part.json", R"J({ )J" + inner + R"J( "resources": { "out": { "texture": "rgba8", "size": 8 } },
    "passes": [ { "name": "go", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "out" } )J" +
                           binding + R"J( } ] })J"},
         {"outer.json", R"J({ )J" + outer + R"J( "resources": { "ldr": { "texture": "rgba8", "size": 8 } },
    "passes": [ { "include": "part.json", "as": "one" }, { "include": "part.json", "as": "two" },
      { "name": "show", "type": "fullscreen", "shader": "b.frag.glsl", "read": { "a": "one.out", "b": "two.out" }, "write": { "result": "ldr" } } ],
    "present": "ldr" })J"}});
  };
  const std::string declared = R"J("parameters": { "p": { "default": 1.0 } },)J";
  const std::string reads = R"J(, "parameters": { "gain": "$p" })J";
  CHECK(countOf(files(declared, "", reads)) == 0);  // by the included file
  CHECK(countOf(files("", declared, reads)) == 0);
  CHECK(countOf(files(R"J("let": { "q": "$one.p" }, )J", declared, "")) ==
        1);  // q; both are one declaration of p
  CHECK(countOf(files("", declared, "")) == 1);
  CHECK(countOf(files("", R"J("let": { "q": "2" },)J", "")) == 0);  // for an including file
  // The outer one is hidden by the inner one of the same name.
  const Expanded hidden = files(declared, declared, reads);
  REQUIRE(countOf(hidden) == 1);
  CHECK(hidden.of(Code::unusedDeclaration).place.file->ends_with("outer.json"));
}

TEST_CASE("what lies under an overlay is not judged, what it declares itself is") {
  const TestFolder folder("expand_unused_overlays");
  const std::string base = R"J({ "parameters": { "p": { "default": 1.0 }, "r": { "default": 1.0 } },
  "resources": { "ldr": { "texture": "rgba8", "size": 8 }, "glow": { "texture": "rgba8", "size": 8, "mips": 3 } },
  "passes": [ { "name": "fill", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "glow.mip[0]" }, "parameters": { "gain": "$p" } },
    { "name": "down", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [1, 2] }, "read": { "s": "glow.mip[i-1]" }, "write": { "result": "glow.mip[i]" }, "parameters": { "gain": "$r" } },
    { "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "s": "glow.mip[0]" }, "write": { "result": "ldr" } } ],
  "present": "ldr" })J";
  folder.write("whole.json", base);
  folder.write("less.json",
               R"J({ "extends": "whole.json", "passes": [ { "name": "down", "remove": true } ] })J");
  folder.write("more.json", R"J({ "extends": "less.json", "parameters": { "mine": { "default": 1.0 } } })J");
  const auto count = [&](const std::string& file) {
    text::Diagnostics said;
    const auto desc = readGraph(folder.file(file), said);
    REQUIRE_MESSAGE(desc, said.text());
    Expanded expanded;
    expanded.graph = expandGraph(*desc, testRegistry(), {}, expanded.diagnostics);
    REQUIRE_MESSAGE(expanded.graph, expanded.text());
    return countOf(expanded);
  };
  CHECK(count("less.json") == 0);
  CHECK(count("more.json") == 1);
}
