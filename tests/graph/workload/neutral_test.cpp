// Workloads: reading the neutral form, its mistakes, the generator, and the checks on flat graphs.
#include "engine/graph/workload/neutral.h"

#include <doctest/doctest.h>

#include "engine/base/files/file.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/workload/link_flat.h"
#include "tests/graph/compile/flat_builder.h"

using namespace weft;
using namespace weft::graph;
using base::Code;

namespace {

std::optional<FlatGraph> read(std::string_view text, base::Diagnostics& d, NeutralOptions options = {}) {
  return readNeutral(text, "w.json", options, d);
}

constexpr const char* kSmall = R"({"textures":[{"name":"A","width":64,"height":32,"format":"RG16F"},
  {"name":"B","width":64,"height":32,"format":"depth32f"}],
 "passes":[{"name":"p","reads":[],"writes":["A"]},
  {"name":"q","reads":["A"],"writes":["B"],"side_effect":true}]})";

}  // namespace

TEST_CASE("a workload becomes a flat graph") {
  base::Diagnostics d;
  auto graph = read(kSmall, d);
  REQUIRE(graph.has_value());
  CHECK(d.empty());
  CHECK(graph->resources[0].bytes == 64 * 32 * 4);
  CHECK(graph->passNames == std::vector<std::string>{"p", "q"});
  CHECK(graph->uses.size() == 3);
  CHECK(graph->uses[0].kind == Kind::color);
  CHECK(graph->uses[0].keep);
  CHECK(graph->uses[1].kind == Kind::sampled);
  CHECK(graph->uses[2].kind == Kind::depth);
  CHECK(graph->passes[1].sideEffect);
  CHECK(graph->present.resource == kNone);
  CHECK(linkFlat(*graph, d));
}

TEST_CASE("every second pass as compute works by image where the format can") {
  base::Diagnostics d;
  auto graph = read(kSmall, d, {.everySecondCompute = true});
  REQUIRE(graph.has_value());
  CHECK(graph->uses[0].kind == Kind::color);
  CHECK(graph->uses[1].kind == Kind::image);
  CHECK(graph->uses[2].kind == Kind::depth);  // depth formats cannot
}

TEST_CASE("passes may stand before textures") {
  base::Diagnostics d;
  auto graph = read(
      R"({"passes":[{"name":"p","writes":["A"]}],"textures":[{"name":"A","width":1,"height":1,"format":"R8"}]})",
      d);
  REQUIRE(graph.has_value());
  CHECK(graph->uses.size() == 1);
}

TEST_CASE("mistakes in a workload are found all at once, with their places") {
  base::Diagnostics d;
  CHECK_FALSE(read(R"({"textures":[
 {"name":"A","width":0,"height":1,"format":"R8"},
 {"name":"A","width":1,"height":1,"format":"RGBA61F"}],
 "passes":[{"name":"p","reads":["AB"],"writes":["A"],"write":1}]})",
                   d));
  CHECK(d.contains(Code::notAWorkload));
  CHECK(d.contains(Code::unknownWorkloadTexture));
  CHECK(d.contains(Code::unknownWorkloadFormat));
  CHECK(d.contains(Code::duplicateFlatName));
  for (const auto& item : d.items()) CHECK(item.place.line > 0);
  CHECK(d.items()[0].place.line == 2);
  CHECK(d.items()[0].place.column == 22);
}

TEST_CASE("text that is no workload is refused with one message and its place") {
  for (const char* text : {"", "[", "{\"textures\":[", "{} x", "{\"textures\":[{\"name\":\"A\\q\"}]}",
                           "{\"textures\":3}", "{\"passes\":[{\"name\":\"p\",\"side_effect\":maybe}]}",
                           "{\"passes\":[{\"name\":\"p\",\"reads\":[\"A"}) {
    base::Diagnostics d;
    CHECK_FALSE(read(text, d));
    CHECK(d.contains(Code::notAWorkload));
  }
  base::Diagnostics d;
  CHECK_FALSE(read("{\"textures\":" + std::string(100000, '['), d));
}

TEST_CASE("escapes are read") {
  base::Diagnostics d;
  auto graph = read(
      R"({"textures":[{"name":"\u0041\u00e9\ud83d\ude00\n","width":1,"height":1,"format":"R8"}],"passes":[]})",
      d);
  REQUIRE(graph.has_value());
  CHECK(graph->resourceNames[0] == "A\xc3\xa9\xf0\x9f\x98\x80\n");
}

TEST_CASE("what compile takes for granted is checked") {
  const auto reports = [](FlatBuilder& b, Code code) {
    base::Diagnostics d;
    return !linkFlat(b.graph, d) && d.contains(code);
  };
  {
    FlatBuilder b = emptyGraph();
    const auto a = b.texture("a");
    b.pass("p").read(a);
    CHECK(reports(b, Code::flatReadBeforeWrite));
    b.resource(a).hasClear = true;
    CHECK_FALSE(reports(b, Code::flatReadBeforeWrite));
  }
  {
    FlatBuilder b = emptyGraph();
    const auto a = b.texture("a", Format::rgba8, 8, 2);
    b.pass("p").mip(a, 0, Kind::color, Access::write);
    b.pass("q").read(a);
    CHECK(reports(b, Code::flatReadBeforeWrite));  // level 1 was never written
  }
  {
    FlatBuilder b = emptyGraph();
    const auto a = b.texture("a");
    b.pass("p").write(a);
    b.pass("q").read(a).write(a);
    CHECK(reports(b, Code::touchedTwice));
  }
  {
    FlatBuilder b = emptyGraph();
    const auto a = b.texture("a");
    b.pass("p").mip(a, 1, Kind::color, Access::write);
    CHECK(reports(b, Code::useOutsideResource));
  }
  {
    FlatBuilder b = emptyGraph();
    const auto a = b.texture("a");
    b.pass("p").write(a);
    b.pass("p").write(b.texture("a"));
    CHECK(reports(b, Code::duplicateFlatName));
    b.present(b.texture("c"));
    CHECK(reports(b, Code::presentsUnwritten));
  }
}

TEST_CASE("generated workloads are valid, mostly alive, and the same every time") {
  for (const NeutralShape shape : {NeutralShape::chain, NeutralShape::layered, NeutralShape::fanin})
    for (const std::size_t passes : {1u, 2u, 26u, 500u}) {
      const std::string text = neutralText(shape, passes);
      CHECK(text == neutralText(shape, passes));
      base::Diagnostics d;
      auto graph = read(text, d);
      REQUIRE(graph.has_value());
      CHECK(linkFlat(*graph, d));
      const Plan plan = compile(std::make_shared<const FlatGraph>(*graph));
      if (shape == NeutralShape::layered)
        CHECK(plan.steps.size() * 10 > passes * 6);
      else
        CHECK(plan.steps.size() == passes);
      CHECK(plan.bytesAllocated == plan.bytesLowerBound);
    }
}

TEST_CASE("the workload files reach the storage bound") {
  const std::string folder = WEFT_SOURCE_DIR "/tests/graph/workloads/";
  struct Expected {
    const char* name;
    std::size_t kept;
    std::uint64_t bytes;
  };
  const Expected expected[] = {{"layered_100", 76, 132470528},
                               {"layered_1000", 910, 208740864},
                               {"chain_1000", 1000, 0},
                               {"fanin_1000", 1000, 0}};
  for (const auto& [name, kept, bytes] : expected) {
    base::Diagnostics d;
    const auto text = base::readFile(folder + name + ".json", d);
    REQUIRE(text.has_value());
    auto graph = read(*text, d);
    REQUIRE(graph.has_value());
    CHECK(linkFlat(*graph, d));
    const Plan plan = compile(std::make_shared<const FlatGraph>(*graph));
    CHECK(plan.steps.size() == kept);
    CHECK(plan.bytesAllocated == plan.bytesLowerBound);
    if (bytes != 0) CHECK(plan.bytesAllocated == bytes);
    for (const Step& step : plan.steps) CHECK(step.barriers == 0);
  }
}
