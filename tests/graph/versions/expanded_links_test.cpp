// Version links that expansion found, against their definition, over all bundled graphs, the paper's, and what is left of them
// with passes disabled; and that checker and compiler agree about what is alive.
#include <filesystem>

#include "engine/graph/compile/compile.h"
#include "tests/graph/compile/plan_checks.h"
#include "tests/graph/expand/support.h"
#include "tests/graph/versions/brute_links.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

namespace fs = std::filesystem;

std::string linkedPass(const std::string& name, const std::string& rest) {
  return R"J({ "name": ")J" + name + R"J(", "type": "fullscreen", "shader": "a.frag.glsl", )J" + rest + "}";
}
std::string linkedGraph(const std::string& resources, const std::string& passes) {
  return R"J({ "resources": { "out": { "texture": "rgba8", "size": "screen" }, )J" + resources +
         R"J( }, "passes": [)J" + passes + R"J(], "present": "out" })J";
}

// What checker and compiler must agree about in one graph.
void check(const FlatGraph& graph, const text::Diagnostics& said, const std::string& name,
           checks::LinkCount& count) {
  INFO(name);
  CHECK(checks::checkLinks(graph, count) == "");
  const Plan plan = compile(std::make_shared<const FlatGraph>(graph));
  CHECK(checks::checkLiveness(plan) == "");
  for (const text::Diagnostic& d : said.items())
    if (d.code == Code::culledUnread || d.code == Code::culledOverwritten)
      for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
        if (graph.passNames[p] == d.pass) CHECK_MESSAGE(plan.stepOf[p] == kNone, d.message);
}

}  // namespace

TEST_CASE("expansion's links are the last writers, in all bundled graphs, whole and with passes disabled") {
  checks::LinkCount count;
  std::size_t graphs = 0, expanded = 0;
  for (const char* folder :
       {"/graphs", "/graphs/presets", "/tests/golden", "/tests/runtime/graphs", "/tests/graph/paper"})
    for (const auto& entry : fs::directory_iterator(std::string(WEFT_SOURCE_DIR) + folder)) {
      if (entry.path().extension() != ".json" || entry.path().filename() == "manifest.json") continue;
      text::Diagnostics said;
      const auto desc = readGraph(entry.path().string(), said);
      if (!desc) continue;  // a preset or an overlay, or an include that needs a graph around it
      const auto whole = expandGraph(*desc, testRegistry(), {}, said);
      if (!whole) continue;
      ++graphs;
      check(*whole, said, entry.path().string(), count);
      std::string before;
      for (const PassSpec& spec : whole->specs) {
        if (spec.declared == before) continue;
        before = spec.declared;
        text::Diagnostics less;
        const auto rest = expandGraph(*desc, testRegistry(), with({}, {spec.declared}), less);
        if (!rest) continue;
        ++expanded;
        check(*rest, less, entry.path().string() + " without " + spec.declared, count);
      }
    }
  MESSAGE(graphs << " graphs, " << expanded << " with a pass disabled, " << count.links << " links, "
                 << count.several << " of several writers, " << count.none << " of none, " << count.histories
                 << " of earlier frames");
  CHECK(graphs > 10);
  CHECK(expanded > 20);
  for (const std::size_t n : {count.several, count.none, count.histories}) CHECK(n > 10);
}

TEST_CASE(
    "what is presented is one level: a pass that makes others only is culled, for checker and compiler") {
  const Expanded e = expandText(R"J({
    "resources": { "a": { "texture": "rgba8", "size": "screen", "mips": 2 },
                   "unwritten": { "texture": "rgba8", "size": "screen" } },
    "passes": [ )J" + linkedPass("near", R"J("write": { "result": "a.mip[0]" })J") +
                                "," + linkedPass("far", R"J("read": { "source": "unwritten" },
                                                      "write": { "result": "a.mip[1]" })J") +
                                R"J( ], "present": "a" })J");
  REQUIRE_MESSAGE(e.graph, e.text());
  CHECK(e.of(Code::nobodyWrites).severity == text::Severity::warning);
  const Plan plan = compile(e.graph);
  CHECK(plan.stepOf[e.pass("near")] != kNone);
  CHECK(plan.stepOf[e.pass("far")] == kNone);
}

TEST_CASE("with feedback, a read slot behind the modify slot sees the version before the pass") {
  const Expanded e = expandText(linkedGraph(
      R"J("a": { "texture": "rgba8", "size": "screen" })J",
      linkedPass("first", R"J("write": { "result": "a" })J") + "," +
          linkedPass("own", R"J("feedback": true, "modify": { "into": "a" }, "read": { "from": "a" })J") +
          "," + linkedPass("last", R"J("read": { "source": "a" }, "write": { "result": "out" })J")));
  REQUIRE_MESSAGE(e.graph, e.text());
  checks::LinkCount count;
  CHECK(checks::checkLinks(*e.graph, count) == "");
  CHECK(e.graph->links.seen[e.slot("own", "from").firstUse] == e.slot("first", "result").firstUse);
  CHECK(e.graph->links.seen[e.slot("last", "source").firstUse] == e.slot("own", "into").firstUse);
}

TEST_CASE("a texture that is rewritten whole and in part again and again has its own links each time") {
  std::string passes;
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    passes += linkedPass("part" + n, R"J("write": { "result": "a.mip[0]" })J") + "," +
              linkedPass("rest" + n, R"J("write": { "result": "a.mip[1]" })J") + "," +
              linkedPass("use" + n, R"J("read": { "source": "a" }, "write": { "result": "b" })J") + "," +
              linkedPass("whole" + n, R"J("read": { "source": "b" }, "write": { "result": "c" })J") + "," +
              linkedPass("clear" + n, R"J("read": { "source": "c" }, "modify": { "result": "out" })J") + ",";
  }
  const Expanded e = expandText(linkedGraph(
      R"J("a": { "texture": "rgba8", "size": "screen", "mips": 2, "clear": 0 },
          "b": { "texture": "rgba8", "size": "screen" }, "c": { "texture": "rgba8", "size": "screen" })J",
      linkedPass("start", R"J("write": { "result": "out" })J") + "," + passes +
          linkedPass("end", R"J("modify": { "result": "out" })J")));
  REQUIRE_MESSAGE(e.graph, e.text());
  checks::LinkCount count;
  check(*e.graph, e.diagnostics, "rewritten", count);
  CHECK(count.several >= 3);
  CHECK(e.useText("use2", "result") == "b#3");
}
