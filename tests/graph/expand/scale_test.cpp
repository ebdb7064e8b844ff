// Long graphs end, in time that grows with their length, and give what short ones give.
#include <chrono>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

std::string chain(int n) {
  return R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 }, "a": { "texture": "rgba8", "size": 8, "clear": 0 } }, "passes": [
    { "name": "step", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [1, )J" +
         std::to_string(n) +
         R"J(] }, "read": { "source": "a" }, "write": { "result": "a" }, "parameters": { "k": "i * 2" } },
    { "name": "last", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "source": "a" }, "write": { "result": "out" } } ], "present": "out" })J";
}

}  // namespace

TEST_CASE("ten thousand repeats") {
  const auto start = std::chrono::steady_clock::now();
  const Expanded e = expandText(chain(10'000));
  const double ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  MESSAGE("10,000 renames: ", ms, " ms");
  CHECK(e.text() == "");
  CHECK(e.graph->passes.size() == 10'001);
  CHECK(e.useText("last", "source") == "a#10001");
}

TEST_CASE("ten thousand broken repeats are one message") {
  std::string text = chain(10'000);
  text.replace(text.find(R"J("source": "a")J"), 13, R"J("source": "b")J");
  const Expanded e = expandText(text);
  CHECK(e.diagnostics.errorCount() == 1);
}

TEST_CASE("ten thousand culled modifies, ten thousand reads without a version") {
  const Expanded culled = expandText(
      R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 }, "a": { "texture": "rgba8", "size": 8, "clear": 0 } }, "passes": [
    { "name": "step", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [1, 10000] }, "modify": { "result": "a" } },
    { "name": "last", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "out" } } ], "present": "out" })J");
  CHECK(culled.graph);
  CHECK(culled.diagnostics.size() == 1);
  const Expanded missing = expandText(
      R"J({ "resources": { "out": { "texture": "rgba8", "size": 8, "clear": 0 }, "a": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "step", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [1, 10000] }, "read": { "s": "a" }, "modify": { "result": "out" } },
    { "name": "last", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "a" } } ], "present": "out" })J");
  CHECK_FALSE(missing.graph);
  CHECK(missing.diagnostics.errorCount() == 1);
}
