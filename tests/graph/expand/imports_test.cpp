// Imports that are more than one texture or buffer: arrays of textures, and tables whose elements are views.
#include <doctest/doctest.h>

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
