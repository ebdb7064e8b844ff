// tests/bad_graphs: every file of a code below W040 gives exactly the diagnostic that manifest.json promises:
// code, line and column, and nothing else. Stage "read": found by readGraph. Stage "evaluate": reads well,
// and fails when the expression is evaluated with the graph's own parameters.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "engine/graph/read/read.h"
#include "tests/graph/expand/map_scope.h"

using namespace weft::graph;
using weft::base::Code;
using weft::base::Diagnostics;

namespace {

const std::filesystem::path kFolder = std::filesystem::path(WEFT_SOURCE_DIR) / "tests/bad_graphs";

nlohmann::json manifest() {
  std::ifstream in(kFolder / "manifest.json");
  return nlohmann::json::parse(in).at("files");
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
#define WEFT_CODE_ROW(number, name, title) {static_cast<int>(weft::base::Code::name), title},
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

TEST_CASE("docs/errors.md has a section for every code below W040, and its messages are the program's") {
  std::ifstream in(std::filesystem::path(WEFT_SOURCE_DIR) / "docs/errors.md");
  std::map<int, std::string> sections;
  int section = -1;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## W")) section = numberOf(line.substr(3, 4));
    sections[section] += line + "\n";
  }
  for (const auto& [number, title] : codesOfReading()) {
    CAPTURE(title);
    CHECK(sections[number].find("## W0") == 0);
    CHECK(sections[number].find(": " + title + "\n") == 7);
  }

  // What each section shows between its fences is a sequence of messages of files in tests/bad_graphs.
  std::map<int, std::string> printed;
  for (const auto& entry : manifest()) {
    const int number = numberOf(entry.at("code"));
    if (number >= 40) continue;
    const Diagnostics said = diagnose(entry.at("file"), entry.value("stage", "read"));
    std::string text = said.text();
    const std::string folder = kFolder.string() + "/";
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
      text.erase(at, folder.size());
    printed[number] += "\n" + text;
  }
  int shown = 0;
  for (const auto& [number, text] : sections) {
    if (number < 1 || number >= 40) continue;
    const std::string fence = "```text\n";
    const std::size_t from = text.find(fence), to = text.find("\n```", from + 1);
    REQUIRE_MESSAGE(from != std::string::npos, number);
    REQUIRE(to != std::string::npos);
    std::string message;
    std::istringstream lines(text.substr(from + fence.size(), to - from - fence.size()) + "\n");
    const auto check = [&] {
      if (message.empty()) return;
      CHECK_MESSAGE(printed[number].find("\n" + message) != std::string::npos, message, "is none of",
                    printed[number]);
      ++shown;
    };
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("    ")) {
        check();
        message.clear();
      }
      message += line + "\n";
    }
    check();
  }
  CHECK(shown >= 21);
}
