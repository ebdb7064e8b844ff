// Lists of names, sampling said at resources, and what "bind" takes from an include.
#include <doctest/doctest.h>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

const std::string kMaps =
    R"J("resources": { "sky": { "texture": "rgba16f", "size": 8, "sample": "linear wrap", "clear": 0 },
    "map": { "texture": "rgba16f", "size": 8, "clear": 0 }, "depth": { "texture": "depth32f", "size": 8, "clear": 0, "sample": "compare(less)" },
    "either": ["sky as mirror if $first", "sky"], "ldr": { "texture": "rgba8", "size": 8 } })J";

Expanded expandRead(const std::string& read, const std::string& more = "") {
  return expandText(
      R"J({ "parameters": { "gain": { "default": 2.0 }, "first": { "default": true } }, )J" + kMaps +
      R"J(, "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "read": )J" + read +
      R"J(, "write": ["ldr"])J" + more + R"J( } ], "present": "ldr" })J");
}

Sampler samplerOf(const std::string& ref) {
  const Expanded e = expandRead(R"J({ "s": ")J" + ref + R"J(" })J");
  REQUIRE_MESSAGE(e.graph, e.text());
  return e.slot("p", "s").sampler;
}

}  // namespace

TEST_CASE("an item of a list is called by the last word of its name") {
  const Expanded e =
      expandRead(R"J(["@environment as linear wrap", { "a": "map" }, "sky as nearest", "map"])J",
                 R"J(, "parameters": ["$gain", { "b": 3 }])J");
  REQUIRE_MESSAGE(e.graph, e.text());
  CHECK(e.useText("p", "environment") == "@environment");
  CHECK(e.useText("p", "a") == "map");
  CHECK(e.useText("p", "map") == "map");
  CHECK(e.slot("p", "environment").sampler.wrap == Wrap::repeat);
  CHECK(e.uniform("p", "gain").value == Value::number(2));
  CHECK(e.uniform("p", "b").value == Value::number(3));
  CHECK(e.slot("p", "ldr").access == Access::write);
}

TEST_CASE("the words nearest to the use say how it is sampled") {
  CHECK(samplerOf("map") == Sampler{});
  CHECK(samplerOf("sky") == Sampler{.linear = true, .wrap = Wrap::repeat});
  CHECK(samplerOf("sky as linear") == Sampler{.linear = true});
  CHECK(samplerOf("sky as nearest") == Sampler{});
  CHECK(samplerOf("either") == Sampler{.wrap = Wrap::mirror});
  CHECK(samplerOf("either as border") == Sampler{.wrap = Wrap::border});
  CHECK(samplerOf("depth") == Sampler{.linear = true, .compare = true, .function = Compare::less});
  CHECK(samplerOf("depth as nearest") == Sampler{});
}

TEST_CASE("what a resource says of sampling is for those that sample it") {
  const Expanded e =
      expandText(R"J({ )J" + kMaps + R"J(, "parameters": { "first": { "default": true } }, "passes": [
    { "name": "store", "type": "compute", "shader": "a.comp.glsl", "read": { "s": "sky as image" }, "write": ["map"] },
    { "name": "draw", "type": "draw", "shader": "a", "geometry": "quad", "instances": 1, "modify": ["sky", "depth"],
      "state": { "depth_test": "less" } },
    { "name": "copy", "type": "blit", "read": { "source": "sky" }, "write": { "destination": "ldr" } } ], "present": "ldr" })J");
  REQUIRE_MESSAGE(e.graph, e.text());
  CHECK(e.slot("draw", "sky").sampler == Sampler{});
  CHECK(e.slot("draw", "depth").sampler == Sampler{});
  CHECK(e.slot("copy", "source").sampler == Sampler{});
}

TEST_CASE("an input says how it is sampled before what is bound to it") {
  const auto sampler = [](const std::string& inner, const std::string& middle, const std::string& outer) {
    const Expanded e = expandFiles(
        "expand_sample",
        {{"inner.json", R"J({ "inputs": ["sky)J" + inner +
                            R"J("], "resources": { "res": { "texture": "rgba8", "size": 4 } },
    "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "read": ["sky"], "write": ["res"] } ] })J"},
         {"middle.json",
          R"J({ "inputs": ["sky)J" + middle + R"J("], "passes": [ { "include": "inner.json" } ] })J"},
         {"outer.json",
          R"J({ "resources": { "sky": { "texture": "rgba8", "size": 2, "clear": 0)J" + outer +
              R"J( } }, "passes": [ { "include": "middle.json" } ], "present": "middle.inner.res" })J"}});
    REQUIRE_MESSAGE(e.graph, e.text());
    return e.slot("middle.inner.p", "sky").sampler;
  };
  const std::string linear = R"J(, "sample": "linear")J";
  CHECK(sampler("", "", linear) == Sampler{.linear = true});
  CHECK(sampler("", " as wrap", linear) == Sampler{.wrap = Wrap::repeat});
  CHECK(sampler(" as mirror", " as wrap", linear) == Sampler{.wrap = Wrap::mirror});
  CHECK(sampler(" as nearest", "", linear) == Sampler{});
}

TEST_CASE("bind takes all that an include has of the inputs, but for what is named") {
  const auto maps = [](const std::string& bind) {
    return expandFiles(
        "expand_bind_include",
        {{"light.json",
          R"J({ "inputs": ["own ?"], "resources": { "a": { "texture": "rgba8", "size": 2, "clear": 0 },
            "b": { "texture": "rgba8", "size": 2, "clear": 0 } }, "passes": [] })J"},
         {"draw.json",
          R"J({ "inputs": ["a", "b", "own ?"], "resources": { "res": { "texture": "rgba8", "size": 4 } },
    "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "read": ["a", "b", "own"], "write": ["res"] } ] })J"},
         {"outer.json",
          R"J({ "resources": { "a": { "texture": "rgba8", "size": 2, "clear": 0 }, "c": { "texture": "rgba8", "size": 2, "clear": 0 } },
    "passes": [ { "include": "draw.json", "bind": )J" +
              bind + R"J( }, { "include": "light.json" } ], "present": "draw.res" })J"}});
  };
  const Expanded all = maps(R"J(["light"])J");
  CHECK(all.text() == "");
  CHECK(all.useText("draw.p", "a") == "light.a");
  CHECK(all.useText("draw.p", "b") == "light.b");
  CHECK(all.useText("draw.p", "own") == "-");  // an input of the include is none of its resources
  const Expanded but = maps(R"J([{ "b": "c" }, "light"])J");
  CHECK(but.useText("draw.p", "a") == "light.a");
  CHECK(but.useText("draw.p", "b") == "c");
  CHECK(maps(R"J(["light", "a"])J").useText("draw.p", "a") == "a");
  CHECK(maps("{}").has(Code::unboundInput));
  CHECK(maps("{}").of(Code::unboundInput).hint.find("draw.b'") == std::string::npos);  // itself
}
