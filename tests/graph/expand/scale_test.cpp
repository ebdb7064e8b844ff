// Long graphs end, with work that grows with their length, and give what short ones give. Work is counted, not timed:
// what expansion keeps, and what it allocates.
#include <array>
#include <string_view>

#include "tests/graph/allocation_count.h"
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

// n passes that each read and write one resource, which makes n versions of it.
std::string chain(int n) {
  return R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 }, "a": { "texture": "rgba8", "size": 8, "clear": 0 } }, "passes": [
    { "name": "step", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [1, )J" +
         std::to_string(n) +
         R"J(] }, "read": { "source": "a" }, "write": { "result": "a" }, "parameters": { "k": "i * 2" } },
    { "name": "last", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "source": "a" }, "write": { "result": "out" } } ], "present": "out" })J";
}

// n passes that change one resource which nobody reads.
std::string culled(int n) {
  return R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 }, "a": { "texture": "rgba8", "size": 8, "clear": 0 } }, "passes": [
    { "name": "step", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [1, )J" +
         std::to_string(n) + R"J(] }, "modify": { "result": "a" } },
    { "name": "last", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "out" } } ], "present": "out" })J";
}

// n passes that read a resource which is written only after them.
std::string missing(int n) {
  return R"J({ "resources": { "out": { "texture": "rgba8", "size": 8, "clear": 0 }, "a": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "step", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [1, )J" +
         std::to_string(n) + R"J(] }, "read": { "s": "a" }, "modify": { "result": "out" } },
    { "name": "last", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "a" } } ], "present": "out" })J";
}

// n resources and n stanzas, each with a name, a size and a condition of its own, in a row.
std::string stanzas(int n) {
  std::string resources, passes;
  for (int i = 1; i <= n; ++i) {
    const std::string at = std::to_string(i), before = std::to_string(i - 1);
    resources += ", \"r" + at + R"J(": { "texture": "rgba8", "size": "size(r)J" + before + ")\" }";
    passes += R"J({ "name": "p)J" + at +
              R"J(", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": "$on", "read": { "s": "r)J" +
              before + R"J(" }, "write": { "result": "r)J" + at + "\" } }" + (i < n ? ",\n" : "");
  }
  return R"J({ "parameters": { "on": { "default": true } }, "resources": { "r0": { "texture": "rgba8", "size": 8, "clear": 0 })J" +
         resources + " }, \"passes\": [" + passes + "], \"present\": \"r" + std::to_string(n) + "\" }";
}

struct Work {
  static constexpr std::array<std::string_view, 3> kNames = {"versions read", "allocations",
                                                             "bytes allocated"};
  std::array<std::size_t, 3> counts{};
};

Work workOf(const std::string& json) {
  text::Diagnostics diagnostics;
  const auto desc = readGraphText(json, "test.json", diagnostics);
  REQUIRE_MESSAGE(desc, diagnostics.text());
  const Registry registry = testRegistry();
  const std::size_t allocations = allocationCount(), bytes = allocatedBytes();
  const auto graph = expandGraph(*desc, registry, {}, diagnostics);
  return {{graph ? graph->links.seen.size() + graph->links.runs.size() : 0, allocationCount() - allocations,
           allocatedBytes() - bytes}};
}

}  // namespace

TEST_CASE("the work of expansion grows with the length of a graph, and no faster") {
  constexpr int kShort = 500, kTimes = 4;
  for (std::string (*const graph)(int) : {chain, culled, missing, stanzas}) {
    const Work small = workOf(graph(kShort)), large = workOf(graph(kTimes * kShort));
    CAPTURE(graph(2));
    CHECK(small.counts[2] > kShort);  // something is counted
    for (std::size_t i = 0; i < small.counts.size(); ++i) {
      CAPTURE(Work::kNames[i]);
      // 4 is linear, 16 square. The rest is for what does not depend on the length; 1.003 was measured.
      const double linear = kTimes * static_cast<double>(small.counts[i]);
      CHECK(static_cast<double>(large.counts[i]) <= 1.02 * linear + 64);
    }
  }
}

TEST_CASE("four thousand repeats") {
  const Expanded e = expandText(chain(4'000));
  CHECK(e.text() == "");
  CHECK(e.graph->passes.size() == 4'001);
  CHECK(e.useText("last", "source") == "a#4001");
}

TEST_CASE("four thousand broken repeats are one message") {
  std::string text = chain(4'000);
  text.replace(text.find(R"J("source": "a")J"), 13, R"J("source": "b")J");
  const Expanded e = expandText(text);
  CHECK(e.diagnostics.errorCount() == 1);
}

TEST_CASE("four thousand culled modifies, four thousand reads without a version") {
  const Expanded unread = expandText(culled(4'000));
  CHECK(unread.graph);
  CHECK(unread.diagnostics.size() == 1);
  const Expanded unwritten = expandText(missing(4'000));
  CHECK_FALSE(unwritten.graph);
  CHECK(unwritten.diagnostics.errorCount() == 1);
}
