// Inputs that the including file may leave without a resource.
#include <doctest/doctest.h>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// outer includes middle includes inner, which reads `extra`; `top` goes into outer's resources, `read` is inner's reference.
Expanded expandInside(const std::string& top, const std::string& read, const std::string& bind = "",
                      const std::string& size = "4") {
  return expandFiles(
      "expand_optional",
      {{"inner.json", R"J({ "inputs": ["extra ?"], "resources": { "res": { "texture": "rgba8", "size": )J" +
                          size + R"J( } },
    "passes": [ { "name": "go", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "extra": ")J" +
                          read + R"J(" },
                  "write": { "result": "res" }, "defines": { "ANY": "has(extra)" } } ] })J"},
       {"middle.json", R"J({ "inputs": ["extra ?"], "passes": [ { "include": "inner.json" } ] })J"},
       {"outer.json", R"J({ "resources": { )J" + top + R"J( }, "passes": [ { "include": "middle.json" )J" +
                          bind + R"J( } ], "present": "middle.inner.res" })J"}});
}

}  // namespace

TEST_CASE("an optional input without a resource has nothing, through any number of includes") {
  const Expanded none = expandInside("", "extra as linear");
  REQUIRE_MESSAGE(none.graph, none.text());
  CHECK(none.useText("middle.inner.go", "extra") == "-");
  CHECK(none.define("middle.inner.go", "ANY") == "0");
  const Expanded same = expandInside(R"J("extra": "@environment")J", "extra as linear");
  REQUIRE_MESSAGE(same.graph, same.text());
  CHECK(same.useText("middle.inner.go", "extra") == "@environment");
  CHECK(same.define("middle.inner.go", "ANY") == "1");
  const Expanded bound = expandInside("", "extra", R"J(, "bind": { "extra": "@environment" })J");
  REQUIRE_MESSAGE(bound.graph, bound.text());
  CHECK(bound.useText("middle.inner.go", "extra") == "@environment");
}

TEST_CASE("a '?' at a slot that reads an optional input is said twice") {
  const Expanded twice = expandInside("", "extra as linear ?");
  REQUIRE_MESSAGE(twice.graph, twice.text());
  CHECK(twice.of(Code::unusedDeclaration).severity == text::Severity::warning);
  CHECK(expandInside("", "extra").diagnostics.empty());
}

TEST_CASE("an input that is bound to what is not there is an error also where it is optional") {
  CHECK(expandInside("", "extra", R"J(, "bind": { "extra": "othr" })J").has(Code::unknownResource));
  CHECK(expandInside("", "extra", R"J(, "bind": ["othr"])J").has(Code::badBind));
}

TEST_CASE("an optional input without a resource has no size") {
  const Expanded none = expandInside("", "extra", "", R"J("size(extra)")J");
  CHECK(none.of(Code::conditionLeavesSlotEmpty)
            .message.starts_with("'middle.extra' has no size: nothing is bound to this input"));
  CHECK_FALSE(none.graph);
}

TEST_CASE("a pass may modify an optional input: a resource, nothing, but no import") {
  const auto with = [](const std::string& resources, const std::string& passes, const std::string& bind,
                       const std::string& modified = "tested") {
    return expandFiles(
        "expand_optional",
        {{"inner.json", R"J({ "inputs": ["tested ?"], "resources": { "res": { "texture": "rgba8" } },
      "passes": [ { "name": "go", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "res" },
                    "modify": { "tested": ")J" +
                            modified + R"J(" }, "state": { "depth_test": "equal" } } ] })J"},
         {"outer.json", R"J({ "resources": { )J" + resources + R"J( }, "passes": [ )J" + passes +
                            R"J( { "include": "inner.json" )J" + bind +
                            R"J( } ], "present": "inner.res" })J"}});
  };
  const Expanded none = with("", "", "");
  REQUIRE_MESSAGE(none.graph, none.text());
  CHECK(none.useText("inner.go", "tested") == "-");
  const Expanded bound =
      with(R"J("d": { "texture": "depth32f" })J",
           R"J({ "name": "first", "type": "fullscreen", "shader": "a.frag.glsl", "write": ["d"] },)J",
           R"J(, "bind": { "tested": "d" })J");
  REQUIRE_MESSAGE(bound.graph, bound.text());
  CHECK(bound.useText("inner.go", "tested") == "d");
  CHECK_FALSE(with("", "", R"J(, "bind": { "tested": "@environment" })J").graph);
  CHECK(with("", "", "", "tested@-1").has(Code::notWritable));
}
