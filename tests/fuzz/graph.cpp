// Graph files: read, laid out, expanded, compiled and printed.
#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/print/print.h"
#include "engine/graph/read/read.h"
#include "engine/text/json/dom.h"
#include "importers/import.h"
#include "tests/fuzz/fuzz.h"
#include "tests/graph/test_registry.h"

namespace weft::fuzz {

namespace {

void expectSteadyLayout(std::string_view input) {
  text::Diagnostics said;
  if (!text::parseJson(input, "x.json", said) || !said.empty()) return;
  const std::string once = importing::layoutGraph(input);
  expect(text::parseJson(once, "x.json", said) && said.empty(), "a layout that can be read", said);
  expect(importing::layoutGraph(once) == once, "a layout of a layout is the same");
}

}  // namespace

void fuzz(std::string_view input) {
  static const graph::Registry registry = graph::test::testRegistry();
  static const std::string over = GivenFile::pathOf("../graphs/glow.json");
  expectSteadyLayout(input);
  const GivenFile file("bad_graphs/fuzz.json", input);
  // The file as a graph, and as an overlay over one that is right.
  for (const bool overlay : {false, true}) {
    text::Diagnostics said;
    const std::vector<std::string> presets(overlay ? 1 : 0, file.path());
    const auto desc = graph::readGraph(overlay ? over : file.path(), said, {.presets = presets});
    expectAnswer(desc != nullptr, said);
    if (!desc) continue;
    graph::findNameUses(*desc, registry);
    const auto flat = graph::expandGraph(*desc, registry, {.screenWidth = 64, .screenHeight = 32}, said);
    expectAnswer(flat != nullptr, said);
    if (!flat || said.hasErrors()) continue;
    const graph::Plan plan = graph::compile(flat);
    if (!graph::checkMemory(plan, said)) continue;
    expect(!graph::dumpText(plan, true).empty() && !graph::dumpJson(plan).empty(), "a text of a plan");
  }
}

}  // namespace weft::fuzz
