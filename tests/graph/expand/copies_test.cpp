// What a blit or a mipmap takes.
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

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
      "shared": { "texture": "rgb9_e5", "size": 64, "clear": 0 }, "shared2": { "texture": "rgb9_e5", "size": 64 },
      "ids": { "texture": "r32ui", "size": 64, "mips": 3, "clear": 0 } },
      "passes": [ { "name": "p", "type": ")J" +
                      type + R"J(", "side_effect": true, "read": { "source": ")J" + source +
                      R"J(" }, "write": { ")J" + (type == "blit" ? "destination" : "result") + R"J(": ")J" +
                      destination + R"J(" } } ], "present": "b" })J");
  };
  const Expanded copied = said("one", "two");
  REQUIRE_MESSAGE(copied.graph, copied.text());
  CHECK(copied.use("p", "source").kind == Kind::copy);
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
  CHECK(said("shared", "shared2").has(text::Code::badFormat));
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
