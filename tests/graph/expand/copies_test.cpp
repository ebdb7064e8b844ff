// Which copies go texel by texel, and which need a blit.
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

TEST_CASE("a blit of equal formats and sizes is an exact copy, of levels and layers too; no other is") {
  const auto exact = [](const std::string& source, const std::string& destination,
                        const std::string& type = "blit") {
    const Expanded e = expandText(R"J({ "resources": {
      "a": { "texture": "rgba8", "size": 64, "mips": 3, "clear": 0 }, "b": { "texture": "rgba8", "size": 64, "clear": 0 },
      "half": { "texture": "rgba8", "size": 32, "clear": 0 }, "layers": { "texture": "rgba8", "size": 64, "layers": 2, "clear": 0 },
      "view": { "texture": "r32f", "size": 64, "clear": 0 }, "wide": { "texture": "rgba8", "size": [64, 32], "clear": 0 },
      "srgb": { "texture": "srgb8_a8", "size": 64, "clear": 0 }, "srgb2": { "texture": "srgb8_a8", "size": 64, "clear": 0 },
      "deep": { "texture": "depth32f", "size": 64, "clear": 0 }, "deep2": { "texture": "depth32f", "size": 64, "clear": 0 },
      "four": { "texture": "rgba8", "size": 64, "samples": 4, "clear": 0 },
      "cubes": { "texture": "rgba8", "size": 64, "view": "cube", "clear": 0 },
      "ids": { "texture": "r32ui", "size": 64, "clear": 0 }, "ids2": { "texture": "r32ui", "size": 64, "clear": 0 } },
      "passes": [ { "name": "p", "type": ")J" +
                                  type + R"J(", "side_effect": true, "read": { "source": ")J" + source +
                                  R"J(" }, "write": { ")J" + (type == "blit" ? "destination" : "result") +
                                  R"J(": ")J" + destination + R"J(" } } ], "present": "b" })J");
    REQUIRE_MESSAGE(e.graph, e.text());  // W089: most levels and layers are not used
    const bool both = e.use("p", "source").exact;
    for (const FlatUse& use : e.graph->uses) CHECK(use.exact == both);
    return both;
  };
  CHECK(exact("b", "a.mip[0]"));
  CHECK(exact("b as linear", "a.mip[0]"));  // every texel is met in its middle
  CHECK(exact("a.mip[1]", "half"));
  CHECK(exact("half", "a.mip[1]"));
  CHECK(exact("layers.layer[1]", "b"));
  CHECK(exact("b", "layers.layer[1]"));
  CHECK(exact("layers.layer[0]", "layers.layer[1]"));
  CHECK(exact("ids", "ids2"));
  CHECK_FALSE(exact("a.mip[1]", "b"));
  CHECK_FALSE(exact("wide", "b"));
  CHECK_FALSE(exact("view", "b"));
  CHECK_FALSE(exact("srgb", "srgb2"));
  CHECK_FALSE(exact("srgb", "b"));
  CHECK_FALSE(exact("deep", "deep2"));
  CHECK_FALSE(exact("four", "b"));
  CHECK_FALSE(exact("cubes.face[1]", "b"));
  CHECK_FALSE(exact("a.mip[0]", "a.mip[1..]", "mipmap"));
}

TEST_CASE("what a blit or a mipmap cannot do is refused") {
  const auto said = [](const std::string& source, const std::string& destination,
                       const std::string& type = "blit") {
    return expandText(R"J({ "resources": {
      "one": { "buffer": 64, "clear": 0 }, "two": { "buffer": 64 }, "large": { "buffer": 128, "clear": 0 },
      "many": { "texture": "rgba8", "size": 64, "array": 2, "clear": 0 },
      "a": { "texture": "rgba8", "size": 64, "mips": 3, "clear": 0 }, "b": { "texture": "rgba8", "size": 64, "clear": 0 },
      "layers": { "texture": "rgba8", "size": 64, "layers": 2, "clear": 0 },
      "cube": { "texture": "rgba8", "size": 64, "view": "cube", "clear": 0 },
      "deep": { "texture": "rgba8", "size": [8, 8, 8], "clear": 0 },
      "four": { "texture": "rgba8", "size": 64, "samples": 4, "clear": 0 }, "half": { "texture": "rgba8", "size": 32 },
      "eight": { "texture": "rgba8", "size": 64, "samples": 8 },
      "zs": { "texture": "depth24_stencil8", "size": 64, "clear": [0, 0] }, "z2": { "texture": "depth24_stencil8", "size": 64, "clear": [0, 0] },
      "shared": { "texture": "rgb9_e5", "size": 64, "clear": 0 },
      "ids": { "texture": "r32ui", "size": 64, "mips": 3, "clear": 0 } },
      "passes": [ { "name": "p", "type": ")J" +
                      type + R"J(", "side_effect": true, "read": { "source": ")J" + source +
                      R"J(" }, "write": { ")J" + (type == "blit" ? "destination" : "result") + R"J(": ")J" +
                      destination + R"J(" } } ], "present": "b" })J");
  };
  const Expanded copied = said("one", "two");
  REQUIRE_MESSAGE(copied.graph, copied.text());
  CHECK(copied.use("p", "source").kind == Kind::copy);
  CHECK_FALSE(copied.use("p", "source").exact);
  for (const auto& [source, destination] :
       std::vector<std::pair<std::string, std::string>>{{"one", "large"},
                                                        {"large", "two"},
                                                        {"one", "b"},
                                                        {"b", "two"},
                                                        {"@spheres", "two"},
                                                        {"a", "b"},
                                                        {"b", "a"},
                                                        {"layers", "b"},
                                                        {"b", "cube"},
                                                        {"deep", "b"},
                                                        {"four", "half"},
                                                        {"four", "eight"},
                                                        {"zs.stencil", "z2"},
                                                        {"b?", "a.mip[0]"}}) {
    CAPTURE(source);
    CAPTURE(destination);
    const Expanded e = said(source, destination);
    CHECK_MESSAGE(e.has(text::Code::badSlots), e.text());
  }
  CHECK(said("shared", "b").has(text::Code::badFormat));
  CHECK(said("zs as linear", "z2").has(text::Code::badFormat));
  CHECK(said("one as linear", "two").has(text::Code::badKind));
  CHECK(said("many", "b").has(text::Code::badKind));
  CHECK(said("b", "a.mip[0] as linear").has(text::Code::badKind));
  CHECK(said("four", "b").graph);
  CHECK(said("zs.stencil", "z2.stencil").graph);
  CHECK(said("one", "two", "mipmap").has(text::Code::badSlots));
  CHECK(said("ids.mip[0]", "ids.mip[1..]", "mipmap").has(text::Code::badFormat));
  CHECK(said("a.mip[0] as linear", "a.mip[1..]", "mipmap").has(text::Code::badKind));
}

TEST_CASE("a slot of a pass type without a shader takes what its type says: a texture, a buffer, or either") {
  Registry registry = testRegistry();
  for (const auto& [name, takes] :
       {std::pair{"of_textures", FixedSlot::Takes::texture},
        std::pair{"of_buffers", FixedSlot::Takes::buffer}, std::pair{"of_both", FixedSlot::Takes::either}})
    registry.passTypes.push_back({.name = name,
                                  .doc = "",
                                  .defaultReadTexture = Kind::copy,
                                  .defaultWriteTexture = Kind::copy,
                                  .keys = {},
                                  .fixedSlots = {{"result", Access::write, "", takes}}});
  const auto said = [&](const std::string& type, const std::string& result) {
    return expandText(
        R"J({ "resources": { "list": { "buffer": 64 }, "b": { "texture": "rgba8", "size": 4, "clear": 0 },
      "many": { "texture": "rgba8", "size": 4, "array": 2 } },
      "passes": [ { "name": "p", "type": ")J" +
            type + R"J(", "side_effect": true, "write": { "result": ")J" + result +
            R"J(" } } ], "present": "b" })J",
        {}, registry);
  };
  CHECK(said("of_textures", "b").graph);
  CHECK(said("of_buffers", "list").graph);
  CHECK(said("of_both", "b").graph);
  CHECK(said("of_both", "list").graph);
  CHECK(said("of_textures", "list").of(text::Code::badSlots).expected == "a texture");
  CHECK(said("of_buffers", "b").of(text::Code::badSlots).expected == "a buffer");
  CHECK(said("of_textures", "many").has(text::Code::badKind));
}
