// One step at a time, without a frame around it: what it writes, whether it clears, and which barriers it issues itself.
#include <algorithm>

#include "engine/runtime/frame/step_runner.h"
#include "engine/runtime/uniforms/frame_uniforms.h"
#include "tests/runtime/gl_recorder.h"
#include "tests/runtime/plan_on_device.h"
#include "tests/runtime/stage.h"

namespace frame_step_runner_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

struct Steps {
  PlanOnDevice prepared;
  runtime::FrameUniforms uniforms;
  runtime::StepRunner runner;
  text::Diagnostics diagnostics;

  explicit Steps(const std::string& graph)
      : prepared(graph),
        uniforms(*prepared.plan, prepared.device.imports, 256),
        runner(*prepared.plan, prepared.device, *prepared.pool, uniforms) {
    uniforms.layOut(prepared.passes, diagnostics);
    uniforms.upload();
    prepared.device.timers.beginFrame(static_cast<std::uint32_t>(prepared.passes.size()));
  }
  void run(const char* pass, bool clears = true) {
    const std::size_t step = prepared.step(pass);
    runner.run(step, prepared.passes[step], clears, diagnostics);
    REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
  }
};

std::size_t countOf(const GlRecorder& recorder, GlCall::Kind kind) {
  return static_cast<std::size_t>(std::ranges::count(recorder.calls(), kind, &GlCall::kind));
}

}  // namespace

TEST_CASE("a step draws with the uniforms and textures of its pass") {
  const CleanScope clean;
  Steps steps("tests/runtime/graphs/live.json");
  steps.run("kept");
  CHECK(steps.prepared.texel("kept") == 50);
  steps.run("start");
  steps.run("scale[1]");
  CHECK(steps.prepared.texel("sum") == (50 + 4) * 2);
}

TEST_CASE("clears run when they are asked for, and the barrier after them is the step's own") {
  const CleanScope clean;
  Steps steps("tests/runtime/graphs/stores.json");
  steps.run("veil");
  CHECK(steps.prepared.texel("dots") == 0.25f);
  steps.run("veil", false);  // adds to what is there
  CHECK(steps.prepared.texel("dots") == 0.5f);
  steps.run("veil");
  CHECK(steps.prepared.texel("dots") == 0.25f);
  GlRecorder recorder;
  for (const graph::Step& step : steps.prepared.plan->steps) {
    recorder.start();
    steps.run(steps.prepared.plan->graph->specs[step.pass].name.c_str());
    CHECK(countOf(recorder, GlCall::Kind::barrier) == (step.barriersAfterClears != 0 ? 1 : 0));
    CHECK(countOf(recorder, GlCall::Kind::texture_barrier) == 0);
  }
}

TEST_CASE("a step draws the same, whatever state others left") {
  const CleanScope clean;
  Steps steps("tests/runtime/graphs/live.json");
  for (const GLenum capability : {GL_STENCIL_TEST, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST,
                                  GL_SAMPLE_MASK, GL_BLEND, GL_FRAMEBUFFER_SRGB})
    glEnable(capability);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  glColorMaski(0, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDepthFunc(GL_NEVER);
  glStencilFunc(GL_NEVER, 0, 0xff);
  glCullFace(GL_FRONT_AND_BACK);
  glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
  glBlendFunc(GL_ZERO, GL_ZERO);
  glSampleMaski(0, 0);
  glViewport(0, 0, 1, 1);
  glScissor(0, 0, 0, 0);
  steps.run("kept");
  CHECK(steps.prepared.texel("kept") == 50);
  steps.run("start");
  steps.run("scale[1]");
  CHECK(steps.prepared.texel("sum") == (50 + 4) * 2);
}

}  // namespace frame_step_runner_test
