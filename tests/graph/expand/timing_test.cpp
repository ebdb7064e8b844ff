// Where age() may stand. Earlier publications in lists of alternatives.
#include <doctest/doctest.h>

#include "engine/graph/compile/compile.h"
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// `pulse` is published now and then; `late` and `other` are what the tests' passes may use.
Expanded tryPasses(const std::string& passes, const Settings& settings = {}) {
  return expandText(R"J({
  "parameters": { "seconds": { "default": 0.5 } },
  "let": { "young": "age(pulse) < $seconds" },
  "resources": {
    "pulse": { "texture": "rgba16f", "size": 4, "history": 1 },
    "out":   { "texture": "rgba16f", "size": 4 },
    "late":  { "texture": "rgba16f", "size": 4 },
    "other": { "texture": "rgba16f", "size": 4, "mips": 2 },
    "base":  { "texture": "rgba16f", "size": 4, "clear": 0 },
    "past":  { "texture": "rgba16f", "size": 4, "history": 1 },
    "old":   "pulse@-1"
  },
  "passes": [
    { "name": "pulse", "type": "fullscreen", "shader": "a.frag.glsl", "update": "once", "write": { "r": "pulse" } },
    { "name": "draw", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "p": "pulse" }, "write": { "r": "out" } },
)J" + passes + R"J( ], "present": "out" })J",
                    settings);
}

std::string stanza(const std::string& name, const std::string& rest, const std::string& enabled = "$young") {
  return R"({ "name": ")" + name + R"(", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": ")" +
         enabled + "\", " + rest + " }";
}

std::string messageOf(const Expanded& e, Code code) {
  return e.of(code).message;
}

}  // namespace

TEST_CASE("the number of instances of a draw may contain age(), in passes that run in every frame") {
  const auto draw = [](const std::string& rest) {
    return tryPasses(
        R"({ "name": "mix", "type": "draw", "shader": "a", "geometry": "quad", "instances": "$young", )" +
        rest + R"("read": { "p": "old" }, "modify": { "r": "out" } })");
  };
  const Expanded e = draw("");
  REQUIRE_MESSAGE(e.text() == "", e.text());
  const Expr& timed = e.spec("mix").timedInstances;
  REQUIRE(timed.present());
  CHECK(timed.evaluateFolded([](std::uint32_t) { return 0.25; }).v[0] == 1);
  CHECK(timed.evaluateFolded([](std::uint32_t) { return 0.75; }).v[0] == 0);
  CHECK_FALSE(e.spec("draw").timedInstances.present());
  CHECK(e.graph->parameters[0].structural);
  CHECK(messageOf(draw(R"("update": "on_change", )"), Code::badTime) ==
        "pass 'mix' sees time in \"instances\", but does not run in every frame");
}

TEST_CASE("what chooses passes and shader variants cannot contain age()") {
  CHECK(messageOf(tryPasses(stanza("mix", R"("modify": { "r": "out" })")), Code::badTime)
            .starts_with("'$young' contains"));
  CHECK(tryPasses(stanza("mix", R"("modify": { "r": "out" }, "defines": { "Y": "age(pulse) < 1" })", "true"))
            .text()
            .find("age(pulse) is not known before the frame runs") != std::string::npos);
}

TEST_CASE("alternatives: an earlier publication has a name of its own") {
  const Expanded e = tryPasses(stanza(
      "show",
      R"("read": { "a": "old", "b": "pulse" }, "modify": { "r": "out" }, "parameters": { "young": "$young" })",
      "true"));
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.useText("show", "a") == "pulse @-1");
  CHECK(e.useText("show", "b") == "pulse");
  // Each step back counts.
  CHECK(messageOf(tryPasses(stanza("show", R"("read": { "a": "old@-1" }, "modify": { "r": "out" })", "true")),
                  Code::noHistory) == "pass 'show' reads 'old@-1', further back than 'pulse' remembers");
}

namespace {

Expanded orderedBy(const std::string& first, const std::string& second, const std::string& third) {
  const auto pass = [](const char* name, const std::string& place) {
    return R"J({ "name": ")J" + std::string(name) +
           R"J(", "type": "fullscreen", "shader": "a.frag.glsl", )J" + place +
           R"J( "repeat": { "i": [0, 1] }, "write": { "r": ")J" + name +
           R"J(.mip[i]" }, "side_effect": true })J";
  };
  return expandText(R"J({ "resources": {
    "a": { "texture": "r8", "size": 8, "mips": 2 }, "b": { "texture": "r8", "size": 8, "mips": 2 },
    "c": { "texture": "r8", "size": 8, "mips": 2 } }, "passes": [ )J" +
                    pass("a", first) + ", " + pass("b", second) + ", " + pass("c", third) + " ] }");
}

}  // namespace

TEST_CASE("before and after place a stanza in its own file") {
  CHECK(orderedBy("", "", "").names() == "a[0] a[1] b[0] b[1] c[0] c[1]");
  CHECK(orderedBy(R"("after": "b",)", "", "").names() == "b[0] b[1] a[0] a[1] c[0] c[1]");
  CHECK(orderedBy(R"("after": "b",)", R"("after": "c",)", "").names() == "c[0] c[1] b[0] b[1] a[0] a[1]");
  CHECK(orderedBy("", "", R"("before": "a",)").names() == "c[0] c[1] a[0] a[1] b[0] b[1]");
}

TEST_CASE("places that cannot be") {
  CHECK(orderedBy(R"("after": "b",)", R"("after": "a",)", "").has(Code::passCycle));
  CHECK(orderedBy(R"("after": "a",)", "", "").has(Code::passCycle));
  CHECK(orderedBy(R"("after": "bb",)", "", "").has(Code::passWithoutPlace));
  CHECK(orderedBy(R"("after": "b", "before": "c",)", "", "").has(Code::keysExclude));
}
