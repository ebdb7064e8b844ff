// What a name of a person leads to in a graph with versions and elements.
#include <doctest/doctest.h>

#include "engine/graph/language/names.h"
#include "engine/graph/pick/pick.h"
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

// Pass `first` writes hdr, `second` and `third` make a version each; `other` writes the elements of maps.
Expanded chain() {
  return expandText(R"J({ "resources": { "hdr": { "texture": "rgba8", "size": 8 },
    "maps": { "texture": "rgba8", "size": 8, "array": 2 } }, "passes": [
    { "name": "first", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "hdr" } },
    { "name": "other", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [0, 1] }, "side_effect": true,
      "write": { "result": "maps[i]" } },
    { "name": "second", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "source": "hdr" }, "write": { "result": "hdr" } },
    { "name": "third", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "source": "hdr" }, "write": { "result": "hdr" } } ],
    "present": "hdr" })J");
}

// "hdr#2 third", or the message and its hint.
std::string foundBy(const Expanded& expanded, const char* text) {
  text::Diagnostics diagnostics;
  const auto found = findPick(*expanded.graph, *parsePick(text), diagnostics);
  if (!found) return diagnostics.items()[0].message + "; " + diagnostics.items()[0].hint;
  return expanded.graph->resourceNames[found->resource] +
         (found->pass == kNone ? "" : " " + expanded.graph->passNames[found->pass]);
}

}  // namespace

TEST_CASE("a name with the same last word is nearer than one with the same first word") {
  const std::vector<std::string> names{"studio.hdr", "studio.post.glow.ldr", "studio.post.ldr"};
  CHECK(suffixHint("studio.ldr", names).find("'studio.post.ldr'") != std::string::npos);
  CHECK(suffixHint("ldr", names).find("'studio.post.ldr'") != std::string::npos);
  CHECK(suffixHint("studio.hrd", names).find("'studio.hdr'") != std::string::npos);
}

TEST_CASE("a pass behind a name chooses the version that it wrote") {
  const Expanded expanded = chain();
  REQUIRE_MESSAGE(expanded.graph, expanded.text());
  CHECK(foundBy(expanded, "hdr") == "hdr#3");
  CHECK(foundBy(expanded, "hdr#1") == "hdr");
  CHECK(foundBy(expanded, "hdr after first") == "hdr first");
  CHECK(foundBy(expanded, "hdr after second") == "hdr#2 second");
  CHECK(foundBy(expanded, "hdr after third") == "hdr#3 third");
  CHECK(foundBy(expanded, "hdr#2 after second") == "hdr#2 second");
  CHECK(foundBy(expanded, "hdr#2 after third").starts_with("there is no pass 'third' that writes 'hdr#2'"));
  CHECK(foundBy(expanded, "hdr after other").starts_with("there is no pass 'other' that writes 'hdr'"));
}

TEST_CASE("an array is named by an element") {
  const Expanded expanded = chain();
  REQUIRE_MESSAGE(expanded.graph, expanded.text());
  CHECK(foundBy(expanded, "maps[1]") == "maps[1]");
  CHECK(foundBy(expanded, "maps") ==
        "no pass that is enabled uses a resource 'maps'; names that hold it: 'maps[0]', 'maps[1]'");
}
