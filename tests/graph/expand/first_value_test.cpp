// A history whose first value is a texture or buffer, and the history of what is bound to an input.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/graph/compile/compile.h"
#include "engine/graph/print/print.h"
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

std::string historyFile(const std::string& resources, const std::string& passes) {
  return R"J({ "resources": { "out": { "texture": "rgba8", "size": "screen" }, )J" + resources +
         R"J( }, "passes": [)J" + passes + R"J(], "present": "out" })J";
}
std::string paint(const std::string& name, const std::string& rest) {
  return R"J({ "name": ")J" + name + R"J(", "type": "fullscreen", "shader": "a.frag.glsl", )J" + rest + "}";
}

constexpr const char* kSeed = R"J("seed": { "texture": "rgba8", "size": [8, 4], "mips": 2, "clear": 0 })J";

std::string feedback(const std::string& first, const std::string& shape = R"J("size": [8, 4])J",
                     const std::string& read = "cells@-1") {
  return historyFile(
      std::string(kSeed) + R"J(, "cells": { "texture": "rgba16f", )J" + shape +
          R"J(, "history": 1, "first": )J" + first + " }",
      paint("plant", R"J("update": "once", "write": { "result": "seed.mip[0]" })J") + "," +
          paint("plant_small", R"J("update": "once", "write": { "result": "seed.mip[1]" })J") + "," +
          paint("grow", R"J("read": { "before": ")J" + read + R"J(" }, "write": { "result": "cells" })J") +
          "," + paint("last", R"J("read": { "c": "cells" }, "write": { "result": "out" })J"));
}

const FlatUse& firstOf(const Expanded& e, std::string_view pass, std::string_view slot) {
  const SlotSpec& spec = e.slot(pass, slot);
  REQUIRE(spec.firstValue != kNone);
  return e.graph->uses[spec.firstValue];
}

}  // namespace

TEST_CASE("a first value that is a texture: its reader depends on it, and it stays alive") {
  const Expanded e = expandText(feedback(R"J("seed")J"));
  REQUIRE_MESSAGE(e.graph, e.text());
  CHECK(e.of(Code::culledUnread).pass == "plant_small");
  const FlatUse& first = firstOf(e, "grow", "before");
  CHECK(e.graph->resourceNames[first.resource] == "seed");
  CHECK(first.kind == Kind::sampled);
  CHECK(first.access == Access::read);
  CHECK(first.history == 0);
  const SlotSpec& slot = e.slot("grow", "before");
  CHECK(slot.useCount == 1);
  CHECK(slot.firstValue == slot.firstUse + 1);
  REQUIRE(e.graph->histories.size() == 1);
  CHECK(e.graph->resourceNames[e.graph->histories[0].firstUse.resource] == "seed");
  const Plan plan = compile(e.graph);
  CHECK(plan.stepOf[e.pass("plant")] < plan.stepOf[e.pass("grow")]);
  CHECK(plan.stepOf[e.pass("plant_small")] == kNone);  // cells have one level
}

TEST_CASE("a first value that is a number costs no use") {
  const Expanded e = expandText(feedback("[1, 0, 0, 1]"));
  REQUIRE_MESSAGE(e.graph, e.text());
  CHECK(e.slot("grow", "before").firstValue == kNone);
  CHECK(compile(e.graph).stepOf[e.pass("plant")] == kNone);
}

TEST_CASE("of a first value the part is read that is read of the history") {
  const Expanded part = expandText(historyFile(
      std::string(kSeed) +
          R"J(, "cells": { "texture": "rgba16f", "size": [8, 4], "mips": 2, "clear": 0, "history": 1, "first": "seed" })J",
      paint("plant", R"J("update": "once", "write": { "result": "seed.mip[1]" })J") + "," +
          paint("grow",
                R"J("read": { "before": "cells.mip[1]@-1" }, "write": { "result": "cells.mip[1]" })J") +
          "," + paint("last", R"J("read": { "c": "cells" }, "write": { "result": "out" })J")));
  REQUIRE_MESSAGE(part.graph, part.text());
  CHECK(firstOf(part, "grow", "before").mip == 1);
  CHECK(firstOf(part, "grow", "before").mips == 1);
  const Expanded level = expandText(feedback(R"J("seed.mip[1]")J", R"J("size": [4, 2])J"));
  REQUIRE_MESSAGE(level.graph, level.text());
  CHECK(firstOf(level, "grow", "before").mip == 1);
  CHECK(firstOf(level, "grow", "before").mips == 1);
}

TEST_CASE("a first value that a compute pass stores has its barrier before the reader") {
  const Expanded e = expandText(historyFile(
      R"J("seed": { "texture": "rgba16f", "size": 8 }, "cells": { "texture": "rgba16f", "size": 8, "history": 1, "first": "seed" })J",
      R"J({ "name": "plant", "type": "compute", "shader": "a.comp.glsl", "write": { "result": "seed" } },)J" +
          paint("grow", R"J("read": { "before": "cells@-1" }, "write": { "result": "cells" })J") + "," +
          paint("last", R"J("read": { "c": "cells" }, "write": { "result": "out" })J")));
  REQUIRE_MESSAGE(e.graph, e.text());
  const Plan plan = compile(e.graph);
  CHECK((plan.steps[plan.stepOf[e.pass("grow")]].barriers & kBarrierTexture) != 0);
}

TEST_CASE("a first value that nobody has written: an error, or with '?' no first value") {
  const auto text = [](const char* first) {
    return historyFile(
        std::string(
            R"J("seed": { "texture": "rgba8", "size": 8 }, "cells": { "texture": "rgba8", "size": 8, "history": 1, "first": ")J") +
            first + R"J(" })J",
        paint("grow", R"J("read": { "before": "cells@-1" }, "write": { "result": "cells" })J") + "," +
            paint("plant", R"J("write": { "result": "seed" })J") + "," +
            paint("last", R"J("read": { "c": "cells", "s": "seed" }, "write": { "result": "out" })J"));
  };
  const Expanded late = expandText(text("seed"));
  CHECK(late.has(Code::readBeforeWrite));
  CHECK(late.of(Code::readBeforeWrite).place.line > 0);
  CHECK(late.of(Code::readBeforeWrite).hint ==
        "move 'plant' before it, or name another texture or buffer as \"first\"");
  CHECK(expandText(text("cells")).of(Code::readBeforeWrite).hint ==
        "give 'cells' a \"clear\", or name another texture or buffer as \"first\"");
  const Expanded without = expandText(text("seed ?"));
  REQUIRE_MESSAGE(without.graph, without.text());
  CHECK(without.slot("grow", "before").firstValue == kNone);
}

TEST_CASE("a first value must fit") {
  const auto misfit = [](const std::string& text, const char* expected) {
    const Expanded e = expandText(text);
    const text::Diagnostic& d = e.of(Code::badFormat);
    CHECK(d.pass == "grow");
    CHECK(d.resource == "cells");
    CHECK_MESSAGE(d.expected.find(expected) != std::string::npos, d.expected);
    CHECK_FALSE(d.found.empty());
    CHECK_FALSE(d.hint.empty());
  };
  misfit(feedback(R"J("seed")J", R"J("size": [8, 8])J"), "8x8");
  misfit(feedback(R"J("seed")J", R"J("size": [8, 4], "layers": 2)J"), "2 layers");
  misfit(
      historyFile(
          R"J("other": { "texture": "rgba8", "size": 8, "clear": 0, "history": 1 }, "list": ["other@-1", "other"],
                         "cells": { "texture": "rgba8", "size": 8, "history": 1, "first": "list" })J",
          paint("grow", R"J("read": { "before": "cells@-1" }, "write": { "result": "cells" })J") + "," +
              paint("fill", R"J("write": { "result": "other" })J") + "," +
              paint("last", R"J("read": { "c": "cells", "o": "other" }, "write": { "result": "out" })J")),
      "in this frame");
  misfit(
      historyFile(
          R"J("seed": { "texture": "r32ui", "size": 8, "clear": 0 }, "cells": { "texture": "r32f", "size": 8, "history": 1, "first": "seed" })J",
          paint("grow", R"J("read": { "before": "cells@-1" }, "write": { "result": "cells" })J") + "," +
              paint("last", R"J("read": { "c": "cells" }, "write": { "result": "out" })J")),
      "r32f");
  misfit(
      historyFile(
          R"J("seed": { "buffer": 16, "clear": 0 }, "cells": { "buffer": 64, "history": 1, "first": "seed" })J",
          R"J({ "name": "grow", "type": "compute", "shader": "a.comp.glsl", "threads": 1, "read": { "before": "cells@-1" }, "write": { "after": "cells" } },)J" +
              paint("last", R"J("read": { "c": "cells" }, "write": { "result": "out" })J")),
      "64 bytes");
  text::Diagnostics diagnostics;
  readGraphText(feedback(R"J("seed as linear")J"), "test.json", diagnostics);
  CHECK(diagnostics.contains(Code::badReference));
  diagnostics.clear();
  readGraphText(feedback(R"J("seed@-1")J"), "test.json", diagnostics);
  CHECK(diagnostics.contains(Code::badReference));
  CHECK(expandText(feedback(R"J("sead")J")).of(Code::unknownResource).hint.find("seed") != std::string::npos);
}

TEST_CASE("a pass may not modify what is the first value of what it reads") {
  const Expanded e = expandText(historyFile(
      R"J("seed": { "texture": "rgba8", "size": 8, "clear": 0 }, "cells": { "texture": "rgba8", "size": 8, "history": 1, "first": "seed" })J",
      paint(
          "grow",
          R"J("read": { "before": "cells@-1" }, "write": { "result": "cells" }, "modify": { "seed": "seed" })J") +
          "," + paint("last", R"J("read": { "c": "cells", "s": "seed" }, "write": { "result": "out" })J")));
  CHECK(e.has(Code::readAndWritten));
}

namespace {

// outer has `scene` and includes inner, which reads `in`; `input` and `scene` add keys to the two.
Expanded expandHistory(const std::string& input, const std::string& scene, const std::string& read = "in@-1",
                       const std::string& bind = "list") {
  return expandFiles(
      "expand_input_history",
      {{"inner.json", R"J({ "inputs": [{ "in": { )J" + input + R"J( } }],
    "resources": { "res": { "texture": "rgba8", "size": 4 } },
    "passes": [ { "name": "go", "type": "fullscreen", "shader": "a.frag.glsl",
                  "read": { "now": "in", "before": ")J" +
                          read + R"J(" }, "write": { "result": "res" } } ] })J"},
       {"outer.json", R"J({ "resources": { "scene": { "texture": "rgba8", "size": 4)J" + scene +
                          R"J( }, "list": ["scene"],
      "other": { "texture": "rgba8", "size": 4, "clear": 0 } }, "passes": [
      { "name": "draw", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "scene" } },
      { "include": "inner.json", "bind": { "in": ")J" +
                          bind + R"J(" } } ], "present": "inner.res" })J"}});
}

}  // namespace

TEST_CASE("an input with a history gives it to what is bound to it") {
  const Expanded e = expandHistory(R"J("history": 1, "first": 0.25, "reset": ["@cut", "size(in)"])J", "");
  REQUIRE_MESSAGE(e.graph, e.text());
  CHECK(e.useText("inner.go", "before") == "scene @-1");
  CHECK(e.resource("scene").history == 1);
  REQUIRE(e.graph->histories.size() == 1);
  CHECK(e.graph->histories[0].first == Value::number(0.25));
  CHECK(e.graph->histories[0].resetImports.size() == 1);
  REQUIRE(e.graph->histories[0].resetValues.size() == 1);
  CHECK(toText(e.graph->histories[0].resetValues[0]) == "[4, 4]");
}

TEST_CASE("of two that ask for a history the longer is kept, and the resource's own first value") {
  const Expanded e =
      expandHistory(R"J("history": 1, "first": 0.25)J", R"J(, "history": 3, "first": 0.5)J", "in@-3");
  REQUIRE_MESSAGE(e.graph, e.text());
  CHECK(e.resource("scene").history == 3);
  CHECK(e.graph->histories[0].first == Value::number(0.5));
  const Expanded longer = expandHistory(R"J("history": 4)J", R"J(, "history": 3)J", "in@-4");
  REQUIRE_MESSAGE(longer.graph, longer.text());
  CHECK(longer.resource("scene").history == 4);
}

TEST_CASE("an input without a history: the message names both places") {
  const Expanded e = expandHistory("", "");
  CHECK(e.of(Code::noHistory).hint == "declare \"history\": 1 on 'scene', or on this file's input");
}

TEST_CASE("a first value that waits for its own reader: the message does not advise an earlier publication") {
  const Expanded e = expandText(historyFile(
      R"J("seed": { "texture": "rgba8", "size": 8 }, "cells": { "texture": "rgba8", "size": 8, "history": 1, "first": "seed" })J",
      paint("grow", R"J("read": { "before": "cells@-1" }, "write": { "result": "cells" })J") + "," +
          paint("plant", R"J("read": { "c": "cells" }, "write": { "result": "seed" })J") + "," +
          paint("last", R"J("read": { "c": "cells", "s": "seed" }, "write": { "result": "out" })J")));
  CHECK(e.of(Code::passCycle).hint == "name another texture or buffer as \"first\"");
}

TEST_CASE("an input whose history is wrong, or that stands for an import, is one mistake") {
  for (const char* depth : {"-1", "1000000", "\"size(in)\""}) {
    const Expanded e = expandHistory(fmt::format(R"J("history": {})J", depth), "");
    CHECK_MESSAGE(e.diagnostics.size() == 1, e.text());
    CHECK_FALSE(e.has(Code::noHistory));
  }
  const Expanded view = expandHistory(R"J("history": 1)J", "", "in@-1", "@camera");
  CHECK_MESSAGE(view.diagnostics.errorCount() == 1, view.text());
  CHECK(view.has(Code::noHistory));
  const Expanded picture = expandHistory(R"J("history": 1)J", "", "in@-1", "@image");
  CHECK(picture.has(Code::noHistory));
}
