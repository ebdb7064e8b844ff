// graphs/studio.json as a whole on software GL: what is in its textures, what runs when, what a frame costs the heap.
#include <cmath>
#include <set>

#include "engine/graph/compile/compile.h"
#include "engine/graph/plan.h"
#include "tests/runtime/frame_allocations.h"
#include "tests/runtime/stage.h"

namespace frame_studio_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

bool isFloating(const gl::TextureRef& texture) {
  const gl::FormatClass kind = gl::classOf(texture.desc.format);
  return kind == gl::FormatClass::floating || kind == gl::FormatClass::depth;
}

// Every level and layer of every live texture of the execution; the number of textures looked at.
std::size_t checkFinite(runtime::Execution& execution) {
  const graph::Plan& plan = execution.plan();
  std::size_t looked = 0;
  for (std::uint32_t r = 0; r < plan.graph->resources.size(); ++r) {
    if (plan.graph->resources[r].kind != graph::ResourceKind::texture || plan.firstStep[r] == graph::kNone)
      continue;
    const gl::TextureRef texture = execution.texture(r);
    REQUIRE(texture.id != 0);
    if (!isFloating(texture)) continue;
    ++looked;
    std::size_t wrong = 0;
    for (std::uint32_t mip = 0; mip < texture.desc.mips; ++mip)
      for (std::uint32_t layer = 0; layer < gl::extentOf(texture.desc, mip).layers; ++layer)
        for (const float x : gl::readFloats(texture, mip, layer)) wrong += !std::isfinite(x);
    CHECK_MESSAGE(wrong == 0, plan.graph->resourceNames[r] << ": " << wrong << " values are not finite");
  }
  return looked;
}

// The same picture with and without shared storage; without it, every texture still holds what was written last.
void checkTextures(Stage& stage) {
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  const auto shared = stage.pixels();
  graph::Plan apart = graph::compile(stage.execution().plan().graph, {.share = false});
  auto execution = runtime::Execution::create(stage.renderer().device(),
                                              std::make_shared<const graph::Plan>(std::move(apart)), nullptr,
                                              runtime::ShaderFiles::read, stage.diagnostics);
  REQUIRE_MESSAGE(execution, stage.diagnostics.text());
  execution->frame(stage.world, runtime::headlessFrame(stage.world, 0, 60), stage.diagnostics);
  CHECK_MESSAGE(stage.diagnostics.empty(), stage.diagnostics.text());
  CHECK(checkFinite(*execution) >= 6);
  const gl::TextureRef presented = execution->presented();
  const auto bytes = gl::readTexture(presented, 0, 0, GL_RGBA, GL_UNSIGNED_BYTE);
  const std::size_t row = presented.desc.width * std::size_t{4};
  std::size_t different = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t y = presented.desc.height - 1 - i / row;
    different += std::to_integer<std::uint8_t>(bytes[i]) != shared[y * row + i % row];
  }
  CHECK(different == 0);
}

}  // namespace

TEST_CASE("studio: every texture is finite, with daylight") {
  const CleanScope clean;
  Stage stage("graphs/studio.json", 320, 180);
  checkTextures(stage);
}

TEST_CASE("studio: every texture is finite, with the real environment at 1920x1080") {
  const CleanScope clean;
  Stage stage("graphs/studio.json", 1920, 1080);
  stage.world.setEnvironment(
      std::make_shared<const assets::EnvironmentMap>(assets::toEnvironmentMap(*realEnvironment())));
  checkTextures(stage);
}

TEST_CASE("studio: what is not `always` runs in frame 0 and not again") {
  const CleanScope clean;
  Stage stage("graphs/studio.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const graph::FlatGraph& graph = *stage.execution().plan().graph;
  std::vector<bool> live(graph.passes.size());
  for (const auto& step : stage.execution().plan().steps) live[step.pass] = true;
  CHECK(std::ranges::count(live, false) == 2);  // the mean luminance, which nobody reads under this sky
  const auto check = [&](bool first) {
    for (std::size_t pass = 0; pass < graph.passes.size(); ++pass) {
      const std::string& name = graph.passNames[pass];
      const bool always = graph.passes[pass].cadence == graph::Cadence::always;
      CHECK_MESSAGE(stage.ran(name) == (live[pass] && (always || first)), name);
    }
  };
  stage.run(0);
  check(true);
  stage.run(1);
  check(false);
  stage.run(2);
  check(false);
}

TEST_CASE("the counter of allocations counts") {
  startCountingAllocations();
  const auto number = std::make_unique<std::string>(100, 'x');
  CHECK(stopCountingAllocations() == 2);
}

TEST_CASE("studio: the frame of an unchanged plan allocates nothing on the heap") {
  const CleanScope clean;
  for (const char* graph : {"graphs/studio.json", "graphs/glow.json"}) {
    Stage stage(graph);
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    stage.run(0);
    stage.run(1);
    for (std::uint32_t frame = 2; frame <= 5; ++frame) {
      const runtime::FrameInput input = runtime::headlessFrame(stage.world, frame, 60);
      startCountingAllocations();
      stage.renderer().frame(stage.world, input, stage.diagnostics);
      const std::size_t allocations = stopCountingAllocations();
      CHECK_MESSAGE(allocations == 0, graph << ", frame " << frame);
    }
  }
}

TEST_CASE("studio: nothing is left when everything is destroyed") {
  {
    Stage stage("graphs/studio.json");
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    stage.run();
    CHECK(gl::liveObjects(gl::ObjectKind::texture) > 20);
  }
  CHECK(gl::liveObjects() == "none");
}

}  // namespace frame_studio_test
