// Versions, renames, history, alternatives, conditions, optional slots.
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// A graph with the resources and passes given, and common pieces to shorten tests.
std::string graphOf(const std::string& resources, const std::string& passes,
                    const std::string& rest = R"J("present": "out")J") {
  return R"J({ "resources": { "out": { "texture": "rgba8", "size": "screen" })J" +
         (resources.empty() ? "" : ", " + resources) + R"J( }, "passes": [)J" + passes + "], " + rest + "}";
}
std::string fullscreen(const std::string& name, const std::string& rest) {
  return R"J({ "name": ")J" + name + R"J(", "type": "fullscreen", "shader": "a.frag.glsl", )J" + rest + "}";
}
const std::string kA = R"J("a": { "texture": "rgba16f", "size": "screen" })J";

}  // namespace

TEST_CASE("a chain of reads and writes of one whole resource renames it") {
  const std::string text = graphOf(
      kA, fullscreen("first", R"J("write": { "result": "a" })J") + "," +
              fullscreen("second", R"J("read": { "source": "a" }, "write": { "result": "a" })J") + "," +
              fullscreen("third", R"J("write": { "result": "a" }, "read": { "source": "a" })J") + "," +
              fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J"));
  const Expanded all = expandText(text);
  CHECK(all.text() == "");
  CHECK(all.useText("first", "result") == "a");
  CHECK(all.useText("second", "source") == "a");
  CHECK(all.useText("second", "result") == "a#2");
  CHECK(all.useText("third", "source") == "a#2");
  CHECK(all.useText("third", "result") == "a#3");
  CHECK(all.useText("last", "source") == "a#3");
  const Expanded less = expandText(text, with({}, {"second"}));
  CHECK(less.names() == "first third last");
  CHECK(less.useText("third", "source") == "a");
  CHECK(less.useText("third", "result") == "a#2");
  REQUIRE(less.graph->disabled.size() == 1);
  CHECK(less.graph->disabled[0].why == "--disable second");
}

TEST_CASE("modify and partial writes stay where they are") {
  const Expanded e = expandText(graphOf(
      R"J("a": { "texture": "rgba16f", "size": [8, 8], "mips": 3, "clear": [0, 0, 0, 0] })J",
      fullscreen("one", R"J("write": { "result": "a.mip[0]" })J") + "," +
          fullscreen("two", R"J("read": { "source": "a.mip[0]" }, "write": { "result": "a.mip[1..]" })J")
              .replace(0, 0, "") +
          "," + fullscreen("three", R"J("modify": { "result": "a.mip[0]" })J") + "," +
          fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J")));
  // an attachment is one level
  CHECK(e.of(Code::attachmentsDiffer).pass == "two");
  const Expanded good = expandText(graphOf(
      R"J("a": { "texture": "rgba16f", "size": [8, 8], "mips": 2 })J",
      fullscreen("one", R"J("write": { "result": "a.mip[0]" })J") + "," +
          fullscreen("two", R"J("read": { "source": "a.mip[0]" }, "write": { "result": "a.mip[1]" })J") +
          "," + fullscreen("three", R"J("modify": { "result": "a.mip[0]" })J") + "," +
          fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J")));
  CHECK(good.text() == "");
  CHECK(good.useText("two", "result") == "a mip 1");
  CHECK(good.useText("three", "result") == "a mip 0");
  CHECK(good.useText("last", "source") == "a");
  CHECK(good.resource("a").mips == 2);
}

TEST_CASE("a whole write after a clear that nobody used needs no rename, after a used one it does") {
  const std::string cleared = R"J("a": { "texture": "rgba16f", "size": "screen", "clear": 0 })J";
  const Expanded fresh = expandText(graphOf(
      cleared, fullscreen("one", R"J("write": { "result": "a" })J") + "," +
                   fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J")));
  CHECK(fresh.useText("one", "result") == "a");
  const Expanded used = expandText(graphOf(
      cleared,
      fullscreen("zero", R"J("read": { "source": "a" }, "write": { "result": "out" })J") + "," +
          fullscreen("one", R"J("write": { "result": "a" })J") + "," +
          fullscreen("last", R"J("read": { "source": "a", "old": "out" }, "write": { "result": "out" })J")));
  CHECK(used.of(Code::readBeforeWrite).message ==
        "pass 'zero' reads 'a' before pass 'one' writes it: its slot 'source' has only what \"clear\" says");
  CHECK(used.useText("zero", "source") == "a");
  CHECK(used.useText("one", "result") == "a#2");
  CHECK(used.resource("a").hasClear);
  CHECK_FALSE(used.resource("a#2").hasClear);
  REQUIRE(used.graph->clears.size() == 1);
}

TEST_CASE("the question mark ignores version zero, a plain read takes it") {
  const Expanded e = expandText(graphOf(
      R"J("a": { "texture": "rgba16f", "size": "screen", "clear": 0 })J",
      fullscreen("last", R"J("read": { "plain": "a", "maybe": "a?" }, "write": { "result": "out" })J")));
  CHECK(e.useText("last", "plain") == "a");
  CHECK(e.useText("last", "maybe") == "-");
  CHECK(e.slot("last", "maybe").optional);
}

TEST_CASE("elements of an array are resources of their own") {
  const Expanded e = expandText(graphOf(
      R"J("sh": { "texture": "rgba16f", "size": [4, 4, 4], "array": 3 })J",
      R"J({ "name": "bake", "type": "compute", "shader": "a.comp.glsl", "write": { "sh": "sh" } },
                                           { "name": "again", "type": "compute", "shader": "a.comp.glsl", "write": { "sh": "sh[1]" } },)J" +
          fullscreen("last",
                     R"J("read": { "sh": "sh as linear", "one": "sh[1]" }, "write": { "result": "out" })J")));
  CHECK(e.text() == "");
  CHECK(e.slot("bake", "sh").useCount == 3);
  CHECK(e.slot("bake", "sh").array);
  CHECK(e.useText("again", "sh") == "sh[1]#2");
  CHECK(e.useText("last", "sh", 0) == "sh[0]");
  CHECK(e.useText("last", "sh", 1) == "sh[1]#2");
  CHECK(e.useText("last", "one") == "sh[1]#2");
  CHECK_FALSE(e.slot("last", "one").array);
  CHECK(e.slot("last", "sh").sampler.linear);
  CHECK(e.spec("bake").threads[2] == 4);
}

TEST_CASE("history refers to the last version, and only that one has it") {
  const Expanded e = expandText(graphOf(
      R"J("a": { "texture": "rgba16f", "size": "screen", "history": 2, "first": [1, 0, 0, 1], "reset": ["@cut", "size(a)", "b"] }, "b": { "texture": "rgba16f", "size": "screen" })J",
      fullscreen("one", R"J("read": { "old": "a@-2" }, "write": { "result": "a", "other": "b" })J") + "," +
          fullscreen("two", R"J("read": { "source": "a", "other": "b" }, "write": { "result": "a" })J") +
          "," +
          fullscreen("last",
                     R"J("read": { "source": "a", "before": "a@-1" }, "write": { "result": "out" })J")));
  CHECK(e.text() == "");
  CHECK(e.useText("one", "old") == "a#2 @-2");
  CHECK(e.useText("last", "before") == "a#2 @-1");
  CHECK(e.resource("a").history == 0);
  CHECK(e.resource("a#2").history == 2);
  REQUIRE(e.graph->histories.size() == 1);
  const HistorySpec& history = e.graph->histories[0];
  CHECK(e.graph->resourceNames[history.resource] == "a#2");
  CHECK(toText(history.first) == "[1, 0, 0, 1]");
  REQUIRE(history.resetImports.size() == 1);
  CHECK(e.graph->imports[history.resetImports[0]].request.type == "cut");
  REQUIRE(history.resetResources.size() == 1);
  CHECK(e.graph->resourceNames[history.resetResources[0]] == "b");
  REQUIRE(history.resetValues.size() == 1);
  CHECK(toText(history.resetValues[0]) == "[1280, 720]");
}

TEST_CASE("alternatives: the first whose condition holds and which has a version") {
  const std::string resources =
      R"J("a": { "texture": "rgba16f", "size": "screen" }, "b": { "texture": "rgba16f", "size": "screen" }, "pick": ["a if $first", "b"])J";
  const std::string passes =
      fullscreen("make_a", R"J("write": { "result": "a" })J") + "," +
      fullscreen("make_b", R"J("write": { "result": "b" })J") + "," +
      fullscreen("last", R"J("read": { "source": "pick as linear" }, "write": { "result": "out" })J");
  const std::string rest = R"J("parameters": { "first": { "default": true } }, "present": "out")J";
  const std::string text = graphOf(resources, passes, rest);
  CHECK(expandText(text).useText("last", "source") == "a");
  CHECK(expandText(text, with({{"first", "false"}})).useText("last", "source") == "b");
  CHECK(expandText(text, with({}, {"make_a"})).useText("last", "source") == "b");
  const Expanded none = expandText(text, with({{"first", "false"}}, {"make_b"}));
  CHECK_FALSE(none.graph);
  CHECK(none.of(Code::disabledWriter).message.find("'make_b'") != std::string::npos);
  CHECK(expandText(text).text() == "");
  CHECK(expandText(text, with({{"first", "false"}})).text() == "");
}

TEST_CASE("alternatives of an import that may be missing, with a part of another") {
  const std::string text = graphOf(
      R"J("sky": { "texture": "rgba16f", "size": [64, 32], "mips": 2 }, "env": ["@environment", "sky.mip[1]"])J",
      fullscreen("daylight", R"J("write": { "result": "sky.mip[1]" }, "update": "on_change")J") + "," +
          R"J({ "name": "sum", "type": "compute", "shader": "a.comp.glsl", "threads": "[1, size(env).y]", "read": { "env": "env as linear wrap" }, "write": { "result": "out" } })J");
  CHECK(expandText(text).useText("sum", "env") == "@environment");
  CHECK(expandText(text).spec("sum").threads[1] == 1024);
  const Expanded e = expandText(text, {}, testRegistry({.environment = false}));
  CHECK(e.useText("sum", "env") == "sky mip 1");
  CHECK(e.spec("sum").threads[1] == 16);
  CHECK(e.slot("sum", "env").sampler.wrap == Wrap::repeat);
}

TEST_CASE("a false condition disconnects an optional slot and starves a plain one") {
  const auto text = [](const char* ref) {
    return graphOf(kA + R"J(, "maybe": ["a if $on"])J",
                   fullscreen("one", R"J("write": { "result": "a" })J") + "," +
                       fullscreen("last", std::string(R"J("read": { "source": ")J") + ref +
                                              R"J(" }, "write": { "result": "out" })J"),
                   R"J("parameters": { "on": { "default": false } }, "present": "out")J");
  };
  CHECK(expandText(text("maybe ?")).useText("last", "source") == "-");
  CHECK(expandText(text("maybe ?")).text() == "");  // 'one' is culled on purpose
  CHECK(expandText(text("maybe ?"), with({{"on", "true"}})).useText("last", "source") == "a");
  CHECK(expandText(text("maybe")).of(Code::conditionLeavesSlotEmpty).pass == "last");
}

TEST_CASE("read before write, self-reading, cycles and reads of nothing are told apart") {
  const std::string two = kA + R"J(, "b": { "texture": "rgba16f", "size": "screen" })J";
  const Expanded before = expandText(
      graphOf(kA, fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J") + "," +
                      fullscreen("late", R"J("write": { "result": "a" })J")));
  CHECK(before.of(Code::readBeforeWrite).message == "pass 'last' reads 'a' before pass 'late' writes it");
  CHECK(before.of(Code::readBeforeWrite).hint.find("@-1") != std::string::npos);
  const Expanded self = expandText(graphOf(
      kA, fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out", "kept": "a" })J")));
  CHECK(self.of(Code::readBeforeWrite).hint.find("a@-1") != std::string::npos);
  const Expanded nobody = expandText(
      graphOf(kA, fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J")));
  CHECK(nobody.of(Code::nobodyWrites).resource == "a");
  const Expanded cycle = expandText(
      graphOf(two + R"J(, "c": { "texture": "rgba16f", "size": "screen" })J",
              fullscreen("one", R"J("read": { "source": "c" }, "write": { "result": "a" })J") + "," +
                  fullscreen("two", R"J("read": { "source": "a" }, "write": { "result": "b" })J") + "," +
                  fullscreen("three", R"J("read": { "source": "b" }, "write": { "result": "c" })J") + "," +
                  fullscreen("last", R"J("read": { "source": "c" }, "write": { "result": "out" })J")));
  CHECK(
      cycle.of(Code::passCycle).message.ends_with("passes wait for each other: one -> two -> three -> one"));
  const Expanded modify = expandText(
      graphOf(kA, fullscreen("one", R"J("modify": { "result": "a" })J") + "," +
                      fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J")));
  CHECK(modify.of(Code::readBeforeWrite).hint.find("clear") != std::string::npos);
}

TEST_CASE("what is an error in a live pass is a warning in a culled one") {
  const Expanded e = expandText(
      graphOf(kA + R"J(, "b": { "texture": "rgba16f", "size": "screen" }, "maybe": ["b if false"])J",
              fullscreen("idle", R"J("read": { "source": "a" }, "write": { "result": "b" })J") + "," +
                  fullscreen("last", R"J("read": ["maybe ?"], "write": { "result": "out" })J")));
  CHECK(e.graph);
  CHECK(e.of(Code::nobodyWrites).severity == text::Severity::warning);
  CHECK(e.diagnostics.size() == 1);
}

TEST_CASE("a whole read needs every sub-resource") {
  const Expanded e = expandText(graphOf(
      R"J("a": { "texture": "rgba16f", "size": [8, 8], "mips": 3 })J",
      R"J({ "name": "one", "type": "compute", "shader": "a.comp.glsl", "write": { "result": "a.mip[0]" } },)J" +
          fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J")));
  CHECK(e.of(Code::nobodyWrites).message == "pass 'last' reads mip 1 of 'a', which no pass writes");
}

TEST_CASE("a disabled writer is named with the ways out") {
  const std::string text =
      graphOf(kA,
              fullscreen("one", R"J("write": { "result": "a" }, "enabled": "$on")J") + "," +
                  fullscreen("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J"),
              R"J("parameters": { "on": { "default": true } }, "present": "out")J");
  CHECK(expandText(text).text() == "");
  const Expanded off = expandText(text, with({{"on", "false"}}));
  CHECK(off.of(Code::disabledWriter).message ==
        "pass 'last' reads 'a', but pass 'one' that would write it is disabled (enabled: $on is false)");
  for (const char* fix : {"enable 'one'", "'?'", "alternatives", "\"clear\""})
    CHECK_MESSAGE(off.of(Code::disabledWriter).hint.find(fix) != std::string::npos, fix);
  CHECK(off.of(Code::disabledWriter).hint.find("disable 'last'") ==
        std::string::npos);  // nothing would be shown
  const Expanded gone = expandText(text, with({}, {"last"}));
  CHECK(gone.of(Code::disabledWriter).message.find("present shows 'out', but pass 'last'") == 0);
}

TEST_CASE("passes culled by mistake are warned of, passes culled on purpose are not") {
  const Expanded over = expandText(graphOf("", fullscreen("one", R"J("write": { "result": "out" })J") + "," +
                                                   fullscreen("two", R"J("write": { "result": "out" })J")));
  CHECK(over.graph);
  CHECK(over.of(Code::culledOverwritten).message ==
        "pass 'one' is culled: 'two' overwrites 'out' before anybody reads it");
  CHECK(over.diagnostics.size() == 1);
  const Expanded unread = expandText(graphOf(kA, fullscreen("one", R"J("write": { "result": "a" })J") + "," +
                                                     fullscreen("two", R"J("write": { "result": "out" })J")));
  CHECK(unread.of(Code::culledUnread).pass == "one");
  const Expanded nothing =
      expandText(graphOf("", fullscreen("two", R"J("write": { "result": "out" })J"), R"J("name": "x")J"));
  CHECK(nothing.graph);
  CHECK(nothing.of(Code::nothingPresented).severity == text::Severity::warning);
  const Expanded effect = expandText(graphOf(
      "", fullscreen("two", R"J("write": { "result": "out" }, "side_effect": true)J"), R"J("name": "x")J"));
  CHECK(effect.text() == "");
}

TEST_CASE("a level that the clamp took away leaves the pass out") {
  const std::string text = graphOf(
      R"J("glow": { "texture": "rgba16f", "size": "screen/2", "mips": 6 })J",
      fullscreen("first", R"J("write": { "result": "glow.mip[0]" })J") + "," +
          fullscreen(
              "down",
              R"J("repeat": { "i": [1, 5] }, "read": { "source": "glow.mip[i-1]" }, "write": { "result": "glow.mip[i]" })J") +
          "," +
          fullscreen(
              "up",
              R"J("repeat": { "i": [4, 0, -1] }, "read": { "source": "glow.mip[i+1]" }, "modify": { "result": "glow.mip[i]" }, "state": { "blend": "add" })J") +
          "," +
          R"J({ "name": "rest", "type": "compute", "shader": "a.comp.glsl", "threads": 1, "read": { "a": "glow.mip[5]?" }, "write": { "result": "out" } })J");
  CHECK(expandText(text).names() ==
        "first down[1] down[2] down[3] down[4] down[5] up[4] up[3] up[2] up[1] up[0] rest");
  Settings small;
  small.screenWidth = 12;
  small.screenHeight = 9;
  const Expanded e = expandText(text, small);
  CHECK(e.text().find("error") == std::string::npos);
  CHECK(e.names() == "first down[1] down[2] up[1] up[0] rest");
  CHECK(e.useText("rest", "a") == "-");
}
