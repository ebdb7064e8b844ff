// `as compare` without a comparison means that of the depth test which made the map, wherever it is read.
#include <doctest/doctest.h>

#include <string>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// `passes` make what `map` is; `show` reads it as `reference`, and tests depth in a target of its own by `equal`.
Expanded shown(const std::string& passes, const std::string& reference = "map as compare",
               const std::string& map = R"J("clear": 0)J") {
  return expandText(
      R"J({ "resources": { "map": { "texture": "depth32f", "size": 8, "history": 1, )J" + map +
      R"J( }, "copy": { "texture": "depth32f", "size": 8, "clear": 0 }, "own": { "texture": "depth32f", "size": 8, "clear": 0 }, "out": { "texture": "rgba8", "size": 8, "clear": 0 } },
  "passes": [ )J" +
      passes +
      R"J( { "name": "show", "type": "draw", "shader": "a", "list": "spheres", "geometry": "quad", "read": { "map": ")J" +
      reference +
      R"J(", "was": "map@-1", "copied": "copy" }, "modify": { "r": "out", "depth": "own" }, "state": { "depth_test": "equal" } } ], "present": "out" })J");
}

std::string drawn(const std::string& name, const std::string& test, const std::string& target = "map",
                  const std::string& access = "modify") {
  return R"J({ "name": ")J" + name +
         R"J(", "type": "draw", "shader": "a", "list": "spheres", "geometry": "quad", ")J" + access +
         R"J(": { "d": ")J" + target + R"J(" }, "state": { "depth_test": ")J" + test + R"J(" } },)J";
}

Compare comparisonOf(const Expanded& expanded) {
  INFO(expanded.text());
  REQUIRE(expanded.graph);
  const Sampler& sampler = expanded.slot("show", "map").sampler;
  REQUIRE(sampler.function);
  return *sampler.function;
}

}  // namespace

TEST_CASE("a map is compared as it was drawn") {
  CHECK(comparisonOf(shown(drawn("one", "greater"))) == Compare::greater);
  CHECK(comparisonOf(shown(drawn("one", "less_equal"))) == Compare::less_equal);
  CHECK(comparisonOf(shown(drawn("one", "greater"), "map as compare(less)")) == Compare::less);
  // The last one counts; one that does not order leaves what it modified.
  CHECK(comparisonOf(shown(drawn("one", "less") + drawn("two", "greater"))) == Compare::greater);
  CHECK(comparisonOf(shown(drawn("one", "less") + drawn("two", "equal"))) == Compare::less);
  CHECK(comparisonOf(shown(drawn("one", "less"), "map@-1 as compare")) == Compare::less);
  CHECK(
      comparisonOf(shown(
          drawn("one", "greater") +
              R"J({ "name": "keep", "type": "blit", "read": { "source": "map" }, "write": { "destination": "copy" } },)J",
          "copy as compare")) == Compare::greater);
}

TEST_CASE("where nothing was drawn, everything is nearer than what was cleared") {
  CHECK(comparisonOf(shown("")) == Compare::greater);
  CHECK(comparisonOf(shown("", "map as compare", R"J("clear": 1)J")) == Compare::less);
}

TEST_CASE("where nothing says how, it must be said") {
  const std::string filled =
      R"J({ "name": "fill", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "d": "map" }, "state": { "depth_test": "always" } },)J";
  CHECK(shown(filled).has(Code::badKind));
  CHECK(shown(filled, "map as compare(greater)").graph);
}
