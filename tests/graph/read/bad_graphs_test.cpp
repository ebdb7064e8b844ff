// tests/bad_graphs: every file of a code below W040 gives exactly the diagnostic that manifest.json promises:
// code, line and column, and nothing else. Stage "read": found by readGraph. Stage "evaluate": reads well,
// and fails when the expression is evaluated with the graph's own parameters.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/graph/read/read.h"
#include "engine/text/json/edit.h"
#include "tests/graph/expand/map_scope.h"

using namespace weft::graph;
using weft::text::Code;
using weft::text::Diagnostics;

namespace {

const std::filesystem::path kFolder = std::filesystem::path(WEFT_SOURCE_DIR) / "tests/bad_graphs";

nlohmann::ordered_json manifest() {
  std::ifstream in(kFolder / "manifest.json");
  return weft::text::loadJson(std::string(std::istreambuf_iterator(in), {})).at("files");
}

int numberOf(const std::string& code) {
  return std::stoi(code.substr(1));
}

Diagnostics diagnose(const std::string& file, const std::string& stage) {
  Diagnostics diagnostics;
  const auto graph = readGraph((kFolder / file).string(), diagnostics);
  if (stage != "evaluate") return diagnostics;
  REQUIRE(graph);
  REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
  MapScope scope;
  for (const ParameterDesc& parameter : graph->parameters) {
    scope.variables[parameter.name] = parameter.initial;
    scope.choices[parameter.name] = parameter.choices;
  }
  for (const NamedExpr& let : graph->lets) let.expr.evaluate(scope, diagnostics);
  return diagnostics;
}

// Number and title of each below W040.
std::map<int, std::string> codesOfReading() {
#define WEFT_CODE_ROW(number, name, title) {static_cast<int>(weft::text::Code::name), title},
  std::map<int, std::string> all = {WEFT_CODES(WEFT_CODE_ROW)};
#undef WEFT_CODE_ROW
  std::erase_if(all, [](const auto& row) { return row.first >= 40; });
  return all;
}

}  // namespace

TEST_CASE("every broken file gives its one diagnostic") {
  int checked = 0;
  for (const auto& entry : manifest()) {
    const std::string file = entry.at("file"), code = entry.at("code");
    const std::string stage = entry.value("stage", "read");
    if (stage != "read" && stage != "evaluate") continue;
    CAPTURE(file);
    const Diagnostics diagnostics = diagnose(file, stage);
    INFO(diagnostics.text());
    REQUIRE(diagnostics.size() == 1);
    const auto& d = diagnostics.items()[0];
    CHECK(nameOf(d.code) == code);
    CHECK(d.place.line == entry.at("line").get<std::uint32_t>());
    CHECK(d.place.column == entry.at("column").get<std::uint32_t>());
    REQUIRE(d.place.file);
    CHECK(std::filesystem::path(*d.place.file) == kFolder / entry.value("in", file));
    CHECK(!d.message.empty());
    CHECK(d.message.back() != '.');
    // A person must be able to act: what was expected, or what would fix it.
    CHECK_MESSAGE((!d.hint.empty() || !d.expected.empty()), format(d));
    ++checked;
  }
  CHECK(checked >= 60);
}

TEST_CASE("every code below W040 has a broken file, and every broken file is in the manifest") {
  std::set<int> covered;
  std::set<std::string> listed;
  for (const auto& entry : manifest()) {
    covered.insert(numberOf(entry.at("code")));
    listed.insert(entry.at("file"));
  }
  for (const auto& [number, title] : codesOfReading()) CHECK_MESSAGE(covered.count(number) == 1, title);
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name != "manifest.json") CHECK_MESSAGE(listed.count(name) == 1, name);
  }
}
