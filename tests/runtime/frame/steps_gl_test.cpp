// What runs in a frame, and why: hashes of what a pass is made of, slices. Which steps must run
// is read off the graphs by hand. Nothing is drawn.
#include <memory>

#include "engine/runtime/frame/execution.h"
#include "engine/runtime/uniforms/frame_uniforms.h"
#include "tests/runtime/plan_on_device.h"
#include "tests/runtime/stage.h"

namespace frame_steps_test {

using namespace weft;
using namespace weft::runtime::test;
using graph::Value;

namespace {

constexpr std::uint32_t kAlignment = 256;

struct ChosenSteps {
  PlanOnDevice on;
  runtime::FrameUniforms uniforms;
  runtime::FrameCadence steps;
  std::vector<std::uint64_t> hashes;
  std::vector<std::uint64_t> generations;  // nothing that passes read ever changes

  explicit ChosenSteps(const std::string& graph)
      : on(graph),
        uniforms(*on.plan, on.device.imports, kAlignment),
        steps(*on.plan),
        hashes(on.passes.size()),
        generations(on.plan->graph->resources.size(), 1) {
    text::Diagnostics diagnostics;
    uniforms.layOut(on.passes, diagnostics);
    REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
  }
  void refreshHashes() {
    for (std::size_t step = 0; step < hashes.size(); ++step)
      hashes[step] = runtime::hashOf(on.passes[step], on.plan->passOf(step).cadence, *on.pool,
                                     on.device.imports, uniforms);
  }
  // The names of the steps that a frame runs, in order.
  std::string frame() {
    steps.beginFrame(0);
    refreshHashes();
    steps.decide(hashes, generations);
    std::string names;
    for (std::size_t step = 0; step < on.passes.size(); ++step) {
      if (!steps.runs(step)) continue;
      steps.markRan(step);
      names += on.passes[step].context.spec->name + " ";
    }
    steps.endFrame(hashes, generations, generations);
    return names;
  }
};

}  // namespace

TEST_CASE(
    "a pass that is not `always` runs when its parameters, its storage or its program change, and else not") {
  const CleanScope clean;
  ChosenSteps live("tests/runtime/graphs/live.json");
  const std::string all = "kept start scale[1] timed ", others = "start scale[1] timed ";
  CHECK(live.frame() == all);
  CHECK(live.frame() == others);
  REQUIRE(live.uniforms.set("gain", Value::number(4)));  // which `kept` does not read
  CHECK(live.frame() == others);
  REQUIRE(live.uniforms.set("slow", Value::number(3)));
  CHECK(live.frame() == all);
  CHECK(live.frame() == others);
  const std::uint32_t written = live.on["kept"].written.at(0);
  ++(*live.on.pool)[written].serial;
  CHECK(live.frame() == all);
  ++(*live.on.pool)[written].resets;
  CHECK(live.frame() == all);
  ++live.on["kept"].programHash;
  CHECK(live.frame() == all);
  CHECK(live.frame() == others);
}

TEST_CASE("a step ran or not: in this frame, and always or not") {
  const CleanScope clean;
  ChosenSteps live("tests/runtime/graphs/live.json");
  const std::size_t kept = live.on.step("kept"), start = live.on.step("start");
  live.frame();
  CHECK(live.steps.ran(kept));
  CHECK(live.steps.ran(start));
  live.frame();
  CHECK_FALSE(live.steps.ran(kept));
  CHECK(live.steps.ran(start));
  live.steps.beginFrame(0);
  CHECK_FALSE(live.steps.ran(start));
  CHECK_FALSE(live.steps.isAlways(kept));
  CHECK(live.steps.isAlways(start));
}

TEST_CASE("what follows an execution of the same passes runs none of them again") {
  const CleanScope clean;
  ChosenSteps live("tests/runtime/graphs/live.json");
  live.frame();
  const auto runsKept = [&](const runtime::FrameCadence* before) {
    runtime::FrameCadence next(*live.on.plan, before);
    live.refreshHashes();
    next.decide(live.hashes, live.generations);
    return next.runs(live.on.step("kept"));
  };
  CHECK(runsKept(nullptr));
  CHECK_FALSE(runsKept(&live.steps));
}

}  // namespace frame_steps_test
