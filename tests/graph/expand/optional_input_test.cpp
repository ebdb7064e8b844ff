// Inputs that the including file may leave without a resource.
#include <doctest/doctest.h>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// outer includes middle includes inner, which reads `extra`; `top` goes into outer's resources, `read` is inner's reference.
Expanded expandInside(const std::string& top, const std::string& read, const std::string& bind = "") {
  const std::string optional = R"J("extra": { "input": "texture", "optional": true })J";
  return expandFiles(
      "expand_optional",
      {{"inner.json", R"J({ "resources": { )J" + optional + R"J(, "res": { "texture": "rgba8", "size": 4 } },
    "passes": [ { "name": "go", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "extra": ")J" +
                          read + R"J(" },
                  "write": { "result": "res" }, "defines": { "ANY": "has(extra)" } } ] })J"},
       {"middle.json",
        R"J({ "resources": { )J" + optional + R"J( }, "passes": [ { "include": "inner.json" } ] })J"},
       {"outer.json", R"J({ "resources": { "other": { "texture": "rgba8", "size": 2, "clear": 0 } )J" + top +
                          R"J( }, "passes": [ { "include": "middle.json" )J" + bind +
                          R"J( } ], "present": "middle.inner.res" })J"}});
}

}  // namespace

TEST_CASE("an optional input without a resource has nothing, through any number of includes") {
  const Expanded none = expandInside("", "extra as linear ?");
  REQUIRE_MESSAGE(none.graph, none.text());
  CHECK(none.useText("middle.inner.go", "extra") == "-");
  CHECK(none.define("middle.inner.go", "ANY") == "0");
  const std::string mine = R"J(, "extra": { "texture": "rgba8", "size": 2, "clear": 0 })J";
  const Expanded same = expandInside(mine, "extra as linear");
  REQUIRE_MESSAGE(same.graph, same.text());
  CHECK(same.useText("middle.inner.go", "extra") == "extra");
  CHECK(same.define("middle.inner.go", "ANY") == "1");
  const Expanded bound = expandInside("", "extra", R"J(, "bind": { "extra": "other" })J");
  REQUIRE_MESSAGE(bound.graph, bound.text());
  CHECK(bound.useText("middle.inner.go", "extra") == "other");
}

TEST_CASE(
    "a plain read of an optional input that has nothing is an error, and so is a bind that does not fit") {
  const Expanded plain = expandInside("", "extra");
  CHECK_FALSE(plain.graph);
  CHECK(plain.diagnostics.hasErrors());
  CHECK(plain.diagnostics.items()[0].message.find("'extra'") != std::string::npos);
  CHECK(expandInside("", "extra?", R"J(, "bind": { "extra": "othr" })J").has(Code::unknownResource));
  CHECK(expandInside(R"J(, "extra": { "buffer": 16, "clear": 0 })J", "extra?").has(Code::badBind));
}
