// `like`: a pass that takes over the keys of another, from the file to the flat graph.
#include <doctest/doctest.h>

#include <algorithm>

#include "engine/graph/edit/write_back.h"
#include "tests/graph/expand/support.h"
#include "tests/graph/test_folder.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

constexpr const char* kHead = R"J({ "parameters": { "steps": { "default": 2.0 } },
  "resources": { "hdr": { "texture": "rgba16f", "size": 4, "clear": 0 }, "small": { "texture": "rgba16f", "size": 4, "clear": 0 },
                 "depth": { "texture": "depth32f", "size": 4, "clear": 0 } },
  "passes": [
    { "name": "one", "type": "draw", "shader": "balls/round", "list": "spheres", "geometry": "quad", "enabled": "$steps > 1",
      "read": { "source": "small?", "other": "hdr@-1?" }, "modify": { "radiance": "hdr", "depth": "depth" },
      "parameters": { "steps": "$steps", "width": { "default": 0.5 }, "soft": { "default": true, "define": true } },
      "defines": { "ROUND": true, "COUNT": 3 }, "state": { "blend": { "radiance": "add" }, "depth_test": "greater" } },
)J";

Expanded expandWith(std::string passes, const Settings& settings = {}) {
  std::string text = std::string(kHead) + passes + R"J( ], "present": "hdr" })J";
  const std::size_t at = text.find(R"("hdr": { "texture": "rgba16f", "size": 4,)");
  text.insert(at + 41, R"( "history": 1,)");
  return expandText(text, settings);
}

std::string slotsOf(const Expanded& e, std::string_view pass) {
  const PassSpec& spec = e.spec(pass);
  std::string all;
  for (std::uint32_t i = spec.firstSlot; i < spec.firstSlot + spec.slotCount; ++i)
    all += (all.empty() ? "" : " ") + e.graph->slots[i].name;
  return all;
}

}  // namespace

TEST_CASE("like: every key of the other, with the own ones laid over them") {
  const Expanded e =
      expandWith(R"J({ "name": "two", "like": "one", "shader": "balls/flat", "geometry": "octagon",
      "read": { "source": null, "third": "small?" }, "defines": { "ROUND": null, "COUNT": 4 }, "state": { "blend": null, "cull": "back" } })J");
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.names() == "one two");
  CHECK(slotsOf(e, "one") == "source other radiance depth");
  CHECK(slotsOf(e, "two") == "other third radiance depth");
  CHECK(e.spec("two").type == "draw");
  CHECK(e.spec("two").shader == "balls/flat");
  CHECK(e.spec("two").list == "spheres");
  CHECK(e.spec("two").geometry == "octagon");
  CHECK(e.define("two", "ROUND") == "not defined");
  CHECK(e.define("two", "COUNT") == "4");
  CHECK(e.spec("one").state.blend.size() == 1);
  CHECK(e.spec("two").state.blend.empty());
  CHECK(e.spec("two").state.cull == Cull::back);
  CHECK(e.spec("two").state.depthTest);
  // `enabled` is one of the keys.
  const Expanded off =
      expandWith(R"J({ "name": "two", "like": "one" }, { "name": "three", "like": "one", "enabled": true })J",
                 with({{"steps", "0"}}));
  CHECK(off.names() == "three");
}

TEST_CASE("like: what the other declares stays one parameter") {
  const Expanded e = expandWith(
      R"J({ "name": "two", "like": "one" }, { "name": "three", "like": "two", "parameters": { "width": 7 } })J",
      with({{"width", "0.25"}, {"soft", "false"}}));
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.graph->parameters.size() == 3);
  CHECK(e.uniform("two", "width").value == Value::number(0.25));
  CHECK(e.uniform("two", "width").path == "one.width");
  CHECK(e.define("two", "SOFT") == "0");
  CHECK(e.define("three", "SOFT") == "0");
  CHECK(e.uniform("three", "width").value == Value::number(7));
  CHECK(e.uniform("three", "steps").path == "steps");
  const Expanded own =
      expandWith(R"J({ "name": "two", "like": "one", "parameters": { "width": { "default": 9.0 } } })J");
  CHECK(own.graph->parameters.size() == 4);
  CHECK(own.uniform("two", "width").path == "two.width");
}

TEST_CASE("like: mistakes are reported once, where they stand") {
  const auto errors = [](const std::string& passes) {
    text::Diagnostics diagnostics;
    readGraphText(kHead + passes + R"J( ], "present": "hdr" })J", "test.json", diagnostics);
    return diagnostics;
  };
  CHECK(errors(R"J({ "name": "two", "like": "one" })J").text() == "");
  CHECK(errors(R"J({ "name": "two", "like": 3 })J").items().at(0).code == Code::wrongType);
  CHECK(errors(R"J({ "name": "two", "like": "on" })J").items().at(0).hint == "did you mean 'one'?");
  // What failed is no second mistake for those that are like it.
  CHECK(errors(R"J({ "name": "two", "like": "on" }, { "name": "three", "like": "two" })J").size() == 1);
  // An include is no pass.
  CHECK(errors(R"J({ "include": "nowhere.json", "as": "x" }, { "name": "two", "like": "x" })J")
            .contains(Code::likeNothing));
  const text::Diagnostics twice = errors(
      R"J({ "name": "two", "type": "fullscreen", "shader": "a.frag.glsl", "blond": 1, "read": { "a": "hdr[" } },
    { "name": "three", "like": "two", "statr": {} })J");
  REQUIRE_MESSAGE(twice.size() == 3, twice.text());
  CHECK(twice.items()[0].place.line == 9);
  CHECK(twice.items()[1].place.line == 9);
  CHECK(twice.items()[2].place.line == 10);
  CHECK(twice.items()[2].hint == "did you mean \"state\"?");
}

TEST_CASE("like: overlays change the other for both, and take away what is written there") {
  const TestFolder folder("like_test_files");
  folder.write("base.json",
               std::string(kHead) +
                   R"J({ "name": "two", "like": "one", "defines": { "OWN": true } } ], "present": "hdr" })J");
  const auto over = [&](const std::string& passes) {
    Expanded e;
    const auto desc = readGraph(
        folder.write("over.json",
                     R"J({ "extends": "base.json", "resources": { "hdr": { "history": 1 } }, "passes": [ )J" +
                         passes + " ] }"),
        e.diagnostics);
    REQUIRE_MESSAGE(desc, e.text());
    e.graph = expandGraph(*desc, testRegistry(), {}, e.diagnostics);
    REQUIRE_MESSAGE(e.graph, e.text());
    return e;
  };
  const Expanded both = over(R"J({ "name": "one", "shader": "balls/cube", "read": { "more": "small?" } })J");
  CHECK(both.spec("two").shader == "balls/cube");
  CHECK(slotsOf(both, "two") == "source other more radiance depth");
  const Expanded less =
      over(R"J({ "name": "two", "read": { "source": null }, "defines": { "OWN": null, "ROUND": null } })J");
  CHECK(slotsOf(less, "one") == "source other radiance depth");
  CHECK(slotsOf(less, "two") == "other radiance depth");
  CHECK(less.define("two", "OWN") == "not defined");
  CHECK(less.define("two", "ROUND") == "not defined");
  CHECK(less.define("two", "COUNT") == "3");
  const Expanded fresh =
      over(R"J({ "after": "two", "name": "three", "like": "one", "geometry": "octagon" })J");
  CHECK(fresh.names() == "one two three");
  CHECK(fresh.spec("three").geometry == "octagon");
}

TEST_CASE("like: written back, a disabled pass keeps what it is like") {
  const TestFolder folder("like_test_files");
  const std::string path = folder.write("graph.json", R"J({
  "resources": { "hdr": { "texture": "rgba16f", "size": 4, "clear": 0 } },
  "passes": [
    { "name": "one", "type": "fullscreen", "shader": "a.frag.glsl", "modify": { "radiance": "hdr" },
      "parameters": { "width": { "default": 0.5 } } },
    { "name": "two", "like": "one" } // the other
  ],
  "present": "hdr"
})J");
  text::Diagnostics diagnostics;
  const auto desc = readGraph(path, diagnostics);
  REQUIRE(desc);
  const auto plan = planWriteBack(*desc, {}, testRegistry(), with({{"width", "2"}}, {"two"}), diagnostics);
  REQUIRE_MESSAGE(plan, diagnostics.text());
  REQUIRE(plan->files.size() == 1);
  CHECK(plan->files[0].after.find(R"("width": { "default": 2.0 })") != std::string::npos);
  CHECK(plan->files[0].after.find(R"({ "name": "two", "like": "one", "enabled": false } // the other)") !=
        std::string::npos);
}
