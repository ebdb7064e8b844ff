// Groups in "passes": what their passes share, and repeats that go through several passes together.
#include <doctest/doctest.h>

#include "engine/graph/edit/edit.h"
#include "engine/text/json/edit.h"
#include "tests/graph/expand/support.h"
#include "tests/graph/test_folder.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// "across" and "along" hand `a` and `b` to each other, after what `group` says; `members` stand behind them.
std::string groupFileWith(const std::string& group, const std::string& members = "") {
  return R"J({ "parameters": { "on": { "default": true }, "fine": { "default": true } },
  "resources": { "a": { "texture": "r8", "size": 8, "clear": 0 }, "b": { "texture": "r8", "size": 8, "clear": 0 } },
  "passes": [
    { "name": "first", "type": "fullscreen", "shader": "f.frag.glsl", "write": { "result": "a" } },
    { )J" +
         group + R"J(, "passes": [
      { "name": "across", "shader": "x.frag.glsl", "read": { "source": "a" }, "write": { "result": "b" } },
      { "name": "along", "shader": "y.frag.glsl", "read": { "source": "b" }, "write": { "result": "a" }, "enabled": "$fine" })J" +
         members + R"J(] },
    { "name": "last", "type": "fullscreen", "shader": "l.frag.glsl", "read": { "source": "a" }, "write": { "result": "b" } }
  ], "present": "b" })J";
}

constexpr const char* kLoop = R"J("repeat": { "l": [0, 1] }, "enabled": "$on", "type": "fullscreen")J";

Expanded overlaid(const TestFolder& folder, const std::string& rest) {
  folder.write("base.json", groupFileWith(kLoop));
  Expanded e;
  const auto desc =
      readGraph(folder.write("over.json", R"J({ "extends": "base.json", )J" + rest + " }"), e.diagnostics);
  REQUIRE_MESSAGE(desc, e.text());
  e.graph = expandGraph(*desc, testRegistry(), {}, e.diagnostics);
  return e;
}

Code errorOf(const std::string& json) {
  text::Diagnostics said;
  const auto desc = readGraphText(json, "test.json", said);
  REQUIRE(said.hasErrors());
  CHECK_MESSAGE(said.errorCount() == 1, said.text());
  return said.items()[0].code;
}

}  // namespace

TEST_CASE("groups: passes repeat together, and each reads what the one before it made") {
  const Expanded e = expandText(groupFileWith(kLoop));
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.names() == "first across[0] along[0] across[1] along[1] last");
  // A repeat of a pass's own runs within that of the group.
  const Expanded inner = expandText(groupFileWith(
      kLoop,
      R"J(, { "name": "more", "shader": "m.frag.glsl", "repeat": { "k": ["l", 1] }, "read": { "source": "a" }, "write": { "result": "a" } })J"));
  REQUIRE_MESSAGE(inner.text() == "", inner.text());
  CHECK(inner.names() == "first across[0] along[0] more[0,0] more[0,1] across[1] along[1] more[1,1] last");
  const Expanded none =
      expandText(groupFileWith(R"J("repeat": { "l": [0, "$on ? -1 : 0"] }, "type": "fullscreen")J"));
  CHECK(none.names() == "first last");
}

TEST_CASE("groups: a pass needs the condition of its group and its own") {
  const auto names = [](std::vector<Setting> sets) {
    return expandText(groupFileWith(kLoop), with(std::move(sets))).names();
  };
  CHECK(names({{"fine", "false"}}) == "first across[0] across[1] last");
  CHECK(names({{"on", "false"}}) == "first last");
  const Expanded off = expandText(groupFileWith(kLoop), with({{"on", "false"}}));
  REQUIRE(off.graph->disabled.size() == 4);
  CHECK(off.graph->disabled[1].why == "enabled: $on && $fine is false");
}

TEST_CASE("groups: their passes have their keys as those of a set") {
  const Expanded e = expandText(R"J({
    "resources": { "a": { "texture": "r8", "size": 8, "mips": 4, "clear": 0 } },
    "sets": { "one": { "defines": { "X": 1 } }, "two": { "defines": { "Y": 2 } } },
    "passes": [ { "type": "fullscreen", "use": "one", "parameters": [{ "turn": 3 }], "update": "on_change", "passes": [
      { "name": "p", "shader": "p.frag.glsl", "parameters": { "own": 4 }, "write": { "result": "a.mip[0]" } },
      { "name": "q", "shader": "q.frag.glsl", "use": ["two"], "read": { "source": "a.mip[0]" }, "write": { "result": "a.mip[1]" } }
    ] } ], "present": "a.mip[0..]" })J");
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.uniform("p", "turn").value == Value::number(3));
  CHECK(e.uniform("p", "own").value == Value::number(4));
  CHECK(e.define("q", "X") == "1");
  CHECK(e.define("q", "Y") == "2");
  CHECK(e.graph->passes[1].cadence == Cadence::on_change);
}

TEST_CASE("groups: overlays change, move, remove and add passes by their names") {
  const TestFolder folder("groups_test_files");
  const auto names = [&](const std::string& passes) {
    const Expanded e = overlaid(folder, R"("passes": [)" + passes + "]");
    REQUIRE_MESSAGE(e.graph, e.text());
    return e.names();
  };
  CHECK(names(R"({ "name": "along", "enabled": false })") == "first across[0] across[1] last");
  CHECK(names(R"({ "name": "across", "remove": true })") == "first along[0] along[1] last");
  // Behind the others it repeats by itself.
  CHECK(names(R"({ "name": "along", "after": "last" })") ==
        "first across[0] across[1] last along[0] along[1]");
  const std::string added =
      R"("name": "new", "type": "fullscreen", "shader": "n.frag.glsl", "read": { "source": "b" }, "write": { "result": "b" })";
  CHECK(names(R"({ "after": "across", )" + added + " }") ==
        "first across[0] new[0] along[0] across[1] new[1] along[1] last");
  CHECK(names(R"({ "after": "along", )" + added + " }") ==
        "first across[0] along[0] across[1] along[1] new last");
  CHECK(
      names(
          R"({ "after": "first", "type": "fullscreen", "read": { "source": "a" }, "write": { "result": "a" }, "passes": [
          { "name": "one", "shader": "1.frag.glsl" }, { "name": "two", "shader": "2.frag.glsl" } ] })") ==
      "first one two across[0] along[0] across[1] along[1] last");
  // What the group gives a pass is changed for that pass alone.
  const Expanded slow = overlaid(
      folder,
      R"("passes": [{ "name": "along", "type": "draw", "list": "spheres", "geometry": "quad", "shader": "balls/flat" }])");
  CHECK(slow.spec("along[1]").type == "draw");
  CHECK(slow.spec("across[1]").type == "fullscreen");
  CHECK(slow.names() == "first across[0] along[0] across[1] along[1] last");
  const Expanded between =
      overlaid(folder, R"("passes": [{ "after": "last", "repeat": { "k": [0, 1] }, "passes": [{ )" + added +
                           R"( }] }, { "name": "new", "after": "across" }])");
  CHECK(between.has(Code::passWithoutPlace));
}

TEST_CASE("groups: a pass that is disabled is written at its own stanza") {
  const TestFolder folder("groups_test_files");
  text::Diagnostics diagnostics;
  const auto desc = readGraph(folder.write("graph.json", groupFileWith(kLoop)), diagnostics);
  REQUIRE(desc);
  const auto plan = planWriteBack(*desc, {}, testRegistry(), with({}, {"across", "along"}), diagnostics);
  REQUIRE_MESSAGE(plan, diagnostics.text());
  const std::string& after = plan->files.at(0).after;
  CHECK(after.find(R"("shader": "x.frag.glsl", "enabled": false)") != std::string::npos);
  CHECK(after.find(R"("enabled": "$fine && false")") != std::string::npos);
}

TEST_CASE("groups: mistakes are told once, where they stand") {
  CHECK(errorOf(groupFileWith(R"("enabeld": "$on", "type": "fullscreen")")) == Code::unknownKey);
  CHECK(errorOf(groupFileWith(R"("lots": 3, "type": "fullscreen")")) == Code::unknownKey);
  CHECK(errorOf(groupFileWith(R"("name": "both", "type": "fullscreen")")) == Code::unknownKey);
  CHECK(errorOf(groupFileWith(R"("enabled": "$on &&", "type": "fullscreen")")) == Code::badExpression);
  CHECK(errorOf(groupFileWith(R"("repeat": { "l": 3 }, "type": "fullscreen")")) == Code::wrongType);
  CHECK(errorOf(groupFileWith(R"("repeat": { "l": [0, 1, 2, 3] }, "type": "fullscreen")")) ==
        Code::wrongType);
  CHECK(errorOf(R"({ "passes": [ { "enabled": true, "passes": 3 } ] })") == Code::wrongType);
  CHECK(errorOf(groupFileWith(kLoop, R"(, { "enabled": true, "passes": [] })")) == Code::keysExclude);
}

TEST_CASE("groups: their passes stand below their other keys") {
  const std::string laid = R"J({
  "passes": [
    { "enabled": "$on", "type": "fullscreen", "passes": [
      { "name": "across", "shader": "x.frag.glsl",
        "read": { "source": "a_name_that_is_long_so_that_lines_break" }, "write": { "result": "b_name_that_is_long" } },
      // Of the second.
      { "name": "along", "shader": "y.frag.glsl", "read": { "source": "b" }, "write": { "result": "a" } }] },
    { "include": "other.json" }
  ]
}
)J";
  CHECK(text::layoutJson(laid) == laid);
}
