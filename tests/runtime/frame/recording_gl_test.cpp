// What the executor says to GL in a frame, held against the plan: every glMemoryBarrier with exactly the plan's bits at
// the plan's places, in their order, nothing else; and no state call that sets what is current. Over every bundled graph.
#include <algorithm>
#include <filesystem>

#include "engine/graph/language/barrier_bit.h"
#include "tests/runtime/gl_recorder.h"
#include "tests/runtime/stage.h"

namespace weft::runtime::test {

namespace {

// Written from the specification (7.12.2), not from the executor's table.
GLbitfield glOf(std::uint16_t bits) {
  GLbitfield gl = 0;
  const auto take = [&](graph::BarrierBit mine, GLbitfield theirs) {
    gl |= (bits & mine) != 0 ? theirs : 0u;
  };
  take(graph::kBarrierVertex, GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
  take(graph::kBarrierIndex, GL_ELEMENT_ARRAY_BARRIER_BIT);
  take(graph::kBarrierUniform, GL_UNIFORM_BARRIER_BIT);
  take(graph::kBarrierTexture, GL_TEXTURE_FETCH_BARRIER_BIT);
  take(graph::kBarrierImage, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  take(graph::kBarrierCommand, GL_COMMAND_BARRIER_BIT);
  take(graph::kBarrierTextureUpdate, GL_TEXTURE_UPDATE_BARRIER_BIT);
  take(graph::kBarrierBufferUpdate, GL_BUFFER_UPDATE_BARRIER_BIT);
  take(graph::kBarrierFramebuffer, GL_FRAMEBUFFER_BARRIER_BIT);
  take(graph::kBarrierStorage, GL_SHADER_STORAGE_BARRIER_BIT);
  return gl;
}

// Of one walk over the steps, without the end of the frame.
std::vector<GLbitfield> barriersOf(const graph::Plan& plan) {
  std::vector<GLbitfield> all;
  for (const graph::Step& step : plan.steps)
    for (const std::uint16_t bits : {step.barriers, step.barriersAfterClears})
      if (bits != 0) all.push_back(glOf(bits));
  return all;
}

// The calls are some walks over the steps (headless frames finish work in slices ahead, a walk each) and one end.
bool areWalksOf(std::vector<GLbitfield> calls, const graph::Plan& plan, std::size_t& walks) {
  const std::vector<GLbitfield> walk = barriersOf(plan);
  if (plan.finalBarriers != 0) {
    if (calls.empty() || calls.back() != glOf(plan.finalBarriers)) return false;
    calls.pop_back();
  }
  walks = 1;
  if (walk.empty()) return calls.empty();
  if (calls.empty() || calls.size() % walk.size() != 0) return false;
  walks = calls.size() / walk.size();
  for (std::size_t i = 0; i < calls.size(); ++i)
    if (calls[i] != walk[i % walk.size()]) return false;
  return true;
}

struct Tally {
  std::size_t frames = 0, barriers = 0, stateCalls = 0, singleWalks = 0;
};

void recordFrames(Stage& stage, const std::string& label, Tally& tally) {
  GlRecorder recorder;
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    recorder.start();
    stage.run(frame);
    std::size_t walks = 0;
    CHECK_MESSAGE(
        areWalksOf(recorder.barriers(), stage.execution().plan(), walks),
        label << ", frame " << frame << ": " << recorder.barriers().size() << " calls of glMemoryBarrier");
    ++tally.frames;
    tally.barriers += recorder.barriers().size();
    // Between walks of one frame uploads may change the state unseen.
    if (walks > 1) continue;
    ++tally.singleWalks;
    tally.stateCalls += recorder.stateCalls();
    CHECK_MESSAGE(recorder.redundant().empty(),
                  label << ", frame " << frame << ": " << recorder.redundant().size() << " of "
                        << recorder.stateCalls() << " state calls change nothing, first "
                        << recorder.redundant()[0]);
  }
}

std::vector<std::string> bundledGraphs() {
  std::vector<std::string> graphs;
  for (const auto& entry : std::filesystem::directory_iterator(sourcePath("graphs")))
    if (entry.path().extension() == ".json") graphs.push_back("graphs/" + entry.path().filename().string());
  std::ranges::sort(graphs);
  return graphs;
}

}  // namespace

TEST_CASE(
    "the executor issues the plan's barriers, bit for bit, and no redundant state call, over all bundled "
    "graphs") {
  const CleanScope clean;
  Tally tally;
  std::size_t graphs = 0;
  for (const std::string& graph : bundledGraphs()) {
    Stage stage(graph, 96, 54);
    if (!stage.load()) continue;  // a part that only an includer completes
    ++graphs;
    recordFrames(stage, graph, tally);
  }
  MESSAGE(graphs << " graphs, " << tally.frames << " frames, " << tally.barriers << " barriers, "
                 << tally.stateCalls << " state calls in " << tally.singleWalks << " frames of one walk");
  CHECK(graphs >= 4);
  CHECK(tally.barriers > 0);
  CHECK(tally.singleWalks >= 3 * graphs);
}

TEST_CASE("the same with every boolean parameter of the studio switched, one by one") {
  const CleanScope clean;
  Tally tally;
  Stage stage("graphs/studio.json", 96, 54, "tests/runtime/scenes/everything.json");
  REQUIRE(stage.load());
  const auto parameters = stage.execution().plan().graph->parameters;
  std::size_t switched = 0;
  for (const graph::ParameterSpec& parameter : parameters) {
    if (parameter.value.type != graph::Value::Type::boolean) continue;
    ++switched;
    stage.settings.sets = {{parameter.path, parameter.value.v[0] != 0 ? "false" : "true"}};
    REQUIRE(stage.load());
    recordFrames(stage, parameter.path, tally);
  }
  MESSAGE(switched << " booleans, " << tally.frames << " frames, " << tally.barriers << " barriers");
  CHECK(switched >= 10);
}

TEST_CASE("the same with probes from the GPU and from the CPU, in textures and in a buffer, shown and not") {
  const CleanScope clean;
  Tally tally;
  Stage stage("graphs/studio_gi.json", 96, 54, "tests/golden/moving.json");
  for (const char* source : {"cpu", "gpu"})
    for (const char* sampling : {"textures", "buffer"})
      for (const char* shown : {"false", "true"}) {
        stage.settings.sets = {{"gi_source", source}, {"gi_sampling", sampling}, {"probes_debug", shown}};
        REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
        recordFrames(stage, std::string(source) + " " + sampling + " " + shown, tally);
      }
  MESSAGE(tally.frames << " frames, " << tally.barriers << " barriers");
  CHECK(tally.barriers > 0);
}

TEST_CASE("the same for the deferred graphs with all that a scene may hold, and for the probes of gi.json") {
  const CleanScope clean;
  const std::vector<std::vector<graph::Setting>> ways = {
      {},
      {{"ao_method", "hemisphere"}, {"clustered", "false"}, {"sun_shadow", "filtered"}},
      {{"store_positions", "true"}, {"bayer", "true"}, {"motion_blur", "true"}, {"auto_exposure", "true"}}};
  const std::vector<std::vector<graph::Setting>> probes = {{{"gi_source", "gpu"}, {"probes_debug", "true"}},
                                                           {{"gi_source", "gpu"}, {"gi_sampling", "buffer"}}};
  Tally deferred, gi;
  for (const bool with_probes : {false, true}) {
    Tally& tally = with_probes ? gi : deferred;
    const std::string graph = with_probes ? "graphs/deferred_gi.json" : "graphs/deferred.json";
    Stage stage(graph, 96, 54, "tests/runtime/scenes/everything.json");
    for (const std::vector<graph::Setting>& sets : with_probes ? probes : ways) {
      stage.settings.sets = sets;
      for (const auto& [name, texels] : {std::pair("sun_texels", "256"), std::pair("lamp_texels", "64")})
        stage.settings.sets.push_back({name, texels});
      REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
      std::string label = graph;
      for (const graph::Setting& set : sets) label += " " + graph::sourceOf(set);
      recordFrames(stage, label, tally);
      CHECK(stage.ran("surfaces"));
      CHECK(stage.ran("lit.transparent"));
      CHECK(stage.ran("lamp_shadow[1,5]"));
      CHECK(stage.ran("gi.probe_bake") == with_probes);
    }
  }
  MESSAGE(deferred.frames << " frames and " << deferred.barriers << " barriers, with probes " << gi.frames
                          << " and " << gi.barriers);
  CHECK(deferred.barriers > 0);
  CHECK(gi.barriers > deferred.barriers / 2);
}

TEST_CASE(
    "shader stores before clears of attachments and before mip levels: the bits are in the plan and are "
    "issued") {
  const CleanScope clean;
  Tally tally;
  Stage stage("tests/runtime/graphs/stores.json", 64, 64);
  REQUIRE(stage.load());
  std::uint16_t bits = 0;
  for (const graph::Step& step : stage.execution().plan().steps)
    bits = static_cast<std::uint16_t>(bits | step.barriers);
  CHECK((bits & graph::kBarrierTextureUpdate) != 0);
  CHECK((bits & graph::kBarrierFramebuffer) != 0);
  recordFrames(stage, "stores.json", tally);
  CHECK(tally.barriers > 0);
}

TEST_CASE("the same where histories begin with a texture, an image and a buffer") {
  const CleanScope clean;
  Tally tally;
  Stage stage("tests/runtime/graphs/first.json", 64, 64, "scenes/empty.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  recordFrames(stage, "first.json", tally);
  CHECK(tally.stateCalls > 0);
}

}  // namespace weft::runtime::test
