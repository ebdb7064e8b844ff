#include "engine/text/diagnostic.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "engine/text/json/edit.h"
#include "engine/text/json/report.h"

using namespace weft::text;

static Place at(std::uint32_t line, std::uint32_t column) {
  return {"a.json", line, column};
}

TEST_CASE("a diagnostic prints place, code, message and its details") {
  Diagnostics all;
  Diagnostic& d = all.add({.code = Code::unknownResource,
                           .message = "pass 'fxaa' reads unknown resource 'ldrr'",
                           .place = at(12, 7)});
  d.pass = "fxaa";
  d.hint = "did you mean 'ldr'?";
  CHECK(format(all.items()[0]) ==
        "a.json:12:7: error[W040]: pass 'fxaa' reads unknown resource 'ldrr'\n"
        "    pass: fxaa\n"
        "    fix: did you mean 'ldr'?");
  CHECK(all.hasErrors());
  CHECK(all.contains(Code::unknownResource));
}

TEST_CASE("the place of an option is no file: in text, in JSON and in SARIF") {
  const Where place = placeOfOption("--set bloom=yes");
  CHECK_FALSE(place.file);
  CHECK(place.line == 0);
  CHECK(place.column == 0);
  CHECK(place.option == "--set bloom=yes");
  CHECK(isKnown(place));
  CHECK(isKnown(placeOfOption("")));
  CHECK(isKnown(at(1, 1)));
  CHECK_FALSE(isKnown(Where{}));
  // A slot of a graph has a place in a file; a graph has up to a million of them.
  static_assert(sizeof(Place) <= 2 * sizeof(void*) + 8);
  static_assert(!std::is_convertible_v<Where, Place>, "it would lose the option");
  Diagnostics all;
  all.add({.code = Code::badParameterValue, .message = "in a file", .place = at(1, 1)});
  all.add({.code = Code::badParameterValue, .message = "of an option", .place = place});
  all.add({.code = Code::badParameterValue, .message = "of nothing"});
  all.add({.code = Code::badParameterValue, .message = "of the command line", .place = placeOfOption("")});
  all.sortByPlace();
  CHECK(all.text() ==
        "error[W047]: of nothing\n"
        "command line: error[W047]: of the command line\n"
        "command line: --set bloom=yes: error[W047]: of an option\n"
        "a.json:1:1: error[W047]: in a file\n");
  const auto json = loadJson(diagnosticsJson(all, 0));
  CHECK_FALSE(json[2].contains("file"));
  CHECK(json[2]["option"] == "--set bloom=yes");
  CHECK(json[3]["file"] == "a.json");
  CHECK_FALSE(json[3].contains("option"));
  const auto sarif = loadJson(diagnosticsSarif(all, "1"));
  const auto& results = sarif["runs"][0]["results"];
  CHECK_FALSE(results[2].contains("locations"));
  CHECK(results[3]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "a.json");
}

TEST_CASE("warnings are no errors; sorting drops repeats and keeps the count right") {
  Diagnostics all;
  all.add({.severity = Severity::warning, .code = Code::unknownResource, .message = "w", .place = at(1, 1)});
  CHECK_FALSE(all.hasErrors());
  all.add({.code = Code::unreadableFile, .message = "late", .place = at(9, 1)});
  all.add({.code = Code::unreadableFile, .message = "early", .place = at(2, 1)});
  all.add({.code = Code::unreadableFile, .message = "late", .place = at(9, 1)});
  all.sortByPlace();
  REQUIRE(all.size() == 3);
  CHECK(all.errorCount() == 2);
  CHECK(all.items()[1].message == "early");
}
