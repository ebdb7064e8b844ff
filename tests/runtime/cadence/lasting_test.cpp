// What an obsolete frame still has to do.
#include <doctest/doctest.h>

#include <memory>
#include <string>

#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/cadence/cadence.h"

using namespace weft;

namespace {

// Names of the steps that last, in order.
std::string lasting(const std::string& passes, const std::string& resources, const std::string& rest = "") {
  const std::string text = R"({ "resources": { "ldr": { "texture": "rgba8", "size": "screen" })" + resources +
                           R"( }, "passes": [ )" + passes + R"( ], "present": "ldr")" + rest + " }";
  graph::Registry registry;
  registry.passTypes.push_back({.name = "fullscreen", .doc = "", .shader = graph::ShaderShape::fragment});
  registry.factsOf = [](const graph::ImportRequest&) { return graph::ImportFacts{}; };
  text::Diagnostics diagnostics;
  const auto desc = graph::readGraphText(text, "lasting.json", diagnostics);
  REQUIRE_MESSAGE(desc, diagnostics.text());
  const auto flat = graph::expandGraph(*desc, registry, {}, diagnostics);
  REQUIRE_MESSAGE(flat, diagnostics.text());
  const graph::Plan plan = graph::compile(flat);
  const std::vector<std::uint8_t> found = runtime::findLastingSteps(plan);
  REQUIRE(found.size() == plan.steps.size());
  std::string names;
  for (std::size_t s = 0; s < found.size(); ++s)
    if (found[s]) names += flat->passNames[plan.steps[s].pass] + " ";
  return names;
}

std::string pass(const std::string& name, const std::string& rest) {
  return R"({ "name": ")" + name + R"(", "type": "fullscreen", "shader": "a.frag.glsl", )" + rest + " }";
}

const std::string kHdr = R"(, "hdr": { "texture": "rgba16f", "size": "screen" })";

}  // namespace

TEST_CASE("lasting: a picture that nothing outlives leaves nothing behind") {
  CHECK(lasting(pass("sky", R"("write": { "r": "hdr" })") + "," +
                    pass("tone", R"("read": { "s": "hdr" }, "write": { "r": "ldr" })"),
                kHdr) == "");
}

TEST_CASE("lasting: a history that is kept, and all that it is made from; not what only looks at it") {
  const std::string passes =
      pass("sky", R"("write": { "r": "hdr" })") + "," +
      pass("blend", R"("read": { "s": "hdr", "old": "sum@-1" }, "write": { "r": "sum" })") + "," +
      pass("late", R"("read": { "s": "hdr" }, "write": { "r": "hdr" })") + "," +
      pass("tone", R"("read": { "s": "hdr", "sum": "sum" }, "write": { "r": "ldr" })");
  CHECK(lasting(passes,
                kHdr + R"(, "sum": { "texture": "rgba16f", "size": "screen", "history": 1, "first": 0 })") ==
        "");
  const std::string slow =
      pass("sky", R"("write": { "r": "hdr" })") + "," +
      pass("blend", R"("update": "on_change", "read": { "s": "hdr" }, "write": { "r": "sum" })") + "," +
      pass("tone", R"("read": { "s": "hdr", "sum": "sum", "old": "sum@-1" }, "write": { "r": "ldr" })");
  CHECK(lasting(slow,
                kHdr + R"(, "sum": { "texture": "rgba16f", "size": "screen", "history": 1, "first": 0 })") ==
        "sky blend ");
}

TEST_CASE("lasting: what runs once or on change, and an `always` pass that it reads") {
  const std::string passes =
      pass("table", R"("update": "once", "write": { "r": "table" })") + "," +
      pass("noise", R"("write": { "r": "noise" })") + "," +
      pass("kept", R"("update": "on_change", "read": { "s": "noise" }, "write": { "r": "kept" })") + "," +
      pass("tone", R"("read": { "a": "table", "b": "kept" }, "write": { "r": "ldr" })");
  const auto texture = [](const std::string& name) {
    return ", \"" + name + R"(": { "texture": "rgba16f", "size": 4 })";
  };
  CHECK(lasting(passes, texture("table") + texture("noise") + texture("kept")) == "table noise kept ");
}
