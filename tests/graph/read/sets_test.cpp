// Sets: what passes share, from the file to the flat graph.
#include <doctest/doctest.h>

#include <algorithm>

#include "engine/graph/edit/edit.h"
#include "engine/graph/expand/expand.h"
#include "tests/graph/expand/support.h"
#include "tests/graph/test_folder.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

constexpr const char* kHead = R"J({ "parameters": { "steps": { "default": 2.0 } },
  "resources": { "hdr": { "texture": "rgba16f", "size": 8, "mips": 4, "clear": 0 }, "small": { "texture": "rgba16f", "size": 4, "clear": 0 },
                 "depth": { "texture": "depth32f", "size": 8, "clear": 0 } },
  "sets": { "lens": { "read": { "source": "small?" }, "parameters": { "steps": "$steps" }, "defines": { "ROUND": true } },
            "ball": { "modify": { "radiance": "hdr.mip[0]", "depth": "depth" }, "state": { "blend": { "radiance": "add" }, "depth_test": "greater" } },
            "level": { "read": { "above": "hdr.mip[i-1]" } } },
  "passes": [
    { "name": "one", "type": "draw", "shader": "balls/round", "list": "spheres", "geometry": "quad", "use": ["lens", "ball"],
      "read": { "other": "small?" }, "defines": { "COUNT": 3 } },
)J";

std::string fileWith(const std::string& passes) {
  return kHead + passes + R"J( ], "present": "hdr.mip[0..]" })J";
}

constexpr const char* kTwo =
    R"J({ "name": "two", "type": "draw", "shader": "balls/flat", "list": "spheres", "geometry": "octagon",
      "use": "ball", "state": { "cull": "back" } },
    { "name": "down", "type": "fullscreen", "shader": "d.frag.glsl", "use": "level", "repeat": { "i": [1, 3] },
      "write": { "result": "hdr.mip[i]" } })J";

std::string slotsOf(const Expanded& e, std::string_view pass) {
  const PassSpec& spec = e.spec(pass);
  std::string all;
  for (std::uint32_t i = spec.firstSlot; i < spec.firstSlot + spec.slotCount; ++i)
    all += (all.empty() ? "" : " ") + e.graph->slots[i].name;
  return all;
}

}  // namespace

TEST_CASE("sets: a pass has its own and what its sets have, for each index of its repeat") {
  const Expanded e = expandText(fileWith(kTwo));
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.names() == "one two down[1] down[2] down[3]");
  CHECK(slotsOf(e, "one") == "source other radiance depth");
  CHECK(slotsOf(e, "two") == "radiance depth");
  CHECK(slotsOf(e, "down[2]") == "above result");
  CHECK(e.define("one", "ROUND") == "1");
  CHECK(e.define("one", "COUNT") == "3");
  CHECK(e.define("two", "ROUND") == "not defined");
  CHECK(e.uniform("one", "steps").path == "steps");
  CHECK(e.spec("one").state.cull == Cull::none);
  CHECK(e.spec("two").state.cull == Cull::back);
  CHECK(e.spec("two").state.depthTest);
  CHECK(e.spec("two").state.colors.size() == 1);
  const FlatGraph& graph = *e.graph;
  const SlotSpec& above = graph.slots[e.spec("down[3]").firstSlot];
  CHECK(graph.uses[above.firstUse].mip == 2);
}

TEST_CASE("sets: a pass has any key of them that says what it does") {
  const Expanded e = expandText(R"J({
    "resources": { "hdr": { "texture": "rgba16f", "size": 8, "mips": 4, "clear": 0 } },
    "sets": { "levels": { "update": "on_change", "read": { "above": "hdr.mip[i-1]" } },
              "quads": { "type": "draw", "shader": "balls/flat", "geometry": "quad", "instances": 3, "side_effect": true } },
    "passes": [ { "name": "down", "use": ["quads", "levels"], "repeat": { "i": [1, 3] }, "modify": { "radiance": "hdr.mip[i]" } } ],
    "present": "hdr.mip[0..]" })J");
  REQUIRE_MESSAGE(e.text() == "", e.text());
  CHECK(e.names() == "down[1] down[2] down[3]");
  CHECK(slotsOf(e, "down[2]") == "above radiance");
  CHECK(e.spec("down[1]").type == "draw");
  CHECK(e.spec("down[1]").instances == 3);
  CHECK(e.graph->passes[0].cadence == Cadence::on_change);
  CHECK(e.graph->passes[0].sideEffect);
}

TEST_CASE("sets: mistakes in one are told once, whoever uses it, and where it stands") {
  const auto errors = [](const std::string& sets, const std::string& use) {
    text::Diagnostics diagnostics;
    std::string passes;
    for (const char* name : {"a", "b"})
      passes += std::string(passes.empty() ? "" : ",\n") + R"({ "name": ")" + name +
                R"(", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "hdr" }, "use": )" +
                use + " }";
    readGraphText(R"({ "resources": { "hdr": { "texture": "rgba16f", "size": 4 } }, "sets": {)" + sets +
                      R"(}, "passes": [)" + "\n" + passes + R"(], "present": "hdr" })",
                  "test.json", diagnostics);
    return diagnostics;
  };
  CHECK(errors(R"("s": { "read": { "source": "hdr@-1?" } })", R"("s")").text() == "");
  const text::Diagnostics bad = errors(R"("s": { "read": { "source": "hdr[" } })", R"("s")");
  REQUIRE(bad.size() == 1);
  CHECK(bad.items()[0].place.line == 1);
  CHECK(bad.items()[0].pass == "a");
  // Of two sets, and of a set and the pass: each at the later one.
  const text::Diagnostics two =
      errors(R"("s": { "read": { "source": "hdr" } }, "t": { "defines": { "source": 1 } })", R"(["s", "t"])");
  REQUIRE(two.size() == 1);
  CHECK(two.items()[0].code == Code::duplicateName);
  CHECK(two.items()[0].place.line == 1);
  const text::Diagnostics own = errors(R"("s": { "read": { "result": "hdr" } })", R"("s")");
  REQUIRE(own.size() == 2);  // in each of the passes
  CHECK(own.items()[0].place.line == 2);
  CHECK(errors(R"("s": {})", "3").items().at(0).code == Code::wrongType);
  CHECK(errors(R"("s": 3)", R"("s")").items().at(0).code == Code::wrongType);
  // Several passes agree on a name that is not declared: the declaration is misspelt.
  const text::Diagnostics misspelt = errors(R"("sume": {})", R"("some")");
  REQUIRE(misspelt.size() == 1);
  CHECK(misspelt.items()[0].place.line == 1);
  CHECK(misspelt.items()[0].hint == "did you mean 'some'?");
}

TEST_CASE("sets: overlays change a set for all that use it, and what a pass has of it for that pass alone") {
  const TestFolder folder("sets_test_files");
  folder.write("base.json", fileWith(kTwo));
  const auto over = [&](const std::string& rest) {
    Expanded e;
    const auto desc =
        readGraph(folder.write("over.json", R"J({ "extends": "base.json", )J" + rest + " }"), e.diagnostics);
    REQUIRE_MESSAGE(desc, e.text());
    e.graph = expandGraph(*desc, testRegistry(), {}, e.diagnostics);
    REQUIRE_MESSAGE(e.graph, e.text());
    CHECK_MESSAGE(e.text() == "", e.text());
    return e;
  };
  const Expanded both = over(R"J("sets": { "ball": { "state": { "blend": null } } })J");
  CHECK(both.spec("one").state.colors.empty());
  CHECK(both.spec("two").state.colors.empty());
  const Expanded one = over(
      R"J("passes": [ { "name": "one", "read": { "source": null, "third": "small?" }, "state": { "blend": null } } ])J");
  CHECK(slotsOf(one, "one") == "other third radiance depth");
  CHECK(one.define("one", "ROUND") == "1");
  CHECK(one.spec("one").state.colors.empty());
  CHECK(one.spec("two").state.colors.size() == 1);
  const Expanded typed = over(
      R"J("sets": { "small": { "type": "draw", "list": "spheres", "geometry": "quad" } }, "passes": [ { "after": "two",
      "name": "three", "shader": "balls/flat", "use": ["small", "ball"] } ])J");
  CHECK(typed.spec("three").geometry == "quad");
  const Expanded fresh = over(
      R"J("sets": { "front": { "state": { "cull": "front" } } }, "passes": [ { "after": "two", "name": "three",
      "type": "draw", "shader": "balls/flat", "list": "spheres", "geometry": "quad", "use": ["ball", "front"] } ])J");
  CHECK(fresh.spec("three").state.cull == Cull::front);
  const Expanded other = over(R"J("passes": [ { "name": "one", "use": "ball" } ])J");
  CHECK(slotsOf(other, "one") == "other radiance depth");
}

TEST_CASE("sets: a pass that is disabled is written back beside them") {
  const TestFolder folder("sets_test_files");
  const std::string path = folder.write("graph.json", fileWith(kTwo));
  text::Diagnostics diagnostics;
  const auto desc = readGraph(path, diagnostics);
  REQUIRE(desc);
  const auto plan = planWriteBack(*desc, {}, testRegistry(), with({{"steps", "3"}}, {"two"}), diagnostics);
  REQUIRE_MESSAGE(plan, diagnostics.text());
  REQUIRE(plan->files.size() == 1);
  CHECK(plan->files[0].after.find(R"("steps": { "default": 3.0 })") != std::string::npos);
  CHECK(plan->files[0].after.find(R"("shader": "balls/flat", "enabled": false, "list")") !=
        std::string::npos);
}

TEST_CASE("sets: names of sets lead to where they are declared") {
  const TestFolder folder("sets_test_files");
  folder.write("part.json",
               R"J({ "inputs": ["out"], "sets": { "over": { "state": { "cull": "back" } } }, "passes": [
    { "name": "p", "type": "draw", "shader": "balls/flat", "list": "spheres", "geometry": "quad", "use": "over", "modify": { "radiance": "out" } } ] })J");
  folder.write(
      "base.json",
      R"J({ "resources": { "out": { "texture": "r8", "size": 4, "clear": 0 } }, "passes": [ { "include": "part.json" } ], "present": "out" })J");
  text::Diagnostics diagnostics;
  const auto desc = readGraph(
      folder.write("over.json",
                   R"J({ "extends": "base.json", "sets": { "part.over": { "state": { "cull": "front" } } },
    "passes": [ { "after": "part.p", "name": "q", "type": "draw", "shader": "balls/flat", "list": "spheres", "geometry": "quad",
      "use": "part.over", "modify": { "radiance": "out" } } ] })J"),
      diagnostics);
  REQUIRE_MESSAGE(desc, diagnostics.text());
  std::size_t uses = 0;
  for (const NameUse& use : findNameUses(*desc, testRegistry()))
    if (use.kind == NameUse::Kind::set) {
      CHECK(use.name == "over");
      CHECK(use.full == "part.over");
      CHECK(use.declared.file->ends_with("part.json"));
      ++uses;
    }
  CHECK(uses == 4);  // its key, in p, and twice in the overlay
}
