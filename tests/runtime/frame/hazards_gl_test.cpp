// What every bundled graph binds and reads, judged by the specification's rules of barriers (gl_hazards.h): with stand-ins for the environment, in
// the declared order and in random ones. And each bit that a plan issues is taken away in turn: the judge must miss it. WEFT_ALL_ORDERS=1 in the
// environment runs 50 random orders of each graph in place of a sample.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "engine/graph/compile/compile.h"
#include "engine/runtime/frame/execution.h"
#include "tests/runtime/gl_hazards.h"
#include "tests/runtime/stage.h"

namespace weft::runtime::test::frame_hazards_test {

namespace {

// Runs frames of a plan of the stage's graph, beside the stage's own execution.
void runFrames(GlTrace& trace, Stage& stage, const std::shared_ptr<const graph::FlatGraph>& flat,
               const graph::CompileOptions& options, std::uint32_t frames) {
  text::Diagnostics diagnostics;
  const auto execution = Execution::create(stage.renderer().device(),
                                           std::make_shared<const graph::Plan>(graph::compile(flat, options)),
                                           nullptr, ShaderFiles::keep, diagnostics);
  REQUIRE_MESSAGE(execution, diagnostics.text());
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    trace.beginFrame();
    execution->frame(stage.world, headlessFrame(stage.world, frame, 60), diagnostics);
  }
  CHECK_MESSAGE(!diagnostics.hasErrors(), diagnostics.text());
}

std::vector<std::string> graphsThatRun() {
  std::vector<std::string> graphs{"tests/runtime/graphs/stores.json", "tests/runtime/graphs/draws.json"};
  for (const auto& entry : std::filesystem::directory_iterator(sourcePath("graphs")))
    if (entry.path().extension() == ".json") graphs.push_back("graphs/" + entry.path().filename().string());
  std::ranges::sort(graphs);
  return graphs;
}

// The same graph with every pass in every frame, but for time-sliced ones: so each bit is needed in each frame.
std::shared_ptr<const graph::FlatGraph> alwaysOf(const graph::FlatGraph& graph) {
  auto all = std::make_shared<graph::FlatGraph>(graph);
  for (graph::FlatPass& pass : all->passes)
    if (pass.slices == 1) pass.cadence = graph::Cadence::always;
  return all;
}

// How many bits the barriers of a frame have, and which of them nothing needs.
struct Bits {
  std::size_t all = 0;
  std::vector<LeftOut> idle;
};
Bits takeAwayEach(const GlTrace& trace) {
  std::vector<GLbitfield> barriers;  // of the first frame
  std::size_t frames = 0;
  for (const GlEvent& event : trace.events()) {
    frames += event.kind == GlEvent::Kind::frame;
    if (event.kind == GlEvent::Kind::barrier && frames == 1) barriers.push_back(event.bits);
  }
  Bits bits;
  for (std::size_t i = 0; i < barriers.size(); ++i)
    for (GLbitfield rest = barriers[i]; rest != 0; rest &= rest - 1) {
      const LeftOut out{i, rest & -rest};
      ++bits.all;
      if (findHazard(trace, out).empty()) bits.idle.push_back(out);
    }
  return bits;
}

}  // namespace

namespace {

// Barriers do not depend on how large a map is.
std::vector<graph::Setting> smallShadows() {
  return {{"shadow_texels", "256"}, {"lamp_texels", "64"}};
}

}  // namespace

TEST_CASE("hazards: no bundled graph lacks a barrier, in the declared order and in random ones") {
  const CleanScope clean;
  const char* every = std::getenv("WEFT_ALL_ORDERS");
  const std::uint64_t orders = every && *every == '1' ? 50 : 2;
  std::size_t graphs = 0, events = 0;
  for (const std::string& graph : graphsThatRun()) {
    CAPTURE(graph);
    GlTrace trace;
    Stage stage(withSmallMaps(graph), 64, 36, "tests/runtime/scenes/everything.json");
    if (graph.starts_with("graphs/deferred")) stage.settings.sets = smallShadows();
    if (!stage.load()) continue;  // a part, whose inputs only an includer binds
    ++graphs;
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
      trace.beginFrame();
      stage.run(frame);
    }
    CHECK(findHazard(trace) == "");
    for (std::uint64_t seed = 1; seed <= orders; ++seed)
      runFrames(trace, stage, stage.execution().plan().graph, {.orderSeed = seed}, 2);
    CHECK(findHazard(trace) == "");
    events += trace.events().size();
  }
  MESSAGE(graphs << " graphs, " << orders << " random orders of each, " << events << " events");
  CHECK(graphs >= 8);
}

TEST_CASE("hazards: each bit of a plan is missed when it is taken away") {
  const CleanScope clean;
  std::size_t all = 0;
  for (const std::string graph : {"tests/runtime/graphs/stores.json", "graphs/studio.json", "graphs/taa.json",
                                  "graphs/deferred_gi.json"}) {
    CAPTURE(graph);
    GlTrace trace;
    Stage stage(graph, 64, 36, "tests/runtime/scenes/everything.json");
    if (graph.starts_with("graphs/deferred")) stage.settings.sets = smallShadows();
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    runFrames(trace, stage, alwaysOf(*stage.execution().plan().graph), {}, 4);
    REQUIRE(findHazard(trace) == "");
    const Bits bits = takeAwayEach(trace);
    all += bits.all;
    for (const LeftOut& out : bits.idle)
      MESSAGE(graph << ": bit " << out.bit << " of barrier " << out.barrier << " is not missed");
    MESSAGE(graph << ": " << bits.all << " bits, " << bits.idle.size() << " not missed");
    CHECK(bits.idle.empty());
  }
  CHECK(all > 40);
}

TEST_CASE("hazards: what stands in for the environment ends with the bit that its reader needs") {
  const CleanScope clean;
  GlTrace trace;
  Stage stage("graphs/glow.json", 64, 36);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  trace.beginFrame();
  stage.run();
  CHECK(findHazard(trace) == "");
  std::size_t barrier = kBeforeFrames, last = 0;
  for (const GlEvent& event : trace.events()) {
    if (event.kind == GlEvent::Kind::frame) break;
    if (event.kind != GlEvent::Kind::barrier) continue;
    if ((event.bits & GL_TEXTURE_FETCH_BARRIER_BIT) != 0) last = barrier;
    ++barrier;
  }
  REQUIRE(last >= kBeforeFrames);
  CHECK(findHazard(trace, {last, GL_TEXTURE_FETCH_BARRIER_BIT}) != "");
}

}  // namespace weft::runtime::test::frame_hazards_test
