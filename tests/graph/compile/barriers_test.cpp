// Barriers, rule by rule, in steady state (frames repeat: a conflict also runs from the end of a frame into
// the next).
#include <doctest/doctest.h>

#include "engine/graph/compile/steps.h"
#include "tests/graph/compile/flat_builder.h"
#include "tests/graph/compile/hazard_oracle.h"

using namespace weft::graph;

namespace {

// A store to `r` by the first pass, then one use of it; what the second pass must wait for.
std::uint16_t bitsBefore(Kind storeKind, Kind useKind, bool buffer, Access access = Access::read,
                         bool feedback = false) {
  FlatBuilder b = emptyGraph();
  const auto r = buffer ? b.buffer("r", 64) : b.texture("r"), shown = b.texture("shown");
  b.pass("store").write(r, storeKind);
  FlatUse use = b.whole(r, useKind, access);
  use.feedback = feedback;
  use.keep = true;
  b.pass("use").use(use).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(oracle::judgeBarriers(plan, 1).problem == "");
  return plan.steps.at(1).barriers;
}

}  // namespace

TEST_CASE("a use after a store waits for its own bit") {
  CHECK(bitsBefore(Kind::image, Kind::sampled, false) == kBarrierTexture);
  CHECK(bitsBefore(Kind::image, Kind::image, false) == kBarrierImage);
  CHECK(bitsBefore(Kind::image, Kind::copy, false) == kBarrierFramebuffer);
  CHECK(bitsBefore(Kind::image, Kind::color, false, Access::modify) == kBarrierFramebuffer);
  CHECK(bitsBefore(Kind::image, Kind::color, false, Access::modify, true) ==
        (kBarrierFramebuffer | kBarrierTexture));
  CHECK(bitsBefore(Kind::storage, Kind::storage, true) == kBarrierStorage);
  CHECK(bitsBefore(Kind::storage, Kind::uniform, true) == kBarrierUniform);
  CHECK(bitsBefore(Kind::storage, Kind::indirect, true) == kBarrierCommand);
  CHECK(bitsBefore(Kind::storage, Kind::copy, true) == kBarrierBufferUpdate);
  CHECK(bitsBefore(Kind::storage, Kind::sampled, true) == kBarrierTexture);
}

TEST_CASE("what is presented waits for the blit") {
  FlatBuilder b = emptyGraph();
  const auto shown = b.texture("shown");
  b.pass("store").write(shown, Kind::image).present(shown);
  CHECK(b.compiled().finalBarriers == kBarrierFramebuffer);
}

TEST_CASE("rendering and then sampling, image-loading or blitting needs no barrier") {
  for (const Kind kind : {Kind::sampled, Kind::image, Kind::copy}) {
    FlatBuilder b = emptyGraph();
    const auto r = b.texture("r"), shown = b.texture("shown");
    b.pass("draw").write(r);
    b.pass("use").read(r, kind).write(shown).present(shown);
    const Plan plan = b.compiled();
    for (const Step& step : plan.steps) CHECK(step.barriers == 0);
    CHECK(plan.finalBarriers == 0);
  }
}

TEST_CASE("a store waits for every earlier access, in the frame before too") {
  FlatBuilder b = emptyGraph();
  const auto r = b.texture("r"), shown = b.texture("shown");
  b.pass("store").write(r, Kind::image);
  b.pass("use").read(r).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.steps[0].barriers == kBarrierImage);  // the last frame's sampling of the same texture
  CHECK(plan.steps[1].barriers == kBarrierTexture);
}

TEST_CASE("present and read-back wait for stores") {
  FlatBuilder b = emptyGraph();
  const auto shown = b.texture("shown", Format::rgba8), data = b.buffer("data", 16);
  b.pass("store").write(shown, Kind::image).write(data, Kind::storage).keep().present(shown).output(data);
  b.graph.uses.back().keep = true;
  CHECK(b.compiled().finalBarriers == (kBarrierFramebuffer | kBarrierBufferUpdate));
}

TEST_CASE("barriers are merged and come as late as possible") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), c = b.texture("c"), idle = b.texture("idle"), shown = b.texture("shown");
  b.pass("a").write(a, Kind::image);
  b.pass("c").write(c, Kind::image);
  b.pass("idle").write(idle);
  b.pass("use").read(a).read(c).read(idle).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.steps[0].barriers == kBarrierImage);
  CHECK(plan.steps[1].barriers == 0);  // the barrier before "a" already waits for the last frame
  CHECK(plan.steps[2].barriers == 0);
  CHECK(plan.steps[3].barriers == kBarrierTexture);
}

TEST_CASE("one barrier serves all that wait for the same bit") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), x = b.texture("x"), y = b.texture("y"), shown = b.texture("shown");
  b.pass("a").write(a, Kind::image);
  b.pass("x").read(a).write(x);
  b.pass("y").read(a).read(x).write(y);
  b.pass("show").read(a).read(y).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.steps[1].barriers == kBarrierTexture);
  CHECK(plan.steps[2].barriers == 0);
  CHECK(plan.steps[3].barriers == 0);
}

TEST_CASE("sub-resources do not wait for each other") {
  FlatBuilder b = emptyGraph();
  const auto pyramid = b.texture("pyramid", Format::rgba8, 64, 3), shown = b.texture("shown");
  b.pass("m0").mip(pyramid, 0, Kind::image, Access::write);
  b.pass("m1").mip(pyramid, 1, Kind::color, Access::write);
  b.pass("m2").mip(pyramid, 1, Kind::sampled, Access::read).mip(pyramid, 2, Kind::color, Access::write);
  b.pass("use").mip(pyramid, 0, Kind::sampled, Access::read).mip(pyramid, 2, Kind::sampled, Access::read);
  b.write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.steps[1].barriers == 0);
  CHECK(plan.steps[2].barriers == 0);
  CHECK(plan.steps[3].barriers == kBarrierTexture);
}

TEST_CASE("a store waits for the last user of the storage it takes over") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), m = b.texture("m", Format::rgba16f), c = b.texture("c"),
             shown = b.texture("shown");
  b.pass("a").write(a);
  b.pass("m").read(a).write(m);
  b.pass("c").read(m).write(c, Kind::image);
  b.pass("show").read(c).write(shown).present(shown);
  const Plan shared = b.compiled();
  REQUIRE(shared.storageOf[a] == shared.storageOf[c]);
  CHECK(shared.steps[2].barriers == kBarrierImage);
  // Rendering into storage that a shader stored to, in the frame before, waits as well.
  CHECK(shared.steps[0].barriers == kBarrierFramebuffer);
  const Plan apart = b.compiled({.share = false});
  CHECK(apart.steps[0].barriers == 0);
  CHECK(apart.steps[2].barriers == kBarrierImage);
}

TEST_CASE("buffers that overlap in the arena wait for each other, others do not") {
  FlatBuilder b = emptyGraph();
  const auto a = b.buffer("a", 512), c = b.buffer("c", 256), d = b.buffer("d", 256),
             shown = b.texture("shown");
  b.pass("a").write(a, Kind::copy);
  b.pass("c").read(a, Kind::uniform).write(c, Kind::copy);
  b.pass("d").read(c, Kind::uniform).write(d, Kind::storage);
  b.pass("show").read(d, Kind::uniform).write(shown).present(shown);
  const Plan plan = b.compiled();
  REQUIRE(plan.bufferOffsetOf[d] == plan.bufferOffsetOf[a]);
  CHECK(plan.steps[2].barriers == kBarrierStorage);
  CHECK(plan.steps[0].barriers == kBarrierBufferUpdate);  // copies over the bytes of last frame's d
  CHECK(plan.steps[1].barriers == 0);
}

TEST_CASE("a clear waits for stores, and a store waits for the clear just before it") {
  FlatBuilder b = emptyGraph();
  const auto histogram = b.buffer("histogram", 1024), shown = b.texture("shown");
  b.resource(histogram).hasClear = true;
  b.pass("count").modify(histogram, Kind::storage);
  b.pass("show").read(histogram, Kind::storage).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.steps[0].clearCount == 1);
  CHECK(plan.steps[0].barriers == kBarrierBufferUpdate);
  CHECK(plan.steps[0].barriersAfterClears == kBarrierStorage);
  CHECK(plan.steps[1].barriers == kBarrierStorage);
}

TEST_CASE("a history is waited for where it was published") {
  FlatBuilder b = emptyGraph();
  const auto h = b.texture("h"), shown = b.texture("shown");
  b.resource(h).history = 1;
  b.pass("show").read(h, Kind::sampled, 1).write(shown);
  b.pass("publish").read(shown).write(h, Kind::image).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.steps[0].barriers == kBarrierTexture);
  // The copy stored to was sampled in the frame before; the barrier may come no earlier than that frame's
  // end.
  CHECK((plan.steps[0].barriers | plan.steps[1].barriers) == (kBarrierTexture | kBarrierImage));
  CHECK(oracle::judgeBarriers(plan, 1).problem == "");
}

TEST_CASE(
    "what a time-sliced group stores is waited for by its own passes in the frame, by others from the frame "
    "before") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), sum = b.texture("sum"), shown = b.texture("shown");
  b.pass("slow", Cadence::on_change).write(a, Kind::image);
  b.graph.passes.back().slices = 4;
  b.pass("last", Cadence::on_change).read(a).write(sum, Kind::image);
  b.graph.passes.back().slices = 2;
  b.pass("show").read(sum).write(shown).present(shown);
  const Plan plan = b.compiled();
  REQUIRE(plan.groups.slicedWriterOf(a) != kNone);
  REQUIRE(plan.groups.slicedWriterOf(sum) == plan.groups.slicedWriterOf(a));
  // Each waits for stores of the frame before, of which there is none too many: `show` looks at another copy
  // of `sum` than `last` stores to. What `last` samples was stored in this frame.
  CHECK(plan.steps[0].barriers == kBarrierImage);
  CHECK(plan.steps[1].barriers == kBarrierTexture);
  CHECK(plan.steps[2].barriers == 0);
  const oracle::Verdict verdict = oracle::judgeBarriers(plan, 1);
  CHECK(verdict.problem == "");
  CHECK(verdict.bits == 2);
}

TEST_CASE("who writes what a time-sliced group writes or reads is of the group") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), mips = b.texture("mips", Format::rgba8, 64, 3), last = b.texture("last"),
             made = b.texture("made"), shown = b.texture("shown");
  b.pass("feeds", Cadence::on_change).write(a).mip(mips, 0, Kind::color, Access::write);
  b.pass("slow", Cadence::on_change).read(a).write(made);
  b.graph.passes.back().slices = 4;
  b.pass("one", Cadence::on_change).mip(mips, 1, Kind::color, Access::write);
  b.pass("two", Cadence::once).mip(mips, 2, Kind::color, Access::write).write(last);
  b.pass("free", Cadence::once).write(shown);
  b.pass("show").read(made).read(mips).read(last).modify(shown).present(shown);
  const Plan plan = b.compiled();
  for (const std::uint32_t p : {0u, 1u, 2u, 3u}) CHECK(plan.groups.groupOf(p) == 0);
  CHECK(plan.groups.groupOf(4) == kNone);
  for (const std::uint32_t r : {a, mips, last, made}) CHECK(plan.copiesOf(r) == 2);
  CHECK(plan.copiesOf(shown) == 1);
}

TEST_CASE("barriers stand whether or not a pass runs") {
  FlatBuilder b = emptyGraph();
  const auto lut = b.texture("lut"), a = b.texture("a"), shown = b.texture("shown");
  b.pass("bake", Cadence::on_change).write(lut, Kind::image);
  b.pass("tint", Cadence::on_change).read(lut).write(a);
  b.pass("show").read(lut).read(a).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.steps[1].barriers == kBarrierTexture);
  CHECK(plan.steps[2].barriers == 0);
  CHECK(oracle::judgeBarriers(plan, 1).problem == "");
}

TEST_CASE("the positions chosen on a circle leave nothing out and nothing over") {
  // Within the frame, across its end, and a whole circle.
  CHECK(chooseBarrierPositions({}, 10).empty());
  CHECK(chooseBarrierPositions({{2, 4}, {3, 5}, {6, 8}}, 10) == std::vector<std::int32_t>{4, 8});
  CHECK(chooseBarrierPositions({{-3, 1}, {2, 4}}, 10) == std::vector<std::int32_t>{1, 4});
  CHECK(chooseBarrierPositions({{-3, 1}, {2, 8}}, 10) ==
        std::vector<std::int32_t>{8});  // 8 is 7 of the frame before, and later
  CHECK(chooseBarrierPositions({{-9, 0}}, 10) == std::vector<std::int32_t>{0});
  // The crossing interval brings 3, which makes 4 superfluous.
  CHECK(chooseBarrierPositions({{-2, 3}, {2, 4}}, 10) == std::vector<std::int32_t>{3});
}

TEST_CASE("without stores nothing is planned and nothing is paid") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), c = b.texture("c");
  b.pass("a").write(a);
  b.pass("c").read(a, Kind::image).write(c).present(c);
  const Plan plan = b.compiled();
  for (const Step& step : plan.steps) CHECK((step.barriers | step.barriersAfterClears) == 0);
}
