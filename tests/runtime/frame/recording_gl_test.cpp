// The GL calls of whole frames, held against the plan (gl_replay.h): every barrier with exactly its bits in its place. Over every
// bundled graph and preset, and over the frames of a fade.
#include <algorithm>
#include <filesystem>
#include <set>

#include "engine/graph/registry.h"
#include "tests/runtime/gl_recorder.h"
#include "tests/runtime/gl_replay.h"
#include "tests/runtime/stage.h"

namespace weft::runtime::test::frame_recording_test {

namespace {

struct Tally {
  std::size_t frames = 0, walks = 0, barriers = 0, textureBarriers = 0;
};

// Runs a frame and judges it. What ran is what the calls show.
template <class Frame>
void recordFrame(GlRecorder& recorder, Stage& stage, const std::string& label, Tally& tally, Frame&& frame) {
  recorder.start();
  frame();
  const graph::Plan& plan = stage.execution().plan();
  GlReplay replay(plan);
  const std::string problem = replay.judge(recorder.calls());
  CHECK_MESSAGE(problem.empty(), label << ", frame " << tally.frames << ": " << problem);
  std::size_t wrong = 0;
  for (const graph::Step& step : plan.steps) {
    const std::string& name = plan.graph->specs[step.pass].name;
    wrong += stage.ran(name) != replay.ran().contains(name);
  }
  CHECK_MESSAGE(wrong == 0, label << ": " << wrong << " passes ran and show no calls, or the reverse");
  ++tally.frames;
  tally.walks += replay.walks();
  tally.barriers += replay.barriers();
  tally.textureBarriers += replay.textureBarriers();
}

// In the second frame histories have changed places; what follows repeats the two.
void recordFrames(Stage& stage, const std::string& label, Tally& tally, std::uint32_t frames = 4) {
  GlRecorder recorder;
  for (std::uint32_t frame = 0; frame < frames; ++frame)
    recordFrame(recorder, stage, label, tally, [&] { stage.run(frame); });
}

std::vector<std::string> bundledIn(const std::string& folder) {
  std::vector<std::string> graphs;
  for (const auto& entry : std::filesystem::directory_iterator(sourcePath(folder)))
    if (entry.path().extension() == ".json")
      graphs.push_back(folder + "/" + entry.path().filename().string());
  std::ranges::sort(graphs);
  return graphs;
}

// Parts whose inputs only an includer binds.
const std::set<std::string> kParts = {
    "graphs/boxes.json",        "graphs/daylight_sun.json", "graphs/deferred_lit.json",
    "graphs/fade.json",         "graphs/gi_debug.json",     "graphs/lit.json",
    "graphs/mesh_shadows.json", "graphs/neighbors.json",    "graphs/post.json"};

}  // namespace

TEST_CASE("the executor issues the plan's barriers, bit for bit, over all bundled graphs") {
  const CleanScope clean;
  Tally tally;
  std::size_t graphs = 0;
  std::vector<std::string> all = bundledIn("graphs");
  all.emplace_back("tests/runtime/graphs/masks.json");
  for (const std::string& graph : all) {
    CAPTURE(graph);
    Stage stage(withSmallMaps(graph), 48, 27);
    const bool loaded = stage.load();
    CHECK_MESSAGE(loaded != kParts.contains(graph), stage.diagnostics.text());
    if (!loaded) continue;
    ++graphs;
    recordFrames(stage, graph, tally);
  }
  MESSAGE(graphs << " graphs, " << tally.frames << " frames, " << tally.walks << " walks, " << tally.barriers
                 << " barriers");
  CHECK(tally.barriers > 0);
}

TEST_CASE("the judge finds a barrier that is missing, moved or has other bits, and calls too many") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/stores.json", 64, 64);
  REQUIRE(stage.load());
  GlRecorder recorder;
  stage.run();
  const std::vector<GlCall> calls = recorder.calls();
  GlReplay replay(stage.execution().plan());
  CHECK(replay.judge(calls) == "");
  std::size_t barriers = 0, copies = 0;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    std::vector<GlCall> wrong = calls;
    if (calls[i].kind == GlCall::Kind::barrier) {
      ++barriers;
      wrong[i].bits ^= GL_TEXTURE_FETCH_BARRIER_BIT;
      CHECK(replay.judge(wrong) != "");
      wrong.erase(wrong.begin() + static_cast<std::ptrdiff_t>(i));
      CHECK(replay.judge(wrong) != "");
    } else if (calls[i].kind == GlCall::Kind::copy && calls[i].name == "glBlitNamedFramebuffer") {
      wrong[i].name = "glCopyImageSubData";
      copies += replay.judge(wrong) != "" ? 1 : 0;  // that of 'keep', not the one that presents
    } else if (calls[i].kind == GlCall::Kind::group) {
      wrong.insert(wrong.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                   {.kind = GlCall::Kind::texture_barrier});
      CHECK(replay.judge(wrong) != "");
    }
  }
  CHECK(barriers > 0);
  CHECK(copies == 1);
}

TEST_CASE("the same where headless frames finish time-sliced work ahead, a walk for each round of it") {
  const CleanScope clean;
  Tally tally;
  Stage studio(withSmallMaps("graphs/studio.json"), 48, 27);
  studio.settings.sets = {{"ibl.sliced", "true"}};
  REQUIRE_MESSAGE(studio.load(), studio.diagnostics.text());
  recordFrames(studio, "lighting in slices", tally);
  Stage slices("tests/runtime/graphs/slices.json", 64, 64, "scenes/empty.json");
  slices.settings.sets = {{"n", "3"}, {"m", "2"}};
  REQUIRE_MESSAGE(slices.load(), slices.diagnostics.text());
  recordFrames(slices, "slices.json", tally);
  MESSAGE(tally.frames << " frames, " << tally.walks << " walks, " << tally.barriers << " barriers");
  CHECK(tally.walks >= tally.frames + 2);
}

TEST_CASE("the same with each preset") {
  const CleanScope clean;
  Tally tally;
  for (const std::string& preset : bundledIn("graphs/presets")) {
    CAPTURE(preset);
    const bool probes = preset.ends_with("/point_probes.json");  // is for studio_gi
    Stage stage(withSmallMaps(probes ? "graphs/studio_gi.json" : "graphs/studio.json"), 48, 27,
                "scenes/spheres.json", "", {sourcePath(preset)});
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    recordFrames(stage, preset, tally, 2);
  }
  MESSAGE(tally.frames << " frames, " << tally.barriers << " barriers, " << tally.textureBarriers
                       << " texture barriers");
  CHECK(tally.textureBarriers > 0);  // depth of field reads and writes one texture
}

TEST_CASE("the same while one environment fades into the next, with lighting in slices and without") {
  const auto mapOf = [](std::uint16_t brightness) {
    auto map = std::make_shared<assets::EnvironmentMap>();
    map->width = 64;
    map->height = 32;
    map->texels.assign(std::size_t{64} * 32 * 4, brightness);
    return map;
  };
  for (const char* sliced : {"false", "true"}) {
    CAPTURE(sliced);
    const CleanScope clean;
    Tally tally;
    Stage stage(withSmallMaps("graphs/studio.json"), 48, 27);
    stage.settings.sets = {{"ibl.sliced", sliced}};
    stage.settings.window = true;
    GlRecorder recorder;
    std::uint32_t frames = 0, changed = 0;
    std::vector<std::uint8_t> last;
    for (const std::uint16_t brightness : {0x3800, 0x3c00}) {
      stage.world.setEnvironment(mapOf(brightness));
      REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
      // In slices the lighting takes some dozens of frames before the fade begins.
      for (int n = 0; n < (sliced[0] == 't' ? 80 : 10); ++n) {
        FrameInput input = headlessFrame(stage.world, 0, 60);
        input.headless = false;
        input.time = 10 + 0.05 * frames++;
        input.deltaTime = 0.05;
        recordFrame(recorder, stage, "fade", tally, [&] { stage.run(input); });
        std::vector<std::uint8_t> seen = stage.pixels();
        changed += seen != last;
        last = std::move(seen);
      }
    }
    MESSAGE(frames << " frames, " << changed << " with another picture, " << tally.barriers << " barriers");
    CHECK(changed >= 7);  // the first, and those of a fade
  }
}

TEST_CASE("the same with every boolean parameter of the studio switched, one by one") {
  const CleanScope clean;
  Tally tally;
  Stage stage(withSmallMaps("graphs/studio.json"), 48, 27, "tests/runtime/scenes/everything.json");
  REQUIRE(stage.load());
  const auto parameters = stage.execution().plan().graph->parameters;
  std::size_t switched = 0;
  for (const graph::ParameterSpec& parameter : parameters) {
    if (parameter.value.type != graph::Value::Type::boolean) continue;
    ++switched;
    stage.settings.sets = {{parameter.path, parameter.value.v[0] != 0 ? "false" : "true"}};
    REQUIRE(stage.load());
    recordFrames(stage, parameter.path, tally, 2);
  }
  MESSAGE(switched << " booleans, " << tally.frames << " frames, " << tally.barriers << " barriers");
  CHECK(switched >= 10);
}

TEST_CASE("the same with probes in textures and in a buffer, shown and not") {
  const CleanScope clean;
  Tally tally;
  Stage stage(withSmallMaps("graphs/studio_gi.json"), 48, 27, "tests/golden/moving.json");
  for (const char* sampling : {"textures", "buffer"})
    for (const char* shown : {"false", "true"}) {
      stage.settings.sets = {{"gi_sampling", sampling}, {"probes_debug", shown}};
      REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
      recordFrames(stage, std::string(sampling) + " " + shown, tally);
    }
  MESSAGE(tally.frames << " frames, " << tally.barriers << " barriers");
  CHECK(tally.barriers > 0);
}

TEST_CASE("the same for the deferred graphs with all that a scene may hold, and for the probes of gi.json") {
  const CleanScope clean;
  const std::vector<std::vector<graph::Setting>> ways = {
      {},
      {{"ao_method", "hemisphere"}, {"clustered", "false"}, {"mesh_shadows", "false"}},
      {{"store_positions", "true"}, {"bayer", "true"}, {"motion_blur", "true"}, {"auto_exposure", "true"}}};
  const std::vector<std::vector<graph::Setting>> probes = {{{"probes_debug", "true"}},
                                                           {{"gi_sampling", "buffer"}}};
  Tally deferred, gi;
  for (const bool with_probes : {false, true}) {
    Tally& tally = with_probes ? gi : deferred;
    const std::string graph = with_probes ? "graphs/deferred_gi.json" : "graphs/deferred.json";
    Stage stage(withSmallMaps(graph), 48, 27, "tests/runtime/scenes/everything.json");
    for (const std::vector<graph::Setting>& sets : with_probes ? probes : ways) {
      stage.settings.sets = sets;
      for (const auto& [name, texels] : {std::pair("shadow_texels", "256"), std::pair("lamp_texels", "64")})
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
    "shader stores before clears of attachments, before copies and before mip levels: the bits are in "
    "the plan and are issued") {
  const CleanScope clean;
  Tally tally;
  Stage stage("tests/runtime/graphs/stores.json", 64, 64);
  REQUIRE(stage.load());
  std::uint16_t bits = 0, beforeCopy = 0;
  const graph::Plan& plan = stage.execution().plan();
  for (const graph::Step& step : plan.steps) {
    bits = static_cast<std::uint16_t>(bits | step.barriers);
    if (plan.graph->passNames[step.pass] == "keep") beforeCopy = step.barriers;
  }
  CHECK(beforeCopy == graph::kBarrierFramebuffer);
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
  CHECK(tally.walks > 0);
}

}  // namespace weft::runtime::test::frame_recording_test
