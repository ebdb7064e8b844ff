// What others see of what passes write: age, generation, turns of a history, what an execution continues. The passes of
// these tests are lists of what they write; nothing is drawn. Ages and turns are held against the words of publications.h.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "engine/runtime/frame/publications.h"
#include "tests/runtime/stage.h"

namespace weft::runtime::frame_publications_test {

namespace {

using test::CleanScope;
using test::Stage;

constexpr double kForever = std::numeric_limits<double>::infinity();

// Storage, cadence and publications of a graph file, beside the execution that runs it.
struct Bench {
  Stage stage;
  const graph::Plan& plan;
  std::unique_ptr<ResourcePool> pool;
  FrameCadence cadence;
  std::vector<PreparedPass> passes;
  Publications publications;

  explicit Bench(const std::string& graph, Bench* before = nullptr)
      : stage(graph),
        plan(planOf(stage)),
        pool(ResourcePool::create(plan, before ? before->pool.get() : nullptr, stage.diagnostics)),
        cadence(plan),
        passes(passesOf(plan)),
        publications(plan, *pool, stage.renderer().device().imports, cadence, passes,
                     before ? &before->publications : nullptr) {}

  static const graph::Plan& planOf(Stage& stage) {
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    return stage.execution().plan();
  }
  static std::vector<PreparedPass> passesOf(const graph::Plan& plan) {
    std::vector<PreparedPass> passes(plan.steps.size());
    for (std::size_t step = 0; step < passes.size(); ++step) {
      const graph::FlatPass& pass = plan.graph->passes[plan.steps[step].pass];
      for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
        if (plan.graph->uses[u].access != graph::Access::read)
          passes[step].written.push_back(plan.graph->uses[u].resource);
    }
    return passes;
  }
  std::uint32_t resource(std::string_view name) const { return lastVersionOf(plan, name); }
  std::size_t step(std::string_view pass) const {
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
      if (plan.graph->passNames[plan.steps[i].pass] == pass) return i;
    FAIL("no step of that name");
    return 0;
  }
  void begin(double time, bool headless = false) {
    FrameInput input;
    input.time = time;
    input.headless = headless;
    publications.beginFrame(input);
  }
  void runAll() {
    publications.beginRound();
    for (const PreparedPass& pass : passes) publications.publishWritten(pass);
  }
};

}  // namespace

TEST_CASE("the age of a resource is the time since its pass ran") {
  const CleanScope clean;
  Bench bench("tests/runtime/graphs/age.json");
  const std::uint32_t pulse = bench.resource("pulse");
  bench.begin(10);
  CHECK(bench.publications.ageOf(pulse) == 0);  // about to be published
  bench.runAll();
  CHECK(bench.publications.ageOf(pulse) == 0);
  bench.publications.endFrame();
  bench.begin(12.5);
  CHECK(bench.publications.ageOf(pulse) == 2.5);
  CHECK(bench.publications.ages()(pulse) == 2.5);
  bench.begin(9);  // a clock that went back
  CHECK(bench.publications.ageOf(pulse) == 0);
}

TEST_CASE("a headless run published everything before its first frame, a live one in it") {
  const CleanScope clean;
  Bench bench("tests/runtime/graphs/age.json");
  const std::uint32_t pulse = bench.resource("pulse");
  bench.begin(0, true);
  CHECK(bench.publications.ageOf(pulse) == kForever);
  bench.runAll();
  bench.publications.endFrame();
  bench.begin(1, true);
  CHECK(bench.publications.ageOf(pulse) == kForever);
}

TEST_CASE("a pass that will run in this frame makes what it publishes new before it runs") {
  const CleanScope clean;
  Bench bench("tests/runtime/graphs/age.json");
  const std::uint32_t pulse = bench.resource("pulse");
  bench.begin(0);
  bench.runAll();
  bench.publications.endFrame();
  bench.begin(3);
  CHECK(bench.publications.ageOf(pulse) == 3);
  // The cadence has seen no frame yet, so it lets every pass run.
  bench.cadence.decide(std::vector<std::uint64_t>(bench.passes.size()), bench.publications.generations());
  CHECK(bench.publications.announce());
  CHECK(bench.publications.ageOf(pulse) == 0);
}

TEST_CASE(
    "each frame turns a history by one, also when two passes write it, and every write moves the "
    "generation") {
  const CleanScope clean;
  Bench bench("tests/runtime/graphs/fibonacci.json");
  const std::uint32_t sum = bench.resource("sum");
  GpuResource& resource = (*bench.pool)[sum];
  REQUIRE(resource.copies == 3);
  PreparedPass another;  // writer of the same
  another.written = bench.passes[bench.step("next")].written;
  bench.passes.push_back(std::move(another));
  std::uint64_t generation = bench.publications.generations()[sum];
  for (std::uint32_t frame = 1; frame <= 7; ++frame) {
    const std::uint32_t before = resource.current;
    bench.begin(frame);
    bench.runAll();
    bench.publications.endFrame();
    CHECK(resource.current == (before + 1) % 3);
    CHECK(resource.copyOf(1) == before);
    CHECK(resource.publications == frame);
    CHECK(bench.publications.generationsBefore()[sum] == generation);
    CHECK(bench.publications.generations()[sum] > generation);
    generation = bench.publications.generations()[sum];
  }
}

TEST_CASE("a history is reset when what it depends on changes, and not before the first frame") {
  const CleanScope clean;
  Bench bench("tests/runtime/graphs/accumulate.json");
  GpuResource& sum = (*bench.pool)[bench.resource("sum")];
  text::Diagnostics diagnostics;
  const auto frame = [&](std::uint64_t cut) {
    FrameInput input;
    input.cutGeneration = cut;
    bench.stage.renderer().device().imports.beginFrame(bench.stage.world, input);
    bench.publications.beginFrame(input);
    bench.publications.refreshImports(diagnostics);
    const std::uint64_t resets = sum.resets;
    bench.publications.resetHistories(diagnostics);
    bench.runAll();
    bench.publications.endFrame();
    return sum.resets > resets;
  };
  CHECK_FALSE(frame(1));
  CHECK_FALSE(frame(1));
  CHECK(sum.publications == 2);
  CHECK(frame(2));
  CHECK(sum.publications == 1);
  CHECK(sum.resets == 1);
  CHECK_FALSE(frame(2));
  CHECK(diagnostics.empty());
}

TEST_CASE(
    "what lies where it lay keeps its generation and its age, everything else is newer than all there was") {
  const CleanScope clean;
  Bench before("tests/runtime/graphs/accumulate.json");
  for (int frame = 0; frame < 5; ++frame) {
    before.begin(frame);
    before.runAll();
    before.publications.endFrame();
  }
  const std::uint32_t old = before.resource("sum");
  const std::uint64_t generation = before.publications.generations()[old];
  std::uint64_t newest = 0;
  for (const std::uint64_t each : before.publications.generations()) newest = std::max(newest, each);
  Bench after("tests/runtime/graphs/accumulate.json", &before);
  const std::uint32_t sum = after.resource("sum");
  CHECK(after.publications.generations()[sum] == generation);
  for (std::uint32_t r = 0; r < after.publications.generations().size(); ++r)
    if (r != sum) CHECK(after.publications.generations()[r] > newest);
  after.begin(6);
  CHECK(after.publications.ageOf(sum) == 2);  // published at 4
}

}  // namespace weft::runtime::frame_publications_test
