// The judges can fail: plans with a deliberate mistake are caught.
#include <doctest/doctest.h>

#include "tests/graph/compile/hazard_oracle.h"
#include "tests/graph/compile/plan_checks.h"
#include "tests/graph/compile/random_graph.h"
#include "tests/graph/compile/replay.h"

using namespace weft::graph;

namespace {
constexpr std::uint64_t kGraphs = 300;
}

TEST_CASE("a plan without barriers, or with one bit less, is caught") {
  std::size_t bare = 0, caught = 0, mutants = 0, mutantsCaught = 0;
  for (std::uint64_t seed = 1; seed <= kGraphs; ++seed) {
    const Plan plan = randomGraph(seed).compiled();
    std::vector<Plan> dropped = oracle::withoutOneBit(plan);
    if (!plan.groups.ofResource.empty()) dropped.clear();  // their bits may be redundant, see hazards.cpp
    for (const Plan& mutant : dropped) {
      ++mutants;
      mutantsCaught += oracle::findHazard(mutant, oracle::everythingRuns(plan)).empty() ? 0 : 1;
    }
    if (dropped.empty()) continue;
    Plan none = plan;
    for (Step& step : none.steps) step.barriers = step.barriersAfterClears = 0;
    none.finalBarriers = 0;
    ++bare;
    caught += oracle::findHazard(none, oracle::everythingRuns(plan)).empty() ? 0 : 1;
  }
  CHECK(bare > kGraphs / 2);
  CHECK(caught == bare);
  CHECK(mutants > kGraphs * 5);
  CHECK(mutantsCaught == mutants);
}

TEST_CASE("two storages that are alive at once and made one are caught") {
  std::size_t merged = 0, seenByChecks = 0, seenInThePicture = 0;
  for (std::uint64_t seed = 1; seed <= kGraphs; ++seed) {
    const Plan plan = randomGraph(seed).compiled();
    const FlatGraph& graph = *plan.graph;
    for (std::uint32_t r = 0; r < graph.resources.size(); ++r)
      for (std::uint32_t q = 0; q < r; ++q) {
        if (plan.storageOf[r] == kNone || plan.storageOf[q] == kNone ||
            plan.persistent[r] + plan.persistent[q] != 0)
          continue;
        const Storage &a = plan.storages[plan.storageOf[r]], &c = plan.storages[plan.storageOf[q]];
        if (plan.storageOf[r] == plan.storageOf[q] || a.width != c.width || a.mips != c.mips ||
            a.layers != c.layers || infoOf(a.format).viewClass != infoOf(c.format).viewClass ||
            plan.firstStep[r] > plan.lastStep[q] || plan.firstStep[q] > plan.lastStep[r])
          continue;
        Plan mutant = plan;
        mutant.storageOf[r] = plan.storageOf[q];
        ++merged;
        seenByChecks += checks::checkStorage(mutant).empty() ? 0 : 1;
        seenInThePicture += replay::showPlanned(mutant, 3) != replay::showDeclared(mutant, 3) ? 1 : 0;
      }
  }
  CHECK(merged > 50);
  CHECK(seenByChecks == merged);
  CHECK(seenInThePicture * 4 > merged);  // the rest are masked: nobody looks at what was overwritten
}

TEST_CASE("buffers moved onto each other are caught") {
  std::size_t moved = 0, caught = 0;
  for (std::uint64_t seed = 1; seed <= kGraphs; ++seed) {
    const Plan plan = randomGraph(seed).compiled();
    for (std::uint32_t r = 0; r < plan.graph->resources.size(); ++r) {
      if (plan.bufferOffsetOf[r] == Plan::kNoOffset || plan.bufferOffsetOf[r] == 0) continue;
      Plan mutant = plan;
      mutant.bufferOffsetOf[r] -= 256;
      const bool overlaps = !checks::checkStorage(mutant).empty();
      moved += 1;
      caught += overlaps ? 1 : 0;
    }
  }
  CHECK(moved > 50);
  CHECK(caught * 2 > moved);  // the others moved onto bytes that were free by then
}

TEST_CASE("a step out of its order and a clear left out are caught") {
  std::size_t swapped = 0, caught = 0, cleared = 0, missed = 0;
  for (std::uint64_t seed = 1; seed <= kGraphs; ++seed) {
    const Plan plan = randomGraph(seed).compiled();
    for (std::size_t t = 1; t < plan.steps.size(); ++t) {
      Plan mutant = plan;
      std::swap(mutant.steps[t - 1], mutant.steps[t]);
      for (std::uint32_t i = 0; i < mutant.steps.size(); ++i) mutant.stepOf[mutant.steps[i].pass] = i;
      ++swapped;
      caught += checks::checkOrder(mutant).empty() ? 0 : 1;
    }
    for (std::size_t t = 0; t < plan.steps.size(); ++t) {
      if (plan.steps[t].clearCount == 0) continue;
      Plan mutant = plan;
      mutant.steps[t].clearCount = 0;
      ++cleared;
      missed += replay::showPlanned(mutant, 3) == replay::showDeclared(mutant, 3) ? 1 : 0;
    }
  }
  CHECK(swapped > 200);
  CHECK(caught * 5 > swapped);  // neighbors that do not depend on each other may swap
  CHECK(cleared > 50);
  CHECK(missed * 2 < cleared);
}
