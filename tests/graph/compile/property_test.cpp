// Properties of every plan, over random graphs of mixed kinds.
#include <doctest/doctest.h>

#include "tests/graph/compile/hazard_oracle.h"
#include "tests/graph/compile/plan_checks.h"
#include "tests/graph/compile/random_graph.h"
#include "tests/graph/compile/replay.h"

using namespace weft::graph;

namespace {

constexpr std::uint64_t kPropertyGraphs = 2500;

// The corners in which a bit may be there for a cadence alone: a history that does not turn in each frame,
// and a group that publishes now and then.
bool turnsNowAndThen(const Plan& plan) {
  if (!plan.groups.ofResource.empty()) return true;
  const FlatGraph& graph = *plan.graph;
  for (std::uint32_t r = 0; r < graph.resources.size(); ++r) {
    if (graph.resources[r].history == 0 || plan.firstStep[r] == kNone) continue;
    bool always = false;
    for (const Step& step : plan.steps) {
      const FlatPass& pass = graph.passes[step.pass];
      for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
        always = always || (plan.attached[u] != 0 && graph.uses[u].resource == r &&
                            graph.uses[u].access != Access::read && pass.cadence == Cadence::always);
    }
    if (!always) return true;
  }
  return false;
}

// How often the graphs reach the interesting cases.
struct Coverage {
  std::size_t sliced = 0, shared = 0, overlapping = 0, histories = 0, persistent = 0, splitClears = 0,
              feedback = 0, parts = 0;

  void add(const Plan& plan) {
    const FlatGraph& graph = *plan.graph;
    for (const Storage& s : plan.storages) shared += s.shared ? 1 : 0;
    std::uint64_t buffers = 0;
    for (std::uint32_t r = 0; r < graph.resources.size(); ++r) {
      if (plan.firstStep[r] == kNone) continue;
      sliced += plan.copiesOf(r) > graph.resources[r].history + 1u ? 1 : 0;
      histories += graph.resources[r].history > 0 ? 1 : 0;
      persistent += plan.persistent[r];
      if (plan.bufferOffsetOf[r] != Plan::kNoOffset) buffers += (graph.resources[r].bytes + 255) / 256 * 256;
    }
    overlapping += buffers > plan.arenaBytes ? 1 : 0;
    for (const Step& step : plan.steps) splitClears += step.barriersAfterClears != 0 ? 1 : 0;
    for (std::size_t u = 0; u < graph.uses.size(); ++u) {
      if (plan.attached[u] == 0) continue;
      feedback += graph.uses[u].feedback ? 1 : 0;
      parts += isWhole(graph.uses[u], graph.resources[graph.uses[u].resource]) ? 0 : 1;
    }
  }
};

}  // namespace

TEST_CASE("the random graphs reach every kind of case") {
  Coverage c;
  for (std::uint64_t seed = 1; seed <= kPropertyGraphs; ++seed) c.add(randomGraph(seed).compiled());
  MESSAGE("sliced " << c.sliced << ", shared " << c.shared << ", overlapping arenas " << c.overlapping
                    << ", histories " << c.histories << ", persistent " << c.persistent << ", split clears "
                    << c.splitClears << ", feedback " << c.feedback << ", parts " << c.parts);
  for (const std::size_t n :
       {c.sliced, c.shared, c.overlapping, c.histories, c.persistent, c.splitClears, c.feedback, c.parts})
    CHECK(n > kPropertyGraphs / 25);
}

TEST_CASE("no hazard is left under any cadence, and there are no redundant barrier bits") {
  std::size_t bits = 0, steps = 0, byCadenceOnly = 0, ofSliced = 0, failures = 0;
  const auto judge = [&](const Plan& plan, std::uint64_t seed, std::size_t samples, const char* how) {
    const oracle::Verdict verdict = oracle::judgeBarriers(plan, seed, samples);
    bits += verdict.bits;
    steps += plan.steps.size();
    (plan.groups.ofResource.empty() ? byCadenceOnly : ofSliced) += verdict.byCadenceOnly;
    const bool excused = verdict.byCadenceOnly == 0 || turnsNowAndThen(plan);
    if ((!verdict.problem.empty() || !excused) && ++failures < 10)
      FAIL_CHECK("graph " << seed << how << ": " << verdict.problem);
  };
  for (std::uint64_t seed = 1; seed <= kPropertyGraphs; ++seed) {
    const FlatBuilder b = randomGraph(seed);
    judge(b.compiled(), seed, 24, "");
    judge(b.compiled({.share = true, .orderSeed = seed}), seed, 6, " reordered");
    if (seed % 4 == 0) judge(b.compiled({.share = false}), seed, 6, " unshared");
  }
  CHECK(failures == 0);
  MESSAGE(kPropertyGraphs << " graphs, " << steps << " steps, " << bits << " bits, " << byCadenceOnly
                          << " by cadence only, " << ofSliced
                          << " by frames in which a time-sliced group does not publish");
  CHECK(bits > kPropertyGraphs * 8);  // the graphs do need barriers
  CHECK(byCadenceOnly * 1000 < bits);
  CHECK(ofSliced * 500 < bits);
}

TEST_CASE("liveness, order and storage agree with slow second opinions") {
  std::size_t failures = 0;
  const auto check = [&](const std::string& problem, std::uint64_t seed) {
    if (!problem.empty() && ++failures < 10) FAIL_CHECK("graph " << seed << ": " << problem);
  };
  for (std::uint64_t seed = 1; seed <= kPropertyGraphs; ++seed) {
    const FlatBuilder b = randomGraph(seed);
    const Plan plan = b.compiled(), other = b.compiled({.share = true, .orderSeed = seed});
    check(checks::checkLiveness(plan), seed);
    check(checks::checkOrder(plan), seed);
    check(checks::checkOrder(other), seed);
    check(checks::checkStorage(plan), seed);
    check(checks::checkStorage(other), seed);
  }
  CHECK(failures == 0);
}

TEST_CASE("any legal order, shared or not, shows what the graph means") {
  std::size_t failures = 0;
  for (std::uint64_t seed = 1; seed <= kPropertyGraphs; ++seed) {
    const FlatBuilder b = randomGraph(seed);
    for (const CompileOptions options :
         {CompileOptions{true, 0}, CompileOptions{true, seed}, CompileOptions{true, ~seed},
          CompileOptions{false, 0}, CompileOptions{false, seed}}) {
      const Plan plan = b.compiled(options);
      if (replay::showPlanned(plan, 4) != replay::showDeclared(plan, 4) && ++failures < 10)
        FAIL_CHECK("graph " << seed << ", share " << options.share << ", order " << options.orderSeed);
    }
  }
  CHECK(failures == 0);
}
