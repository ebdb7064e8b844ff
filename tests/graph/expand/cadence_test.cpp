// "update" that does not fit what is read (W083), and what only looks like it. tests/bad_graphs has each of the warnings
// but that of an import.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// The warnings of a graph whose pass `make` writes `made`, and whose pass `take` reads `read` and writes `shown`.
std::vector<text::Diagnostic> warningsOf(const std::string& make, const std::string& take,
                                         const std::string& read, const std::string& more = "") {
  const Expanded expanded = expandText(
      R"J({ "resources": { "made": { "texture": "rgba8", "size": 8, "history": 1 },
    "shown": { "texture": "rgba8", "size": 8, "mips": 3 }, "file": { "import": "image", "file": "a.####.png" } },
  "passes": [ { "name": "make", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "made" } )J" +
      make + R"J( }, )J" + more +
      R"J({ "name": "take", "type": "fullscreen", "shader": "a.frag.glsl",
    "repeat": { "i": [0, 2] }, "read": { "source": ")J" +
      read + R"J(" }, "write": { "result": "shown.mip[i]" } )J" + take + R"J( } ], "present": "shown" })J");
  REQUIRE_MESSAGE(expanded.graph, expanded.text());
  std::vector<text::Diagnostic> found;
  for (const text::Diagnostic& d : expanded.diagnostics.items())
    if (d.code == Code::cadenceMisfit) found.push_back(d);
  return found;
}

const std::string kOnce = R"J(, "update": "once")J", kOnChange = R"J(, "update": "on_change")J";

}  // namespace

TEST_CASE("a pass that runs once and reads what changes is told once, with all its repeats") {
  for (const char* const read : {"made", "made@-1", "file"}) {
    const auto found = warningsOf("", kOnce, read);
    CAPTURE(read);
    REQUIRE(found.size() == 1);
    CHECK(found[0].severity == text::Severity::warning);
    CHECK(found[0].resource == read);
    CHECK(found[0].pass == "take[0]");
  }
  CHECK(warningsOf("", kOnce, "file")[0].hint.find("on_change") != std::string::npos);
  CHECK(warningsOf(kOnce, kOnce, "made@-1").size() == 1);
  CHECK(warningsOf(kOnChange, kOnce, "made@-1").size() == 1);
}

TEST_CASE("on_change that means always is told, and what changes at times is not") {
  CHECK(warningsOf("", kOnChange, "made").size() == 1);
  CHECK(warningsOf("", kOnChange, "made@-1").size() == 1);
  CHECK(warningsOf("", kOnChange, "file").empty());
  CHECK(warningsOf(kOnChange, kOnChange, "made").empty());
  CHECK(warningsOf(kOnChange, kOnChange, "made@-1").empty());
  CHECK(warningsOf(kOnce, kOnce, "made").empty());
  CHECK(warningsOf(kOnChange, kOnce, "made").empty());
  for (const char* const read : {"made", "made@-1", "file"}) CHECK(warningsOf("", "", read).empty());
}

TEST_CASE("a once pass that runs again with another writer, and one that is culled, are not judged") {
  const auto countOf = [](const char* besides, const char* present) {
    const Expanded expanded = expandText(fmt::format(
        R"J({{ "resources": {{ "made": {{ "texture": "rgba8", "size": 8 }}, "one": {{ "texture": "rgba8", "size": 8, "mips": 2 }}, "both": {{ "texture": "rgba8", "size": 8 }} }}, "passes": [
      {{ "name": "make", "type": "fullscreen", "shader": "a.frag.glsl", "write": {{ "result": "made" }} }},
      {{ "name": "take", "type": "fullscreen", "shader": "a.frag.glsl", "update": "once",
        "read": {{ "source": "made" }}, "write": {{ "result": "one.mip[0]" }} }},
      {{ "name": "beside", "type": "fullscreen", "shader": "a.frag.glsl", "update": "{}",
        "write": {{ "result": "one.mip[1]" }} }},
      {{ "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": {{ "a": "one" }},
        "write": {{ "result": "both" }} }} ], "present": "{}" }})J",
        besides, present));
    REQUIRE_MESSAGE(expanded.graph, expanded.text());
    return std::ranges::count(expanded.diagnostics.items(), Code::cadenceMisfit, &text::Diagnostic::code);
  };
  CHECK(countOf("once", "both") == 1);
  CHECK(countOf("on_change", "both") == 0);
  CHECK(countOf("once", "made") == 0);
}
