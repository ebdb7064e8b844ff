// Several files: includes, and files that are not there.
#include <doctest/doctest.h>

#include "engine/graph/read/read.h"
#include "tests/graph/test_folder.h"

using namespace weft::graph;
using weft::text::Code;
using weft::text::Diagnostics;

namespace {

const PassDesc* passOf(const GraphDesc& graph, const std::string& name) {
  for (const PassDesc& pass : graph.passes)
    if (pass.name == name) return &pass;
  return nullptr;
}

}  // namespace

TEST_CASE("includes: prefix, binding, files, sharing") {
  const test::TestFolder folder("read_include_test_files");
  folder.write("parts/low.json", R"({"inputs": ["hdr"], "passes": [{"name": "p", "type": "x"}]})");
  folder.write("parts/mid.json",
               R"({"passes": [{"include": "low.json"}, {"include": "../parts/low.json", "as": "again"}]})");
  const std::string top = folder.write(
      "top.json",
      R"({"passes": [{"include": "parts/mid.json", "as": "m", "bind": {"hdr": "a.b as linear ?"}}, {"include": "parts/low.json"}]})");
  Diagnostics diagnostics;
  const auto graph = readGraph(top, diagnostics);
  REQUIRE_MESSAGE(graph, diagnostics.text());
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  CHECK(graph->name == "top");
  REQUIRE(graph->passes.size() == 2);
  CHECK(graph->passes[0].name == "m");
  REQUIRE(graph->passes[0].include);
  CHECK(graph->passes[0].include->binds[0].second.name == "a.b");
  REQUIRE(graph->passes[0].include->graph);
  const GraphDesc& mid = *graph->passes[0].include->graph;
  CHECK(mid.passes[0].name == "low");
  CHECK(mid.passes[1].name == "again");
  CHECK(mid.passes[0].include->graph == mid.passes[1].include->graph);
  CHECK(graph->passes[1].include->graph == mid.passes[0].include->graph);
  CHECK(graph->files ==
        std::vector<std::string>{top, folder.file("parts/mid.json"), folder.file("parts/low.json")});
  CHECK(passOf(*graph, "low") != nullptr);
}

TEST_CASE("includes that go wrong name the place of the include") {
  const test::TestFolder folder("read_include_test_files");
  const auto said = [&](const std::string& text) {
    Diagnostics diagnostics;
    readGraph(folder.write("top.json", text), diagnostics);
    return diagnostics;
  };
  const auto one = [&](const std::string& text) {
    const Diagnostics diagnostics = said(text);
    REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
    return diagnostics.items()[0];
  };
  auto d = one("{\"passes\": [\n  {\"include\": \"nothing.json\"}]}");
  CHECK(d.code == Code::unreadableFile);
  CHECK(*d.place.file == folder.file("top.json"));
  CHECK(d.place.line == 2);
  CHECK(d.place.column == 15);
  CHECK(one(R"({"passes": [{"include": "parts"}]})").code == Code::unreadableFile);

  d = one(R"({"passes": [{"include": "./parts/../top.json"}]})");
  CHECK(d.code == Code::includesItself);
  CHECK(d.place.column == 25);
  CHECK(d.found == folder.file("top.json") + " -> " + folder.file("top.json"));

  folder.write("parts/a.json", R"({"passes": [{"include": "b.json"}]})");
  folder.write("parts/b.json", R"({"passes": [{"include": "../top.json"}]})");
  d = one(R"({"passes": [{"include": "parts/a.json"}]})");
  CHECK(d.code == Code::includesItself);
  CHECK(*d.place.file == folder.file("parts/b.json"));
  CHECK(d.found == folder.file("top.json") + " -> " + folder.file("parts/a.json") + " -> " +
                       folder.file("parts/b.json") + " -> " + folder.file("top.json"));

  folder.write("parts/a.json", "{\"passes\": [");
  d = one(R"({"passes": [{"include": "parts/a.json"}]})");
  CHECK(d.code == Code::notJson);
  CHECK(*d.place.file == folder.file("parts/a.json"));

  CHECK(one(R"({"passes": [{"include": ""}]})").code == Code::notAName);
  folder.write("parts/9 lives.json", R"({"passes": []})");
  CHECK(one(R"({"passes": [{"include": "parts/9 lives.json"}]})").code == Code::notAName);
  CHECK(said(R"({"passes": [{"include": "parts/9 lives.json", "as": "nine"}]})").empty());
  CHECK(one(R"({"passes": [{"include": "parts/9 lives.json", "as": "a.b"}]})").code == Code::notAName);
  CHECK(
      one(R"({"passes": [{"include": "parts/9 lives.json", "as": "n"}, {"name": "n", "type": "x"}]})").code ==
      Code::duplicateName);
}

TEST_CASE("missing files, directories, empty files") {
  const test::TestFolder folder("read_include_test_files");
  const auto code = [](const std::string& path) {
    Diagnostics diagnostics;
    CHECK(!readGraph(path, diagnostics));
    REQUIRE(diagnostics.size() == 1);
    return diagnostics.items()[0].code;
  };
  CHECK(code(folder.file("no.json")) == Code::unreadableFile);
  CHECK(code(folder.file("parts")) == Code::unreadableFile);
  CHECK(code(folder.write("empty.json", "")) == Code::notJson);
}
