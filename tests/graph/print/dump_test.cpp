// Dumps and explanations: the canonical text as a golden, the same bytes every time, and a reason for
// everything.
#include <doctest/doctest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "engine/graph/compile/compile.h"
#include "engine/graph/print/print.h"
#include "engine/text/json/edit.h"
#include "tests/graph/compile/random_graph.h"

using namespace weft::graph;

namespace {

FlatBuilder exampleGraph() {
  FlatBuilder b = emptyGraph();
  b.graph.name = "example";
  const auto lut = b.texture("lut", Format::rg16f, 32), hdr = b.texture("hdr", Format::rgba16f),
             glow = b.texture("glow", Format::rgba16f, 32, 2);
  const auto histogram = b.buffer("histogram", 1024), exposure = b.buffer("exposure", 16);
  const auto ldr = b.texture("ldr"), velocity = b.texture("velocity", Format::rg16f),
             smooth = b.texture("smooth", Format::r32f);
  b.resource(hdr).hasClear = b.resource(histogram).hasClear = true;
  b.resource(exposure).history = 1;
  b.pass("bake", Cadence::once).write(lut, Kind::image);
  b.pass("draw").read(lut).modify(hdr).write(velocity);
  b.pass("count").read(hdr).modify(histogram, Kind::storage);
  b.pass("adapt")
      .read(histogram, Kind::storage)
      .read(exposure, Kind::storage, 1)
      .write(exposure, Kind::storage);
  b.pass("down").read(hdr).mip(glow, 1, Kind::image, Access::write);
  b.pass("blur").read(velocity).write(velocity);
  b.pass("tone").read(hdr).read(exposure, Kind::uniform).mip(glow, 1, Kind::sampled, Access::read).write(ldr);
  b.pass("fxaa").read(ldr).write(smooth).present(smooth).output(exposure);
  return b;
}

constexpr const char* kGolden = R"(plan example
passes 8 run 7
bytes declared 80928 allocated 80928 lower_bound 80928 arena 1024 bound 194608

order
  0 bake update once
    barrier image_access
    write image lut
  1 draw
    barrier texture_fetch
    clear hdr
    read sampled lut
    modify color hdr
    write color velocity (not attached: nobody reads it)
    framebuffer 64x64 color hdr
  2 count
    clear histogram
    barrier_after_clears shader_storage
    read sampled hdr
    modify storage histogram
  3 adapt
    barrier shader_storage
    read storage histogram
    read storage exposure@-1
    write storage exposure
  4 down
    read sampled hdr
    write image glow.mip[1]
  5 tone
    barrier uniform texture_fetch
    read sampled hdr
    read uniform exposure
    read sampled glow.mip[1]
    write color ldr
    framebuffer 64x64 color ldr
  6 fxaa
    read sampled ldr
    write color smooth
    framebuffer 64x64 color smooth
  end
    barrier buffer_update
    present smooth
    output exposure exposure

textures
  0 2d 32x32 rg16f persistent bytes 4096
    0..1 lut
  1 2d 64x64 rgba16f bytes 32768
    1..5 hdr
  2 2d 32x32 rgba16f mips 2 bytes 10240
    4..5 glow
  3 2d 64x64 rgba8 bytes 16384
    5..6 ldr
  4 2d 64x64 r32f bytes 16384
    6..end smooth

buffers
  histogram 2..3 offset 0 bytes 1024
  exposure 3..end persistent copies 2 bytes 16

culled
  blur
)";

}  // namespace

TEST_CASE("the canonical text of a plan") {
  CHECK(dumpText(exampleGraph().compiled()) == kGolden);
}

TEST_CASE("equal graphs give equal plans, byte for byte") {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const FlatBuilder b = randomGraph(seed);
    const auto graph = b.linked();
    const Plan fresh = b.compiled(), again = compile(graph);
    CHECK(dumpText(fresh) == dumpText(again));
    CHECK(dumpText(fresh, true) == dumpText(again, true));
    CHECK(fresh.attached == again.attached);
    CHECK(fresh.bufferOffsetOf == again.bufferOffsetOf);
    CHECK(dumpText(compile(graph, {true, seed})) == dumpText(b.compiled({true, seed})));
  }
}

TEST_CASE("every barrier bit has its two accesses, and one of them stores") {
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    const Plan plan = randomGraph(seed).compiled();
    std::vector<std::array<std::uint16_t, 2>> explained(plan.steps.size() + 1);
    for (const BarrierReason& reason : explainBarriers(plan)) {
      explained[reason.step][reason.afterClears ? 1 : 0] |= reason.bit;
      const auto stores = [](const BarrierAccess& access) {
        return !access.clear && access.pass != kNone && access.use.access != Access::read &&
               (access.use.kind == Kind::image || access.use.kind == Kind::storage);
      };
      CHECK((stores(reason.before) || stores(reason.after)));
    }
    for (std::size_t step = 0; step < plan.steps.size(); ++step) {
      CHECK(explained[step][0] == plan.steps[step].barriers);
      CHECK(explained[step][1] == plan.steps[step].barriersAfterClears);
    }
    CHECK(explained.back()[0] == plan.finalBarriers);
  }
}

TEST_CASE("passes and storage are explained") {
  const Plan plan = exampleGraph().compiled();
  const Explainer explainer(plan);
  CHECK(explainer.whyPass(0) == "runs: 'draw' reads 'lut'");
  CHECK(explainer.whyPass(3) == "runs: 'tone' reads 'exposure'");
  CHECK(explainer.whyPass(5) == "culled: nothing reads 'velocity'");
  CHECK(explainer.whyPass(7) == "runs: 'smooth' is presented");
  CHECK(explainer.whyHere(2) == "after 'draw' (reads its 'hdr')");
  CHECK(explainer.whyStorage(0) == "its own: 'bake' does not write it in every frame");
  CHECK(explainer.whyStorage(4) == "its own: history of 1 needs 2 copies");
  CHECK(explainer.whyStorage(6) == "none: no live pass touches it");
}

TEST_CASE("a culled pass says who overwrote it or who was culled with it") {
  FlatBuilder b = emptyGraph();
  const auto t = b.texture("t"), u = b.texture("u"), v = b.texture("v");
  b.pass("first").write(t);
  b.pass("second").write(t);
  b.pass("third").read(t).write(u);
  b.pass("show").write(v).present(v);
  const Plan plan = b.compiled();
  const Explainer explainer(plan);
  CHECK(explainer.whyPass(0) == "culled: 'second' overwrites 't' before anything reads it");
  CHECK(explainer.whyPass(1) == "culled: 't' is read only by culled passes, 'third' first");
  CHECK(explainer.whyPass(2) == "culled: nothing reads 'u'");
}

TEST_CASE("the JSON form is JSON and carries the plan") {
  const auto json = weft::text::loadJson(dumpJson(exampleGraph().compiled(), true));
  CHECK(json["steps"].size() == 7);
  CHECK(json["culled"][0]["pass"] == "blur");
  CHECK(json["steps"][2]["barriers_after_clears"][0] == "shader_storage");
  CHECK_FALSE(json["steps"][1]["why"].get<std::string>().empty());
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
    CHECK_FALSE(weft::text::loadJson(dumpJson(randomGraph(seed).compiled(), true)).is_discarded());
}

TEST_CASE(
    "the DOT form names every pass once, quotes what needs it, grays what is culled, has a node for each "
    "version") {
  FlatBuilder b = exampleGraph();
  b.graph.passNames[1] = "draw \"it\"";
  const std::string dot = dumpDot(b.compiled());
  CHECK(dot.find("digraph \"example\" {") == 0);
  CHECK(dot.find("draw \\\"it\\\"") != std::string::npos);
  CHECK(dot.find("label=\"blur\", shape=box, style=filled, fillcolor=gray93") != std::string::npos);
  CHECK(dot.find("style=dashed") != std::string::npos);
  CHECK(dot.find("-> \":present\"") != std::string::npos);
  for (std::string& name : b.graph.passNames) name = "effect." + name;
  const std::string effects = dumpDot(b.compiled(), true);
  CHECK(effects.find(fmt::format("label=\"effect x{}\"", b.compiled().steps.size())) != std::string::npos);
  CHECK(effects.find("blur") == std::string::npos);
  CHECK(dot.substr(dot.size() - 2) == "}\n");
}
