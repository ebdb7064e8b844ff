// Imports that are more than one texture or buffer: arrays of textures, and tables whose elements are views.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

Registry registryOf() {
  Registry registry = testRegistry();
  registry.imports.push_back({.name = "maps", .kind = ImportKind::texture, .doc = "", .array = 3});
  registry.imports.push_back({.name = "lights", .kind = ImportKind::buffer, .doc = "", .views = true});
  registry.imports.push_back({.name = "rows", .kind = ImportKind::buffer, .doc = ""});
  const auto others = registry.factsOf;
  registry.factsOf = [others](const ImportRequest& request) -> ImportFacts {
    if (request.type == "maps")
      return {.exists = true, .format = Format::rgba8, .width = 8, .height = 8, .mips = 4, .layered = true};
    if (request.type == "lights" || request.type == "rows") return {.exists = true, .count = 4};
    return others(request);
  };
  return registry;
}

Expanded expandPass(const std::string& passes) {
  return expandText(R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 },
      "depth": { "texture": "depth32f", "size": 8, "clear": 0 } }, "passes": [ )J" +
                        passes + R"J( ], "present": "out" })J",
                    {}, registryOf());
}

std::string fill(const std::string& rest) {
  return R"J({ "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "out" }, )J" +
         rest + " }";
}

}  // namespace

TEST_CASE("an import that is an array fills one slot with all its textures, each asked for by its element") {
  const Expanded e = expandPass(fill(R"J("read": { "maps": "@maps as linear wrap", "one": "@maps[1]" })J"));
  REQUIRE_MESSAGE(e.text() == "", e.text());
  REQUIRE(e.graph->imports.size() == 3);
  const auto slotOf = [&](std::string_view name) -> const SlotSpec& {
    for (const SlotSpec& slot : e.graph->slots)
      if (slot.name == name) return slot;
    REQUIRE(false);
    return e.graph->slots[0];
  };
  const SlotSpec& maps = slotOf("maps");
  CHECK(maps.array);
  REQUIRE(maps.useCount == 3);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const FlatResource& resource = e.graph->resources[e.graph->uses[maps.firstUse + k].resource];
    CHECK(resource.target == Target::texture_2d_array);  // also with one layer
    CHECK(elementOf(e.graph->imports[resource.import].request) == k);
  }
  const SlotSpec& one = slotOf("one");
  REQUIRE(one.useCount == 1);
  CHECK(e.graph->uses[one.firstUse].resource == e.graph->uses[maps.firstUse + 1].resource);
  CHECK(expandPass(fill(R"J("read": { "one": "@maps[3]" })J")).diagnostics.hasErrors());
  CHECK(expandPass(fill(R"J("read": { "one": "@rows[1]" })J")).diagnostics.hasErrors());
}

TEST_CASE("a table whose elements are views is read and looked from; another is not") {
  const auto pass = [](const std::string& view) {
    return fill(R"J("view": ")J" + view + R"J(", "read": { "lights": "@lights" })J");
  };
  const Expanded e = expandPass(pass("@lights[2].face[5]"));
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.graph->imports[e.spec("p").view].request.type == "lights");
  CHECK(e.spec("p").viewLayer == 2);
  CHECK(e.spec("p").viewFace == 5);
  CHECK(expandPass(pass("@lights[4]")).diagnostics.hasErrors());  // there are four
  const Expanded none = expandPass(pass("@rows"));
  CHECK(none.of(text::Code::notAView).expected.find("@lights") != std::string::npos);
}

TEST_CASE("meshes are drawn of a list") {
  const std::string draw =
      R"J({ "name": "p", "type": "draw", "shader": "a", "geometry": "mesh", "modify": { "d": "depth" }, )J";
  const Expanded listed = expandPass(fill(R"J("read": { "d": "depth" })J") + ", " + draw +
                                     R"J("side_effect": true, "list": "opaque" })J");
  INFO(listed.text());
  CHECK_FALSE(listed.diagnostics.contains(text::Code::keyNeeded));
  const Expanded bare = expandPass(draw + R"J("instances": 2 })J");
  CHECK(bare.of(text::Code::keyNeeded).expected.find("\"list\"") != std::string::npos);
}

namespace {

// A file with `resources` and draws with `draw`, which includes part.json with `include`.
Expanded expandAround(const std::string& resources, const std::string& draw, const std::string& part = "",
                      const std::string& include = "") {
  const std::string out = R"J("out": { "texture": "rgba8", "size": "screen", "clear": 0 })J";
  const std::string pass =
      R"J({ "name": "p", "type": "draw", "shader": "a", "side_effect": true, "modify": { "r": "out" }, )J";
  return expandFiles(
      "expand_imports",
      {{"part.json",
        "{ \"resources\": { " + out + part + " }, \"passes\": [ " + pass +
            R"J("list": "spheres", "geometry": "quad", "read": { "order": "@draw_order" } } ] })J"},
       {"main.json",
        "{ \"resources\": { " + out + resources + " }, \"passes\": [ " + pass + draw + " }" +
            (include.empty() ? "" : R"J(, { "include": "part.json", "as": "part", )J" + include + " }") +
            R"J( ], "present": ")J" + (include.empty() ? "" : "part.") + R"J(out" })J"}});
}

}  // namespace

TEST_CASE("a draw list of the graph's own is drawn, counted, and named by other imports") {
  const Expanded e = expandAround(
      R"J(, "marked": { "import": "draw_list", "name": "two words*", "order": "front_to_back" },
            "balls": { "import": "draw_list", "of": "spheres" }, "order": { "import": "draw_order", "list": "balls" })J",
      R"J("list": "marked", "geometry": "mesh", "read": { "order": "order" }, "parameters": { "n": "count(marked)" })J");
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK_FALSE(e.has(text::Code::unusedDeclaration));
  const PassSpec& p = e.spec("p");
  CHECK(e.graph->imports[p.listImport].request.at("name").symbol == "two words*");
  CHECK(p.uniforms.at(0).value.v[0] == 3);
  const auto order = std::ranges::find(e.graph->imports, "order", &ImportSpec::name);
  REQUIRE(order != e.graph->imports.end());
  REQUIRE(order->request.named("list"));
  CHECK(order->request.named("list")->at("of").symbol == "spheres");
  ImportRequest other = order->request;
  other.of.clear();
  CHECK(keyOf(other) != order->key);
  CHECK_FALSE(other == order->request);
}

TEST_CASE(
    "a list that is not there is told with the nearest, and an order of meshes where spheres are drawn") {
  const std::string marked = R"J(, "marked": { "import": "draw_list", "order": "front_to_back" })J";
  CHECK(
      expandAround(marked, R"J("list": "markd", "geometry": "mesh")J").of(text::Code::unknownDrawList).hint ==
      "did you mean 'marked'?");
  CHECK(expandAround(marked, R"J("list": "marked", "geometry": "quad")J").has(text::Code::keyNotTaken));
  CHECK(expandAround(R"J(, "o": { "import": "draw_order", "list": "markd" })J" + marked,
                     R"J("list": "marked", "geometry": "mesh", "read": { "o": "o" })J")
            .has(text::Code::unknownDrawList));
  const Expanded none = expandAround(R"J(, "rare": { "import": "draw_list", "tag": "rare" })J",
                                     R"J("list": "rare", "geometry": "mesh", "enabled": "has(rare)")J");
  CHECK(none.graph->disabled.size() == 1);
}

TEST_CASE("an include sees from the camera that is bound, which says what its own camera leaves out") {
  const std::string left = R"J(, "left": { "import": "camera", "focal_length": 35 })J";
  const std::string draw = R"J("list": "spheres", "geometry": "quad")J",
                    bind = R"J("bind": { "camera": "left" })J";
  for (const std::string own : {"", R"J(, "camera": { "import": "camera", "jitter": 8 })J"}) {
    CAPTURE(own);
    const Expanded e = expandAround(left, draw, own, bind);
    REQUIRE_MESSAGE(e.text() == "", e.text());
    CHECK(e.spec("p").view == kNone);
    const ImportRequest& view = e.graph->imports[e.spec("part.p").view].request;
    CHECK(view.at("focal_length").v[0] == 35);
    CHECK(view.at("jitter").v[0] == (own.empty() ? 0 : 8));
    const std::uint32_t order = e.graph->resources[e.use("part.p", "order").resource].import;
    REQUIRE(e.graph->imports[order].request.named("view"));
    CHECK(*e.graph->imports[order].request.named("view") == view);
  }
  CHECK(expandAround("", draw, "", R"J("bind": { "camera": "out" })J").has(text::Code::badBind));
  CHECK(expandAround("", draw, R"J(, "camera": { "import": "camera" })J",
                     R"J("bind": { "camera": "@screen_view" })J")
            .has(text::Code::badBind));
}

TEST_CASE(
    "a screen of an include is that of its file and of what that includes, and may follow the outer one") {
  const std::string draw = R"J("list": "spheres", "geometry": "quad")J";
  const auto sizeOf = [&](const std::string& screen) {
    const Expanded e = expandAround("", draw, "", R"J("screen": ")J" + screen + "\"");
    REQUIRE_MESSAGE(e.text() == "", e.text());
    CHECK(e.spec("p").screen == std::array<std::uint32_t, 2>{1280, 720});
    CHECK(e.spec("part.p").screen ==
          std::array<std::uint32_t, 2>{e.resource("part.out").width, e.resource("part.out").height});
    return e.spec("part.p").screen;
  };
  CHECK(sizeOf("screen/3") == std::array<std::uint32_t, 2>{426, 240});
  CHECK(sizeOf("64") == std::array<std::uint32_t, 2>{64, 64});
  CHECK(expandAround("", draw, "", R"J("screen": "size(part.out)")J").has(text::Code::dependsOnItself));
  CHECK(expandAround("", draw, "", R"J("screen": "0 * screen")J").has(text::Code::numberOutOfRange));
}
