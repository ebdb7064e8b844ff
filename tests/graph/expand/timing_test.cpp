// Passes that `enabled` with age() lets run in some frames only: what they may make and change, and who may use it.
// Earlier publications in lists of alternatives.
#include <doctest/doctest.h>

#include <fstream>

#include "engine/graph/compile/compile.h"
#include "engine/graph/print/text.h"
#include "tests/graph/expand/support.h"
#include "tests/graph/test_folder.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using base::Code;

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

TEST_CASE("timed: passes of one condition pass on what they make, and modify what is always there") {
  const Expanded e = tryPasses(stanza("make", R"("read": { "p": "old" }, "write": { "r": "late" })") + ", " +
                               stanza("mix", R"("read": { "a": "late" }, "modify": { "r": "out" })"));
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.names() == "pulse draw make mix");
  CHECK(e.useText("make", "p") == "pulse @-1");
  CHECK(e.spec("make").runsWhile == "$young");
  CHECK(e.spec("draw").runsWhile == "");
  for (const char* pass : {"make", "mix"}) {
    const UniformSpec& condition = e.spec(pass).uniforms.at(0);
    CHECK(condition.role == UniformSpec::Role::enabled);
    CHECK(condition.name == "");
    const auto aged = [](double age) { return [age](std::uint32_t) { return age; }; };
    CHECK(condition.dynamic.evaluateFolded(aged(0.25)).truth());
    CHECK_FALSE(condition.dynamic.evaluateFolded(aged(0.75)).truth());
  }
  CHECK(e.graph->parameters[0].structural);
  CHECK(dumpText(compile(e.graph)).find("make while $young\n") != std::string::npos);
  // Disabled for good all the same.
  CHECK(tryPasses(stanza("mix", R"("modify": { "r": "out" })"), with({}, {"mix"})).names() == "pulse draw");
}

TEST_CASE("timed: who else uses what is made only at times is reported") {
  const std::string make = stanza("make", R"("write": { "r": "late" })");
  const auto use = [&](const std::string& pass) {
    return messageOf(tryPasses(make + ", " + pass), Code::madeAtTimes);
  };
  const std::string read = R"("read": { "a": "late" }, "modify": { "r": "out" })";
  CHECK(use(stanza("show", read, "true")) == "pass 'show' reads 'late', which is made only at times");
  const Expanded shows = tryPasses(make + ", " + stanza("show", read, "true"));
  CHECK(shows.of(Code::madeAtTimes).found == "'late' is made while $young");
  CHECK(shows.of(Code::madeAtTimes).pass == "show");
  CHECK(use(stanza("show", read, "age(pulse) < 1")) ==
        "pass 'show' reads 'late', which is made only at times");
  CHECK(use(stanza("show", R"("read": { "a": "late?" }, "modify": { "r": "out" })", "true")) ==
        "pass 'show' reads 'late?', which is made only at times");
  CHECK(use(stanza("show", R"("modify": { "r": "late" })", "true")) ==
        "pass 'show' modifies 'late', which is made only at times");
  CHECK(use(stanza("show", R"("write": { "r": "late" })", "true")) ==
        "pass 'show' writes 'late', which other passes make only at times");
  const auto alone = [&](const std::string& rest) {
    return messageOf(tryPasses(stanza("make", rest)), Code::madeAtTimes);
  };
  CHECK(alone(R"("write": { "r": "out" })") == "pass 'make' writes 'out', which is there at all times");
  CHECK(alone(R"("read": { "a": "out" }, "write": { "r": "out" })") ==
        "pass 'make' writes 'out', which is there at all times");
  CHECK(alone(R"("write": { "r": "past" })") ==
        "pass 'make' writes 'past', which keeps a history, but only at times");
  // A clear goes with the first pass that touches a level, so a timed pass must not be the first.
  CHECK(messageOf(tryPasses(stanza("first", R"("modify": { "r": "base" })") + ", " +
                            stanza("then", R"("modify": { "r": "base" })", "true") + ", " +
                            stanza("show", R"("read": { "a": "base" }, "modify": { "r": "out" })", "true")),
                  Code::madeAtTimes) == "pass 'then' modifies 'base', which is made only at times");
  CHECK(messageOf(tryPasses(stanza("first", R"("write": { "r": "other.mip[0]" })", "true") + ", " +
                            stanza("then", R"("write": { "r": "other.mip[1]" })")),
                  Code::madeAtTimes) == "pass 'then' writes 'other.mip[1]', which is there at all times");
  Expanded shown = expandText(
      R"J({ "resources": { "pulse": { "texture": "rgba16f", "size": 4 }, "late": { "texture": "rgba16f", "size": 4 } },
    "passes": [ { "name": "pulse", "type": "fullscreen", "shader": "a.frag.glsl", "update": "once", "write": { "r": "pulse" } },
                { "name": "make", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": "age(pulse) < 1", "read": { "p": "pulse" }, "write": { "r": "late" } } ],
    "present": "late" })J");
  CHECK(shown.has(Code::madeAtTimes));
}

TEST_CASE("timed: only what runs in every frame otherwise, under one condition, the same for all repeats") {
  const auto time = [&](const std::string& pass) { return messageOf(tryPasses(pass), Code::badTime); };
  CHECK(time(stanza("slow", R"("update": "on_change", "write": { "r": "late" })")) ==
        "pass 'slow' is enabled by age(), but does not run in every frame");
  CHECK(time(stanza("many", R"("repeat": { "i": [0, 1] }, "modify": { "r": "out" })", "age(pulse) < i")) ==
        "pass 'many' has an \"enabled\" with age() that depends on the index 'i'");
  // A name that only holds the index does not depend on it.
  CHECK(tryPasses(
            stanza(
                "many",
                R"("repeat": { "s": [0, 0] }, "modify": { "r": "out" }, "parameters": { "young": "$young" })",
                "age(pulse) < $seconds"))
            .text() == "");
  const Expanded repeated = tryPasses(
      stanza("many", R"("repeat": { "i": [0, 1] }, "write": { "r": "other.mip[i]" })") + ", " +
      stanza("mix", R"("read": { "a": "other.mip[1]", "b": "other.mip[0]" }, "modify": { "r": "out" })"));
  CHECK_MESSAGE(repeated.text() == "", repeated.text());
}

TEST_CASE("timed: an include, and all that is in it") {
  const TestFolder folder("timing_test_files");
  folder.write(
      "inner.json",
      R"J({ "resources": { "in": { "input": "texture" }, "out": { "input": "texture" }, "own": { "texture": "rgba16f", "size": 4 } },
    "passes": [ { "name": "a", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "i": "in" }, "write": { "r": "own" } },
                { "name": "b", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": "$two", "read": { "i": "own" }, "modify": { "r": "out" } } ] })J");
  folder.write("timed.json",
               R"J({ "resources": { "in": { "input": "texture" }, "out": { "input": "texture" } },
    "passes": [ { "include": "inner.json", "enabled": "age(in) < 2" } ] })J");
  const auto top = [&](const std::string& include, const Settings& settings = {}) {
    const std::string path = folder.write("top.json", R"J({ "parameters": { "two": { "default": true } },
      "resources": { "in": { "texture": "rgba16f", "size": 4 }, "out": { "texture": "rgba16f", "size": 4 } },
      "passes": [ { "name": "pulse", "type": "fullscreen", "shader": "a.frag.glsl", "update": "once", "write": { "r": "in" } },
                  { "name": "draw", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "out" } }, )J" +
                                                          include + R"J( ], "present": "out" })J");
    Expanded e;
    const auto desc = readGraph(path, e.diagnostics);
    REQUIRE_MESSAGE(desc, e.text());
    e.graph = expandGraph(*desc, testRegistry(), settings, e.diagnostics);
    return e;
  };
  const Expanded e = top(R"({ "include": "inner.json", "enabled": "age(in) < 1" })");
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.spec("inner.a").runsWhile == "age(in) < 1");
  CHECK(e.spec("inner.b").runsWhile == "age(in) < 1");
  CHECK(top(R"({ "include": "inner.json", "enabled": "age(in) < 1" })", with({{"two", "false"}})).names() ==
        "pulse draw inner.a");
  CHECK(top(R"({ "include": "timed.json" })").spec("timed.inner.a").runsWhile == "age(in) < 2");
  CHECK(messageOf(top(R"({ "include": "timed.json", "enabled": "age(in) < 1" })"), Code::badTime) ==
        "include 'timed.inner' has an \"enabled\" with age() inside an include that has one");
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
