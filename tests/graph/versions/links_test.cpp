// Version links of random graphs against their definition; corners of the walk; liveness along the links.
#include <doctest/doctest.h>

#include "engine/graph/versions/versions.h"
#include "tests/graph/compile/random_graph.h"
#include "tests/graph/versions/brute_links.h"

using namespace weft;
using namespace weft::graph;

namespace {

std::vector<std::uint32_t> writersOf(const FlatGraph& graph, std::uint32_t use) {
  std::vector<std::uint32_t> writers;
  graph.links.forEachRun(graph.links.seen[use],
                         [&](std::uint32_t writer, std::uint32_t) { writers.push_back(writer); });
  return writers;
}

using List = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("the links of random graphs are the last writers in declared order, per sub-resource") {
  checks::LinkCount count;
  std::size_t failures = 0;
  for (std::uint64_t seed = 1; seed <= 2500; ++seed) {
    const std::string problem = checks::checkLinks(*randomGraph(seed).linked(), count);
    if (!problem.empty() && ++failures < 10) FAIL_CHECK("graph " << seed << ": " << problem);
  }
  CHECK(failures == 0);
  MESSAGE(count.links << " links, " << count.several << " of several writers, " << count.none << " of none, "
                      << count.histories << " of earlier frames");
  CHECK(count.links > 50000);
  for (const std::size_t n : {count.several, count.none, count.histories}) CHECK(n > 1000);
}

TEST_CASE(
    "a link has one run per writer, in the order of the sub-resources, and what nobody wrote is one too") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a", Format::rgba8, 64, 3, 2);
  b.resource(a).hasClear = true;
  b.pass("first").mip(a, 1, Kind::color, Access::write);      // use 0: level 1 of both layers
  b.pass("second").layer(a, 1, Kind::color, Access::modify);  // use 1: sees none, 0, none
  b.pass("all").read(a);                                      // use 2
  b.pass("over").write(a);                                    // use 3
  b.pass("after").read(a);                                    // use 4: one writer
  b.pass("again").mip(a, 2, Kind::color, Access::write);      // use 5
  b.pass("last").read(a);                                     // use 6
  const auto graph = b.linked();
  CHECK(writersOf(*graph, 0) == List{kNone});
  CHECK(writersOf(*graph, 1) == List{kNone, 0, kNone});
  CHECK(writersOf(*graph, 2) == List{kNone, 0, kNone, 1});
  CHECK(writersOf(*graph, 4) == List{3});
  CHECK(graph->links.seen[4] == 3);
  CHECK(writersOf(*graph, 6) == List{3, 5, 3, 5});
}

TEST_CASE("a pass does not see what it writes itself, whichever slot comes first") {
  FlatBuilder b = emptyGraph();
  const auto a = b.texture("a"), shown = b.texture("shown");
  b.pass("first").write(a);                      // use 0
  b.pass("own").modify(a).read(a).write(shown);  // uses 1, 2, 3
  b.present(shown);
  const auto graph = b.linked();
  CHECK(writersOf(*graph, 1) == List{0});
  CHECK(writersOf(*graph, 2) == List{0});
  // So nobody sees what the pass makes of a, and it is not attached.
  const Liveness live = findLive(*graph);
  CHECK(live.use == std::vector<std::uint8_t>{1, 0, 1, 1});
  CHECK(b.compiled().attached == live.use);
}

TEST_CASE("liveness follows histories to later passes, and modifies only when somebody sees them") {
  FlatBuilder b = emptyGraph();
  const auto past = b.texture("past"), extra = b.texture("extra"), shown = b.texture("shown");
  b.resource(past).history = 1;
  b.pass("show").read(past, Kind::sampled, 1).write(shown);  // uses 0, 1
  b.pass("base").write(past).write(extra);                   // uses 2, 3
  b.pass("add").modify(past).modify(extra);                  // uses 4, 5
  b.pass("nobody").read(past).modify(extra);                 // uses 6, 7
  b.present(shown);
  const auto graph = b.linked();
  CHECK(graph->links.forward);
  CHECK(writersOf(*graph, 0) == List{4});
  const Liveness live = findLive(*graph);
  CHECK(live.pass == std::vector<std::uint8_t>{1, 1, 1, 0});
  CHECK(live.use == std::vector<std::uint8_t>{1, 1, 1, 0, 1, 0, 0, 0});
}
