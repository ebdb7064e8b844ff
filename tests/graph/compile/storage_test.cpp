// Lifetimes, clears, classes, sharing, the arena of buffers, and the bytes a plan reports.
#include <doctest/doctest.h>

#include "tests/graph/compile/flat_builder.h"

using namespace weft::graph;

TEST_CASE("storage is shared after the last of several users, not after the last in the list") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), x = b.texture("x"), y = b.texture("y"), z = b.texture("z"),
             shown = b.texture("shown");
  b.pass("make").write(a);
  b.pass("x").read(a).write(x);
  b.pass("y").read(a).read(x).write(y);
  b.pass("z").read(a).read(y).write(z);
  b.pass("show").read(z).write(shown).present(shown);
  const Plan plan = b.compiled();
  for (const auto t : {x, y, z}) CHECK(plan.storageOf[t] != plan.storageOf[a]);
  CHECK(plan.lastStep[a] == 3);
  CHECK(plan.storageOf[z] == plan.storageOf[x]);
  CHECK(plan.storages.size() == 3);
  CHECK(plan.bytesAllocated == plan.bytesLowerBound);
  CHECK(plan.bytesDeclared == 5 * 64 * 64 * 4);
}

TEST_CASE("what a pass reads and what it writes never share") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), c = b.texture("c");
  b.pass("make").write(a);
  b.pass("copy").read(a).write(c).present(c);
  const Plan plan = b.compiled();
  CHECK(plan.storageOf[a] != plan.storageOf[c]);
}

TEST_CASE("classes: view-compatible formats share, others do not") {
  const auto shares = [](auto&& change) {
    FlatBuilder b = emptyGraph();
    const auto a = b.texture("a"), m = b.texture("m", Format::rgba16f), c = b.texture("c");
    change(b.resource(a), b.resource(c));
    b.pass("a").write(a);
    b.pass("m").read(a).write(m);
    b.pass("c").read(m).write(c).present(c);
    const Plan plan = b.compiled();
    return plan.storageOf[a] == plan.storageOf[c];
  };
  CHECK(shares([](FlatResource&, FlatResource&) {}));
  CHECK(shares([](FlatResource& a, FlatResource&) { a.format = Format::r32f; }));
  CHECK(shares([](FlatResource& a, FlatResource&) { a.target = Target::texture_2d_array; }));
  CHECK_FALSE(shares([](FlatResource& a, FlatResource&) { a.format = Format::rg8; }));
  CHECK_FALSE(shares([](FlatResource& a, FlatResource&) { a.format = Format::depth32f; }));
  CHECK_FALSE(shares([](FlatResource& a, FlatResource&) { a.width = 32; }));
  CHECK_FALSE(shares([](FlatResource& a, FlatResource&) { a.height = 32; }));
  CHECK_FALSE(shares([](FlatResource& a, FlatResource&) { a.mips = 2; }));
  CHECK_FALSE(shares([](FlatResource& a, FlatResource&) { a.layers = 2; }));
  CHECK_FALSE(shares([](FlatResource& a, FlatResource&) { a.target = Target::texture_3d; }));
  CHECK_FALSE(shares(
      [](FlatResource& a, FlatResource&) { a.samples = 4, a.target = Target::texture_2d_multisample; }));
  CHECK_FALSE(shares([](FlatResource& a, FlatResource&) { a.history = 1; }));
  CHECK(shares([](FlatResource& a, FlatResource& c) { a.format = c.format = Format::depth32f_stencil8; }));
  CHECK_FALSE(shares([](FlatResource& a, FlatResource& c) {
    a.format = Format::depth24_stencil8;
    c.format = Format::depth24;
  }));
}

TEST_CASE("what a pass of another cadence writes is persistent and never shared") {
  FlatBuilder b = emptyGraph();
  const auto lut = b.texture("lut"), a = b.texture("a"), shown = b.texture("shown");
  b.pass("bake", Cadence::once).write(lut);
  b.pass("a").read(lut).write(a);
  b.pass("show").read(a).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.persistent[lut] == 1);
  CHECK(plan.storages[plan.storageOf[lut]].persistent);
  CHECK(plan.storageOf[shown] != plan.storageOf[lut]);
  CHECK(plan.storages.size() == 3);
}

TEST_CASE("a resource that is never live takes no storage, sharing off gives each its own") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), c = b.texture("c"), d = b.texture("d");
  b.texture("unused");
  b.pass("a").write(a);
  b.pass("c").read(a).write(c);
  b.pass("d").read(c).write(d).present(d);
  CHECK(b.compiled().storages.size() == 2);
  const Plan apart = b.compiled({.share = false});
  CHECK(apart.storages.size() == 3);
  CHECK(apart.bytesAllocated == apart.bytesDeclared);
  CHECK(apart.bytesLowerBound == b.compiled().bytesLowerBound);
}

TEST_CASE("version zero is cleared where it is touched first, per sub-resource, and only there") {
  FlatBuilder b = emptyGraph();
  const auto maps = b.texture("maps", Format::depth32f, 64, 1, 4), hdr = b.texture("hdr"),
             shown = b.texture("shown");
  b.resource(maps).hasClear = b.resource(hdr).hasClear = true;
  b.pass("l1").layer(maps, 1, Kind::depth, Access::modify);
  b.pass("l1again").layer(maps, 1, Kind::depth, Access::modify);
  b.pass("use").read(maps).modify(hdr);
  b.pass("show").read(hdr).write(shown).present(shown);
  const Plan plan = b.compiled();
  REQUIRE(plan.clears.size() == 4);
  CHECK(plan.steps[0].clearCount == 1);
  CHECK(plan.clears[0].use.layer == 1);
  CHECK(plan.clears[0].use.layers == 1);
  CHECK(plan.steps[1].clearCount == 0);
  CHECK(plan.steps[2].clearCount == 3);  // layer 0, layers 2 and 3, hdr
  CHECK(plan.clears[1].use.layer == 0);
  CHECK(plan.clears[1].use.layers == 1);
  CHECK(plan.clears[2].use.layer == 2);
  CHECK(plan.clears[2].use.layers == 2);
  CHECK(plan.clears[3].use.resource == hdr);
  CHECK(plan.firstStep[maps] == 0);
}

TEST_CASE("planes of a depth-stencil texture are cleared one by one") {
  FlatBuilder b = emptyGraph();
  const auto ds = b.texture("ds", Format::depth24_stencil8), shown = b.texture("shown");
  b.resource(ds).hasClear = true;
  FlatUse depth = b.whole(ds, Kind::depth, Access::modify);
  depth.planes = 1;
  b.pass("d").use(depth);
  FlatUse both = b.whole(ds, Kind::depth, Access::modify);
  b.pass("ds").use(both);
  b.pass("show").read(ds).write(shown).present(shown);
  const Plan plan = b.compiled();
  REQUIRE(plan.clears.size() == 2);
  CHECK(plan.clears[0].use.planes == 1);
  CHECK(plan.clears[1].use.planes == 2);
}

TEST_CASE("transient buffers are packed by offset and never overlap while alive") {
  FlatBuilder b = emptyGraph();
  const auto a = b.buffer("a", 1000), c = b.buffer("c", 300), d = b.buffer("d", 600),
             shown = b.texture("shown");
  b.pass("a").write(a, Kind::storage);
  b.pass("c").read(a, Kind::storage).write(c, Kind::storage);
  b.pass("d").read(c, Kind::storage).write(d, Kind::storage);
  b.pass("show").read(d, Kind::storage).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.bufferOffsetOf[a] == 0);
  CHECK(plan.bufferOffsetOf[c] == 1024);
  CHECK(plan.bufferOffsetOf[d] == 0);
  CHECK(plan.arenaBytes == 1536);
  CHECK(plan.storageOf[a] == kNone);
  CHECK(plan.bufferOffsetOf[shown] == Plan::kNoOffset);
}

TEST_CASE("imports get no storage and count no bytes") {
  FlatBuilder b = emptyGraph();
  const auto sky = b.texture("sky"), shown = b.texture("shown");
  b.resource(sky).kind = ResourceKind::imported_texture;
  b.pass("show").read(sky).write(shown).present(shown);
  const Plan plan = b.compiled();
  CHECK(plan.storageOf[sky] == kNone);
  CHECK(plan.bytesDeclared == 64 * 64 * 4);
  CHECK(plan.bytesBound == 2 * 64 * 64 * 4);
}
