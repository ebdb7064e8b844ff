// tests/bad_graphs from W040 on: every file gives exactly the diagnostic that manifest.json promises, and
// nothing else; every code has a file. (docs/errors.py makes docs/errors.md of the same files.)
// Entries may carry "set" and "disable", as on the command line, "in", the file of the place where it is another, and
// "warning". Stage "expand": found by expandGraph.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/text/json/edit.h"
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

const std::filesystem::path kFolder = std::filesystem::path(WEFT_SOURCE_DIR) / "tests/bad_graphs";

nlohmann::ordered_json manifest() {
  std::ifstream in(kFolder / "manifest.json");
  return text::loadJson(std::string(std::istreambuf_iterator(in), {})).at("files");
}

int numberOf(const std::string& code) {
  return std::stoi(code.substr(1));
}

text::Diagnostics diagnose(const nlohmann::ordered_json& entry) {
  Settings settings;
  for (const std::string& set : entry.value("set", std::vector<std::string>{}))
    settings.sets.emplace_back(set.substr(0, set.find('=')), set.substr(set.find('=') + 1));
  for (std::string& name : entry.value("disable", std::vector<std::string>{}))
    settings.disables.emplace_back(std::move(name));
  text::Diagnostics diagnostics;
  const auto desc = readGraph((kFolder / entry.at("file").get<std::string>()).string(), diagnostics);
  REQUIRE_MESSAGE(desc, diagnostics.text());
  REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
  const auto graph = expandGraph(*desc, testRegistry(), settings, diagnostics);
  CHECK((graph != nullptr) == !diagnostics.hasErrors());
  return diagnostics;
}

}  // namespace

TEST_CASE("every graph that cannot be expanded gives its one diagnostic") {
  int checked = 0;
  for (const auto& entry : manifest()) {
    if (entry.value("stage", "") != "expand") continue;
    const std::string file = entry.at("file");
    CAPTURE(file);
    const text::Diagnostics diagnostics = diagnose(entry);
    INFO(diagnostics.text());
    REQUIRE(diagnostics.size() == 1);
    const text::Diagnostic& d = diagnostics.items()[0];
    CHECK(nameOf(d.code) == entry.at("code"));
    CHECK(d.place.line == entry.at("line").get<std::uint32_t>());
    CHECK(d.place.column == entry.at("column").get<std::uint32_t>());
    if (d.place.line > 0) {
      REQUIRE(d.place.file);
      CHECK(std::filesystem::path(*d.place.file) == kFolder / entry.value("in", file));
    }
    CHECK(d.message.back() != '.');
    CHECK_MESSAGE((!d.hint.empty() || !d.expected.empty()), text::format(d));
    CHECK((d.severity == text::Severity::warning) == entry.value("warning", false));
    ++checked;
  }
  CHECK(checked >= 60);
}

TEST_CASE("every code of the graph has a broken input") {
  std::set<int> covered;
  for (const auto& entry : manifest()) covered.insert(numberOf(entry.at("code")));
#define WEFT_CODE_ROW(number, name, title) static_cast<int>(text::Code::name),
  for (const int number : {WEFT_CODES(WEFT_CODE_ROW)})
    if (number < 100 || number >= 240) CHECK_MESSAGE(covered.contains(number), number);
#undef WEFT_CODE_ROW
}
