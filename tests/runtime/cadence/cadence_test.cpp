#include "engine/runtime/cadence/cadence.h"

#include <doctest/doctest.h>

#include <memory>

#include "engine/graph/compile/compile.h"
#include "engine/graph/versions/versions.h"

using namespace weft::graph;
using weft::runtime::FrameCadence;

namespace {

struct Builder {
  std::shared_ptr<FlatGraph> graph = std::make_shared<FlatGraph>();

  std::uint32_t resource(std::uint8_t history = 0) {
    FlatResource r;
    r.format = Format::rgba16f;
    r.bytes = 8;
    r.history = history;
    graph->resources.push_back(r);
    graph->resourceNames.push_back("r" + std::to_string(graph->resources.size()));
    return static_cast<std::uint32_t>(graph->resources.size() - 1);
  }
  void pass(Cadence cadence, std::vector<std::pair<std::uint32_t, Access>> uses) {
    FlatPass p;
    p.cadence = cadence;
    p.firstUse = static_cast<std::uint32_t>(graph->uses.size());
    p.useCount = static_cast<std::uint32_t>(uses.size());
    for (const auto& [r, access] : uses)
      graph->uses.push_back(
          {.resource = r, .kind = access == Access::read ? Kind::sampled : Kind::color, .access = access});
    graph->passes.push_back(p);
    graph->passNames.push_back("p" + std::to_string(graph->passes.size()));
  }
  Plan compile(std::uint32_t present) {
    graph->present = {.resource = present};
    linkVersions(*graph);
    return weft::graph::compile(graph);
  }
};

// Runs a frame: what ran, with generations of written resources moved on.
std::vector<int> runFrame(FrameCadence& cadence, const Plan& plan, std::vector<std::uint64_t>& own,
                          std::vector<std::uint64_t>& generations) {
  cadence.decide(own, generations);
  const std::vector<std::uint64_t> before = generations;
  std::vector<int> ran;
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    ran.push_back(cadence.runs(s));
    if (!cadence.runs(s)) continue;
    const FlatPass& pass = plan.graph->passes[plan.steps[s].pass];
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
      if (plan.graph->uses[u].access != Access::read) ++generations[plan.graph->uses[u].resource];
  }
  cadence.endFrame(own, before, generations);
  return ran;
}

std::size_t countRunning(const FrameCadence& cadence, const Plan& plan) {
  std::size_t running = 0;
  for (std::size_t s = 0; s < plan.steps.size(); ++s) running += cadence.runs(s);
  return running;
}

constexpr auto kAlways = Cadence::always;
constexpr auto kOnce = Cadence::once;
constexpr auto kOnChange = Cadence::on_change;
constexpr auto kEvery = Cadence::every;

}  // namespace

TEST_CASE("once runs once, on_change runs when its input or its own hash changes") {
  Builder b;
  const auto table = b.resource(), map = b.resource(), picture = b.resource();
  b.pass(kOnce, {{table, Access::write}});
  b.pass(kOnChange, {{table, Access::read}, {map, Access::write}});
  b.pass(kAlways, {{map, Access::read}, {picture, Access::write}});
  const Plan plan = b.compile(picture);
  FrameCadence cadence(plan);
  std::vector<std::uint64_t> own(3, 1), generations(3, 1);
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{1, 1, 1});
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{0, 0, 1});
  own[1] = 2;  // a parameter
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{0, 1, 1});
  own[0] = 2;  // the once pass's storage was made anew: its reader follows in the same frame
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{1, 1, 1});
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{0, 0, 1});
}

TEST_CASE("a chain of on_change passes wakes in one frame") {
  Builder b;
  const auto a = b.resource(), c = b.resource(), d = b.resource();
  b.pass(kOnChange, {{a, Access::write}});
  b.pass(kOnChange, {{a, Access::read}, {c, Access::write}});
  b.pass(kOnChange, {{c, Access::read}, {d, Access::write}});
  const Plan plan = b.compile(d);
  FrameCadence cadence(plan);
  std::vector<std::uint64_t> own(3, 1), generations(3, 1);
  runFrame(cadence, plan, own, generations);
  own[0] = 9;
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{1, 1, 1});
}

TEST_CASE("writers that build one resource by modify run all or none") {
  Builder b;
  const auto map = b.resource(), other = b.resource();
  b.pass(kOnChange, {{map, Access::write}});
  b.pass(kOnChange, {{map, Access::modify}});
  b.pass(kAlways, {{map, Access::read}, {other, Access::write}});
  const Plan plan = b.compile(other);
  FrameCadence cadence(plan);
  std::vector<std::uint64_t> own(3, 1), generations(2, 1);
  runFrame(cadence, plan, own, generations);
  own[1] = 5;  // only the second writer changed: the first must lay the ground again
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{1, 1, 1});
}

TEST_CASE("a pass that reads one level of what it writes the others of does not wake itself") {
  Builder b;
  const auto sky = b.resource(), map = b.resource(), picture = b.resource();
  b.graph->resources[sky].mips = 3;
  b.pass(kOnChange, {{sky, Access::write}});
  b.pass(kOnChange, {{sky, Access::read}, {sky, Access::write}});
  b.pass(kOnChange, {{sky, Access::read}, {map, Access::write}});
  b.pass(kAlways, {{map, Access::read}, {picture, Access::write}});
  b.graph->uses[2].mip = 1;  // the second pass writes levels 1 and 2
  b.graph->uses[2].mips = 2;
  b.graph->uses[3].mips = 3;
  const Plan plan = b.compile(picture);
  FrameCadence cadence(plan);
  std::vector<std::uint64_t> own(4, 1), generations(3, 1);
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{1, 1, 1, 1});
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{0, 0, 0, 1});
  own[0] = 2;
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{1, 1, 1, 1});
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{0, 0, 0, 1});
}

TEST_CASE("an on_change pass that reads history runs after each publication, and once more for the last") {
  Builder b;
  const auto sum = b.resource(1), copy = b.resource(), picture = b.resource();
  b.pass(kOnChange, {{sum, Access::write}});
  b.pass(kOnChange, {{sum, Access::read}, {copy, Access::write}});
  b.pass(kAlways, {{sum, Access::read}, {copy, Access::read}, {picture, Access::write}});
  b.graph->uses[1].history = 1;
  const Plan plan = b.compile(picture);
  FrameCadence cadence(plan);
  std::vector<std::uint64_t> own(3, 1), generations(3, 1);
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{1, 1, 1});
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{0, 1, 1});
  CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{0, 0, 1});
}

namespace {

// A frame of a plan with time-sliced groups: "2:1/3 4" is slice 1 of 3 of step 2, and all of step 4.
std::string runSlices(FrameCadence& cadence, const Plan& plan, const std::vector<std::uint64_t>& own,
                      std::vector<std::uint64_t>& generations) {
  for (std::uint32_t group = 0; group < plan.groups.sliced.size(); ++group) {
    if (!cadence.isFinished(group)) continue;
    for (std::uint32_t r = 0; r < generations.size(); ++r)
      if (plan.groups.slicedWriterOf(r) == group) ++generations[r];
    cadence.markPublished(group);
  }
  cadence.decide(own, generations);
  const std::vector<std::uint64_t> before = generations;
  std::string ran;
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    if (!cadence.runs(s)) continue;
    const weft::runtime::SliceRange range = cadence.slices(s);
    ran += (ran.empty() ? "" : " ") + std::to_string(s);
    if (range.of > 1) ran += ":" + std::to_string(range.first) + "/" + std::to_string(range.of);
    const FlatPass& pass = plan.graph->passes[plan.steps[s].pass];
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      const std::uint32_t r = plan.graph->uses[u].resource;
      if (plan.graph->uses[u].access != Access::read && plan.groups.slicedWriterOf(r) == kNone)
        ++generations[r];
    }
  }
  cadence.endFrame(own, before, generations);
  return ran;
}

// source -> [a in 2, b in 1, c rides] -> reader, on_change -> picture, always
struct SlicedGraph {
  Builder b;
  Plan plan;
  std::vector<std::uint64_t> own = std::vector<std::uint64_t>(6, 1),
                             generations = std::vector<std::uint64_t>(6, 1);

  explicit SlicedGraph(Cadence cadence = kOnChange) {
    for (int i = 0; i < 6; ++i) b.resource();
    b.pass(kOnce, {{0, Access::write}});
    b.pass(cadence, {{0, Access::read}, {1, Access::write}});
    b.pass(cadence, {{1, Access::read}, {2, Access::write}});
    b.pass(cadence, {{2, Access::read}, {3, Access::write}});
    b.pass(kOnChange, {{3, Access::read}, {4, Access::write}});
    b.pass(kAlways, {{1, Access::read}, {4, Access::read}, {5, Access::write}});
    b.graph->passes[1].slices = 2;
    b.graph->passes[2].slices = 0;
    b.graph->passes[3].slices = 2;
    plan = b.compile(5);
  }
};

}  // namespace

TEST_CASE("slices: one per frame in order, riders with the one before, readers wait for the publication") {
  SlicedGraph g;
  FrameCadence cadence(g.plan);
  CHECK(g.plan.copiesOf(1) == 2);
  CHECK(g.plan.copiesOf(4) == 1);
  const auto frame = [&] { return runSlices(cadence, g.plan, g.own, g.generations); };
  CHECK(frame() == "0 1:0/2 5");
  CHECK(frame() == "1:1/2 2 5");
  CHECK(frame() == "3:0/2 5");
  CHECK(frame() == "3:1/2 5");
  CHECK(frame() == "4 5");
  CHECK(frame() == "5");
  g.own[2] = 9;  // a parameter of one of them: all of them again
  CHECK(frame() == "1:0/2 5");
  CHECK(frame() == "1:1/2 2 5");
  g.own[0] = 9;  // an input is made anew: from the start
  CHECK(frame() == "0 1:0/2 5");
  CHECK(frame() == "1:1/2 2 5");
  CHECK(frame() == "3:0/2 5");
  CHECK(frame() == "3:1/2 5");
  g.own[3] = 9;  // what is finished is published, whatever changed since
  CHECK(frame() == "1:0/2 4 5");
}

TEST_CASE("slices: once takes no notice of inputs, unless it is under way") {
  SlicedGraph g(kOnce);
  FrameCadence cadence(g.plan);
  const auto frame = [&] { return runSlices(cadence, g.plan, g.own, g.generations); };
  CHECK(frame() == "0 1:0/2 5");
  g.own[0] = 2;
  CHECK(frame() == "0 1:0/2 5");
  CHECK(frame() == "1:1/2 5");
  CHECK(frame() == "2 3:0/2 5");  // `once` passes publish one after the other
  CHECK(frame() == "3:1/2 5");
  CHECK(frame() == "4 5");
  g.own[0] = 3;
  CHECK(frame() == "0 5");
  g.own[1] = 3;  // its storage was made anew
  CHECK(frame() == "1:0/2 5");
}

TEST_CASE(
    "slices: ahead of a headless frame a group runs whole, and nothing runs when there is nothing to do") {
  SlicedGraph g;
  FrameCadence cadence(g.plan);
  REQUIRE(cadence.decideAhead(g.own, g.generations));
  CHECK(countRunning(cadence, g.plan) == 4);  // what it reads, and itself
  CHECK_FALSE(cadence.runs(4));
  CHECK_FALSE(cadence.runs(5));
  cadence.endFrame(g.own, g.generations, g.generations);
  CHECK(cadence.isFinished(0));
  cadence.markPublished(0);
  CHECK_FALSE(cadence.decideAhead(g.own, g.generations));
  CHECK(countRunning(cadence, g.plan) == 0);
  CHECK(runSlices(cadence, g.plan, g.own, g.generations) == "4 5");
}

TEST_CASE("every(3) runs in frames 0, 3, 6, and where its storage is new; what follows it runs with it") {
  Builder b;
  const auto world = b.resource(), light = b.resource(), shown = b.resource(), picture = b.resource();
  b.pass(kAlways, {{world, Access::write}});
  b.pass(kEvery, {{world, Access::read}, {light, Access::write}});
  b.graph->passes.back().period = 3;
  b.pass(kOnChange, {{light, Access::read}, {shown, Access::write}});
  b.pass(kAlways, {{shown, Access::read}, {picture, Access::write}});
  const Plan plan = b.compile(picture);
  CHECK(plan.persistent[light] == 1);
  FrameCadence cadence(plan);
  std::vector<std::uint64_t> own(4, 1), generations(4, 1);
  for (std::uint32_t frame = 0; frame < 9; ++frame) {
    CAPTURE(frame);
    if (frame == 4) own[1] = 2;
    cadence.beginFrame(frame);
    const int runs = frame % 3 == 0 || frame == 4;
    CHECK(runFrame(cadence, plan, own, generations) == std::vector<int>{1, runs, runs, 1});
  }
  FrameCadence late(plan);  // begins where it does not run: nothing is there yet
  late.beginFrame(5);
  CHECK(runFrame(late, plan, own, generations) == std::vector<int>{1, 1, 1, 1});
}
