// Liveness: what keeps a pass and what does not.
#include <doctest/doctest.h>

#include "tests/graph/compile/flat_builder.h"

using namespace weft::graph;

TEST_CASE("culling reaches through every level of dead passes") {
  FlatBuilder b = emptyGraph();
  std::uint32_t chain[5];
  for (auto& t : chain) t = b.texture("dead");
  const auto shown = b.texture("shown");
  b.pass("d0").write(chain[0]);
  for (int i = 1; i < 5; ++i) b.pass("d" + std::to_string(i)).read(chain[i - 1]).write(chain[i]);
  b.pass("show").write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(orderOf(plan) == "show");
  CHECK(plan.storages.size() == 1);  // no storage for what only culled passes touch
  for (const auto t : chain) CHECK(plan.storageOf[t] == kNone);
  CHECK(plan.bytesAllocated == 64 * 64 * 4);
}

TEST_CASE("a reader that has only a side effect keeps what it reads alive, to its own step") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), c = b.texture("c"), shown = b.texture("shown");
  b.pass("make").write(a);
  b.pass("other").write(c);
  b.pass("log").read(a).sideEffect();
  b.pass("show").read(c).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(orderOf(plan) == "make other log show");
  CHECK(plan.lastStep[a] == 2);
  CHECK(plan.storageOf[a] != plan.storageOf[c]);
  CHECK(plan.storageOf[a] == plan.storageOf[shown]);  // free again after its last reader
}

TEST_CASE("outputs nobody reads are not attached, unless they are kept") {
  FlatBuilder b = emptyGraph();
  const auto color = b.texture("color"), velocity = b.texture("velocity"), depth = b.texture("depth");
  b.pass("draw").write(color).write(velocity).write(depth).keep().present(color);
  const Plan plan = b.compiled();
  CHECK(plan.attached == std::vector<std::uint8_t>{1, 0, 1});
  CHECK(plan.firstStep[velocity] == kNone);
  CHECK(plan.firstStep[depth] == 0);
  CHECK(plan.lastStep[depth] == 0);
}

TEST_CASE("a kept output does not keep its pass") {
  FlatBuilder b = emptyGraph();
  const auto depth = b.texture("depth"), shown = b.texture("shown");
  b.pass("draw").write(depth).keep();
  b.pass("show").write(shown).present(shown);
  CHECK(orderOf(b.compiled()) == "show");
}

TEST_CASE("modify needs what was there, only when its own result is needed") {
  FlatBuilder b = emptyGraph();
  const auto hdr = b.texture("hdr"), shown = b.texture("shown");
  b.pass("sky").write(hdr);
  b.pass("spheres").modify(hdr);
  b.pass("overlay").modify(hdr);  // nobody reads its version
  b.pass("show").write(shown).present(shown);
  CHECK(orderOf(b.compiled()) == "show");
  b.graph.passes.back().useCount++;
  b.graph.uses.push_back(b.whole(hdr, Kind::sampled, Access::read));
  CHECK(orderOf(b.compiled()) == "sky spheres overlay show");
}

TEST_CASE("an overwritten version is dead; its reader before that is not") {
  FlatBuilder b = emptyGraph();
  const auto t = b.texture("t"), u = b.texture("u"), shown = b.texture("shown");
  b.pass("first").write(t);
  b.pass("copy").read(t).write(u);
  b.pass("second").write(t);
  b.pass("show").read(t).write(shown).present(shown);
  CHECK(orderOf(b.compiled()) == "second show");
}

TEST_CASE("versions are tracked per sub-resource") {
  FlatBuilder b = emptyGraph();
  const auto glow = b.texture("glow", Format::rgba8, 64, 3), shown = b.texture("shown");
  b.pass("m0").mip(glow, 0, Kind::color, Access::write);
  b.pass("m1").mip(glow, 0, Kind::sampled, Access::read).mip(glow, 1, Kind::color, Access::write);
  b.pass("m2").mip(glow, 1, Kind::sampled, Access::read).mip(glow, 2, Kind::color, Access::write);
  b.pass("show").mip(glow, 1, Kind::sampled, Access::read).write(shown).present(shown);
  CHECK(orderOf(b.compiled()) == "m0 m1 show");
}

TEST_CASE("a history lives when a live pass reads an earlier publication, and never through itself") {
  FlatBuilder b = emptyGraph();
  const auto h = b.texture("h"), shown = b.texture("shown");
  b.resource(h).history = 1;
  b.pass("accumulate").read(h, Kind::sampled, 1).write(h);
  b.pass("show").write(shown).present(shown);
  CHECK(orderOf(b.compiled()) == "show");
  b.graph.passes.back().useCount++;
  FlatUse past = b.whole(h, Kind::sampled, Access::read);
  past.history = 1;
  b.graph.uses.push_back(past);
  const Plan plan = b.compiled();
  CHECK(orderOf(plan) == "accumulate show");
  CHECK(plan.persistent[h] == 1);
  CHECK(plan.storages[plan.storageOf[h]].copies == 2);
}

TEST_CASE("a long chain of histories is followed to its end") {
  // Each link reads the past of the next one, declared after it: a single backward sweep would find one link
  // only.
  constexpr int kLinks = 2000;
  FlatBuilder b = emptyGraph();
  const auto shown = b.texture("shown");
  std::vector<std::uint32_t> h;
  for (int i = 0; i < kLinks; ++i) {
    h.push_back(b.texture("h" + std::to_string(i), Format::r8, 1));
    b.resource(h.back()).history = 1;
  }
  b.pass("show").read(h[0], Kind::sampled, 1).write(shown).present(shown);
  for (int i = 0; i < kLinks; ++i) {
    b.pass("link");
    if (i + 1 < kLinks) b.read(h[static_cast<std::size_t>(i) + 1], Kind::sampled, 1);
    b.write(h[static_cast<std::size_t>(i)]);
  }
  CHECK(b.compiled().steps.size() == kLinks + 1);
}

TEST_CASE(
    "what is presented or an output, and written by nobody, is cleared with the first use of its texture") {
  for (const bool presented : {true, false}) {
    FlatBuilder b = emptyGraph();
    const auto pyramid = b.texture("pyramid", Format::rgba8, 64, 2), shown = b.texture("shown");
    b.resource(pyramid).hasClear = true;
    b.pass("a").mip(pyramid, 1, Kind::color, Access::write);
    b.pass("b").mip(pyramid, 1, Kind::sampled, Access::read).write(shown);
    b.output(shown);
    presented ? b.present(pyramid) : b.output(pyramid);
    const Plan plan = b.compiled();
    REQUIRE(plan.steps.size() == 2);
    CHECK(plan.steps[0].clearCount == 2);
    CHECK(plan.lastStep[pyramid] == plan.steps.size());
  }
}

TEST_CASE("an output is a reader at the end of the frame") {
  FlatBuilder b = emptyGraph();
  const auto alone = b.texture("alone"), live = b.texture("live"), later = b.texture("later"),
             shown = b.texture("shown");
  b.pass("a").write(alone);
  b.pass("b").write(live);
  b.pass("c").read(live).write(later);
  b.pass("d").read(later).write(shown).present(shown);
  b.output(alone).output(live);
  const Plan plan = b.compiled();
  CHECK(orderOf(plan) == "a b c d");
  CHECK(plan.outputLive == std::vector<std::uint8_t>{1, 1});
  CHECK(plan.lastStep[alone] == plan.steps.size());
  CHECK(plan.lastStep[live] == plan.steps.size());
  CHECK(plan.storageOf[live] != plan.storageOf[shown]);
}
