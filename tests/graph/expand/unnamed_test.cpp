// Resources, histories, alternatives and lists of the scene that nobody names (W089), ranges that count the wrong way (W091), and what
// only looks like it. tests/bad_graphs has each of the warnings.
#include <doctest/doctest.h>

#include <string>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

std::size_t warningsOf(const Expanded& expanded, Code code) {
  std::size_t count = 0;
  for (const text::Diagnostic& d : expanded.diagnostics.items()) count += d.code == code;
  return count;
}

// A graph with one more resource, and more in its pass, and more passes.
std::string graphBeside(const std::string& resource, const std::string& pass, const std::string& passes = "",
                        const std::string& top = "") {
  return R"J({ )J" + top + R"J( "resources": { "out": { "texture": "rgba8", "size": 8 }, )J" + resource +
         R"J( }, "passes": [ )J" + passes +
         R"J( { "name": "fill", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "out" } )J" +
         pass + R"J( } ], "present": "out" })J";
}

}  // namespace

TEST_CASE("a resource is named wherever a reference or a fact may stand, also where it decides nothing now") {
  const std::string kSpare = R"J("spare": { "texture": "rgba8", "size": 8, "clear": 0 })J";
  CHECK(warningsOf(expandText(graphBeside(kSpare, "")), Code::unusedDeclaration) == 1);
  const std::string kNamed[][2] = {
      {kSpare, R"J(, "read": { "s": "spare" })J"},
      {kSpare + R"J(, "maybe": ["spare if 1 > 2"])J", R"J(, "read": { "s": "maybe ?" })J"},
      {kSpare, R"J(, "parameters": { "wide": "size(spare)" })J"},
      {kSpare + R"J(, "list": ["spare", "out"])J", R"J(, "read": { "s": "list" })J"},
      {R"J("camera": { "import": "camera" })J", ""},  // the view of every pass
  };
  for (const auto& [resource, pass] : kNamed) {
    const Expanded expanded = expandText(graphBeside(resource, pass));
    INFO(resource, pass, expanded.text());
    CHECK(expanded.graph);
    CHECK(warningsOf(expanded, Code::unusedDeclaration) == 0);
  }
  const Expanded moving = expandText(graphBeside(R"J("sun_of_mine": { "import": "sun" })J", ""));
  CHECK(warningsOf(moving, Code::unusedDeclaration) == 1);
}

TEST_CASE("what an included file reads counts for the file that binds it, each time it is included") {
  const auto files = [](const std::string& inner, const std::string& bind) {
    return expandFiles(
        "expand_unnamed",
        {{"part.json",
          R"J({ "inputs": ["source"], "resources": { "out": { "texture": "rgba8", "size": 8 } },
    "passes": [ { "name": "go", "type": "fullscreen", "shader": "a.frag.glsl", )J" +
              inner + R"J( "write": { "result": "out" } } ] })J"},
         {"outer.json",
          R"J({ "resources": { "source": { "texture": "rgba8", "size": 8, "clear": 0 }, "other": { "texture": "rgba8", "size": 8, "clear": 0 }, "ldr": { "texture": "rgba8", "size": 8 } },
    "passes": [ { "include": "part.json", "as": "one" }, { "include": "part.json", "as": "two", )J" +
              bind + R"J( },
      { "name": "show", "type": "fullscreen", "shader": "b.frag.glsl", "read": { "a": "one.out", "b": "two.out" }, "write": { "result": "ldr" } } ],
    "present": "ldr" })J"}});
  };
  const std::string reads = R"J("read": { "s": "source" },)J", binds = R"J("bind": { "source": "other" })J";
  CHECK(warningsOf(files(reads, binds), Code::unusedDeclaration) == 0);
  // The input, once; and what takes its name by itself. What is bound by name is named.
  CHECK(warningsOf(files("", binds), Code::unusedDeclaration) == 2);
}

TEST_CASE("an alternative with a condition is told behind one that is always there, and only there") {
  const auto count = [](const std::string& list, const std::string& writer, const std::string& place) {
    const std::string write =
        R"J({ "name": "one", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "a" })J" +
        writer + " },";
    const std::string read =
        R"J({ "name": "early", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "s": "pick" }, "write": { "r": "b" } },)J";
    const Expanded expanded = expandText(graphBeside(
        R"J("a": { "texture": "rgba8", "size": 8, "clear": 0 }, "b": { "texture": "rgba8", "size": 8, "clear": 0 }, "pick": )J" +
            list,
        R"J(, "read": { "s": "pick", "t": "b" })J", place == "behind" ? read + write : write,
        R"J("parameters": { "on": { "default": true } },)J"));
    INFO(expanded.text());
    CHECK(expanded.graph);
    return warningsOf(expanded, Code::unusedDeclaration);
  };
  CHECK(count(R"J(["a", "b if $on"])J", "", "") == 1);
  CHECK(count(R"J(["b if $on", "a"])J", "", "") == 0);
  CHECK(count(R"J(["a if $on", "b if !$on"])J", "", "") == 0);
  CHECK(count(R"J(["a", "b"])J", R"J(, "parameters": { "gain": "$on" })J", "") ==
        0);  // for when `one` is switched off
  CHECK(count(R"J(["a", "b if $on"])J", R"J(, "enabled": "$on")J", "") == 0);
  CHECK(count(R"J(["a", "b if $on"])J", "", "behind") == 0);  // `early` gets b
}

TEST_CASE("things of the scene in a list that no pass draws") {
  const auto said = [](const std::string& list, const std::string& top, const std::string& reads = "") {
    text::Diagnostics diagnostics;
    const std::string text =
        R"J({ )J" + top +
        R"J( "name": "lit", "resources": { "out": { "texture": "rgba8", "size": 8, "clear": 0 } }, "passes": [
    { "name": "p", "type": "draw", "shader": "a", "list": ")J" +
        list + R"J(", "geometry": "quad", )J" + reads +
        R"J( "modify": { "r": "out" } } ], "present": "out" })J";
    const auto desc = readGraphText(text, "lit.json", diagnostics);
    REQUIRE_MESSAGE(desc, diagnostics.text());
    Registry registry = testRegistry();
    registry.things = {{{"transparent_spheres"}, 2}, {{"spheres", "shadow_casters"}, 1}};
    Expanded expanded;
    expanded.graph = expandGraph(*desc, registry, {}, expanded.diagnostics);
    REQUIRE_MESSAGE(expanded.graph, expanded.text());
    return expanded;
  };
  const Expanded lost = said("spheres", "");
  REQUIRE(warningsOf(lost, Code::unusedDeclaration) == 1);
  CHECK(lost.of(Code::unusedDeclaration).message ==
        "the scene has 2 things in the list 'transparent_spheres', which no pass of 'lit' draws");
  CHECK(warningsOf(said("transparent_spheres", ""), Code::unusedDeclaration) ==
        1);  // spheres, shadow_casters
  // What reads the rows of a list may show them in a way of its own.
  CHECK(warningsOf(said("transparent_spheres", "", R"J("read": ["@spheres"],)J"), Code::unusedDeclaration) ==
        0);
}

TEST_CASE("a range that is empty by mistake is told, whatever its bounds are, and no other one") {
  const auto count = [](const std::string& range, const std::string& more = "",
                        const std::string& map = "4") {
    const Expanded expanded = expandText(graphBeside(
        R"J("map": { "texture": "rgba8", "size": 8, "clear": 0, "mips": )J" + map + " }",
        R"J(, "read": { "s": "map.mip[0]?" })J",
        R"J({ "name": "down", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": )J" + range + more +
            R"J(, "modify": { "r": "map.mip[0]" } },)J",
        R"J("parameters": { "n": { "default": 0 }, "high": { "default": 3 }, "on": { "default": false } }, "let": { "top": "mips(map)-1", "two": 2, "all": "$n+$high+($on ? 1 : 0)+$top+$two" },)J"));
    INFO(range, expanded.text());
    CHECK(expanded.graph);
    return warningsOf(expanded, Code::culledUnread);
  };
  CHECK(count(R"J({ "i": [3, 1] })J") == 1);
  CHECK(count(R"J({ "i": ["mips(map)-1", 1] })J") == 1);
  CHECK(count(R"J({ "i": ["$top", 1] })J") == 1);
  CHECK(count(R"J({ "i": ["$high", 2] })J") == 1);
  CHECK(count(R"J({ "i": [1, "mips(map)-1", -1] })J") == 1);
  CHECK(count(R"J({ "i": ["mips(map)-1", 1] })J", "", "3") == 1);  // 2 and 1: not there, and yet so meant
  // An empty list, levels that the size takes away, a parameter that says none, an outer index.
  CHECK(count(R"J({ "i": [1, "mips(map)-1"] })J", "", "1") == 0);
  CHECK(count(R"J({ "i": ["$high", "mips(map)-3"] })J", "", "9") == 0);
  CHECK(count(R"J({ "i": [1, "$n"] })J") == 0);
  CHECK(count(R"J({ "i": [0, "count(@spheres)-101"] })J") == 0);
  CHECK(count(R"J([{ "k": [0, 2] }, { "i": ["k", 1] }])J") == 0);
  CHECK(count(R"J({ "i": [3, 1, -1] })J", R"J(, "parameters": { "all": "$all" })J") == 0);
}
