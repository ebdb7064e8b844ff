// Mistakes in overlays and presets, each with its place.
#include <fmt/format.h>

#include "tests/graph/read/overlay_files.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using namespace weft::graph::test::overlays;
using text::Code;

TEST_CASE("values that do not fit are reported where they stand") {
  const Folder folder;
  const auto only = [&](const std::string& text) {
    const Expanded e = expandFile(folder.file("base.json"), {folder.write("p.json", text)});
    REQUIRE_MESSAGE(e.diagnostics.size() == 1, e.text());
    const text::Diagnostic& d = e.diagnostics.items()[0];
    REQUIRE(d.place.file);
    CHECK(*d.place.file == folder.file("p.json"));
    return text::nameOf(d.code) + " " + std::to_string(d.place.line) + ":" + std::to_string(d.place.column);
  };
  CHECK(only(R"({ "set": { "curve": "filmc" } })") == "W047 1:12");
  CHECK(only(R"({ "set": { "gain": 9 } })") == "W048 1:12");
  CHECK(only(R"({ "set": { "gian": 1 } })") == "W044 1:12");
  CHECK(only(R"({ "set": { "gain": null } })") == "W003 1:20");
  CHECK(only(R"({ "set": { "gain": [1, "x"] } })") == "W003 1:20");
  CHECK(only(R"({ "set": 3 })") == "W003 1:10");
  CHECK(only(R"([])") == "W003 1:1");
  CHECK(only(R"({ "passes": [ { "name": "a", "type": "compute" } ], "present": "x" })") == "W019 1:1");
  CHECK(only(R"({ "extends": "parts/post.json" })") == "W019 1:14");
  CHECK(only(R"({ "passes": [ { "name": "sohw", "enabled": false } ] })") == "W016 1:25");
  CHECK(expandFile(folder.file("base.json"), {folder.file("none.json")}).has(Code::unreadableFile));
}

TEST_CASE("a misspelt parameter that an expression and a set name is one mistake, at its declaration") {
  const Folder folder;
  const std::string base = folder.write("misspelt.json", R"({
    "parameters": { "gian": { "type": "float", "default": 1 } },
    "resources": { "out": { "texture": "rgba8", "size": 4 } },
    "passes": [ { "name": "a", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "color": "out" },
                  "parameters": { "gain": "$gain" } } ],
    "present": "out" })");
  const Expanded e = expandFile(base, {folder.write("p.json", R"({ "set": { "gain": 2 } })")});
  REQUIRE_MESSAGE(e.diagnostics.size() == 1, e.text());
  const text::Diagnostic& d = e.diagnostics.items()[0];
  CHECK(d.code == Code::unknownVariable);
  CHECK(*d.place.file == base);
  CHECK(d.place.line == 2);
}

TEST_CASE("what does not fit its base") {
  const Folder folder;
  const auto said = [&](const std::string& keys) { return wrong(folder.over(keys)); };
  CHECK(said(R"("passes": [ { "name": "nw", "type": "compute", "after": "shwo" } ])") ==
        "W016 over.json 1:83");
  CHECK(said(R"("passes": [ { "name": "nw", "remove": true } ])") == "W017 over.json 1:49");
  CHECK(said(R"("passes": [ { "name": "show", "remove": 1 } ])") == "W003 over.json 1:67");
  CHECK(said(R"("passes": [ { "name": "show", "after": 1 } ])") == "W003 over.json 1:66");
  CHECK(said(R"("passes": { })") == "W003 over.json 1:37");
  CHECK(said(R"("passes": [ 3 ])") == "W003 over.json 1:39");
  CHECK(said(R"("resources": { "glw": null })") == "W017 over.json 1:42");
  CHECK(said(R"("resources": { "a.glow": { "texture": "r8", "size": 1 } })") == "W017 over.json 1:42");
  CHECK(said(R"("resources": { "either": { "size": 1 } })") == "W018 over.json 1:42");
  CHECK(said(R"("resources": { "hdr": { "import": "camera" } })") == "W018 over.json 1:42");
  CHECK(said(R"("resources": { "hdr": { "texture": null, "size": null, "mips": null, "import": "camera" } })")
            .empty());
  CHECK(said(R"("parameters": { "gian": { "max": 2 } })") == "W017 over.json 1:43");
  CHECK(said(R"("passes": [ { "name": "show", "include": "parts/glow.json", "as": "show" } ])") ==
        "W018 over.json 1:68");
  CHECK(said(R"("outputs": { "x": null })") == "W017 over.json 1:40");
  CHECK(said(R"("presnt": "ldr")") == "W004 over.json 1:27");
  // a mistake in the base stays where it stands
  folder.write("base.json", "{ \"passes\": [\n { \"name\": \"p\", \"type\": 3 } ] }");
  CHECK(said("") == "W003 base.json 2:25");
  folder.write("base.json", "{ \"passes\": [");
  CHECK(said("") == "W002 base.json 1:14");
}

TEST_CASE(
    "a pass with a misspelt anchor stands where it was meant, so that its readers are no second mistake") {
  const Folder folder;
  text::Diagnostics diagnostics;
  const auto desc = readGraph(
      folder.over(R"("passes": [ { "name": "nw", "type": "compute", "before": "shwo" } ])"), diagnostics);
  REQUIRE(desc);
  CHECK(diagnostics.errorCount() == 1);
  std::vector<std::string> names;
  for (const PassDesc& pass : desc->passes) names.push_back(pass.name);
  CHECK(names == std::vector<std::string>{"fill", "post", "nw", "show"});
}

TEST_CASE("a name that is not whole is one error, whose fix is the whole name") {
  const Folder folder;
  const auto hint = [&](const std::string& keys) {
    text::Diagnostics diagnostics;
    const auto desc = readGraph(folder.over(keys), diagnostics);
    if (desc) expandGraph(*desc, testRegistry(), {}, diagnostics);
    REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
    return text::nameOf(diagnostics.items()[0].code) + " " + diagnostics.items()[0].hint;
  };
  const std::string fresh =
      R"("type": "fullscreen", "shader": "e.frag.glsl", "read": { "source": "out" }, "write": { "result": "out" })";
  CHECK(hint(R"("resources": { "glow": { "size": 8 } })") == "W017 write the whole name, 'post.bloom.glow'");
  CHECK(hint(R"("resources": { "glow": null })") == "W017 write the whole name, 'post.bloom.glow'");
  CHECK(hint(R"("parameters": { "curve": { "default": "linear" } })") ==
        "W017 write the whole name, 'post.curve'");
  CHECK(hint(R"("passes": [ { "name": "spread", "enabled": true } ])") ==
        "W016 write the whole name, 'post.bloom.spread'");
  CHECK(hint(R"("passes": [ { "name": "bloom", "remove": true } ])") ==
        "W017 write the whole name, 'post.bloom'");
  CHECK(hint(R"("passes": [ { "name": "composite", "before": "post.bloom" } ])") ==
        "W016 write the whole name, 'post.composite'");
  CHECK(hint(R"("passes": [ { "name": "more", "after": "composite", )" + fresh + " } ]") ==
        "W016 write the whole name, 'post.composite'");
  CHECK(hint(R"("passes": [ { "name": "bloom.more", "after": "post.composite", )" + fresh + " } ]") ==
        "W016 call it 'post.more'");
  CHECK(hint(R"("passes": [ { "name": "post.composite", "after": "show" } ])") ==
        "W016 name a pass of its own file, or remove it and write a new one here");
  const std::string twin =
      R"("passes": [ { "before": "post", "include": "parts/glow.json", "as": "twin", "bind": { "source": "hdr" } })";
  CHECK(hint(twin + R"(, { "name": "spread", "enabled": true } ])") ==
        "W016 write the whole name, 'twin.spread' or 'post.bloom.spread'");
  CHECK(expandFile(folder.over(twin + R"(, { "name": "post.bloom.spread", "enabled": true } ])")).graph);
}

TEST_CASE("a pass that stands in an included file uses the names of that file, and the message says them") {
  const Folder folder;
  const auto hint = [&](const char* written) {
    const Expanded e = expandFile(
        folder.over(fmt::format(R"J("resources": {{ "spare": {{ "texture": "r8", "size": 4 }} }}, "passes": [
      {{ "name": "more", "after": "post.composite", "type": "fullscreen", "shader": "e.frag.glsl", "read": {{ "source": "out" }},
         "write": {{ "result": "{}" }} }} ])J",
                                written)));
    REQUIRE_MESSAGE(e.diagnostics.errorCount() == 1, e.text());
    return e.diagnostics.items()[0].hint;
  };
  CHECK(hint("post.out") == "did you mean 'out'?");
  CHECK(hint("spare").find("in the file of the pass") != std::string::npos);
}

TEST_CASE("circles of extends and include end") {
  const Folder folder;
  CHECK(wrong(folder.write("a.json", R"({ "extends": "b.json" })")) == "W001 a.json 1:14");
  folder.write("b.json", R"({ "extends": "a.json" })");
  CHECK(wrong(folder.file("a.json")) == "W015 b.json 1:14");
  folder.write("b.json", R"({ "passes": [ { "include": "a.json" } ] })");
  CHECK(wrong(folder.file("a.json")) == "W008 b.json 1:28");
  CHECK(wrong(folder.file("b.json")).starts_with("W0"));
  folder.write("b.json", R"({ "passes": [ { "include": "c.json" } ] })");
  folder.write("c.json", R"({ "extends": "a.json", "resources": { "r": { "size": 3 } } })");
  for (const char* name : {"a.json", "b.json", "c.json"}) CHECK(!wrong(folder.file(name)).empty());
}

TEST_CASE("a list of extends that cannot be has its place: two graphs, a circle, what is no path") {
  const Folder folder;
  const auto over = [&](const char* text) { return wrong(folder.write("over.json", text)); };
  CHECK(over(R"({ "extends": ["base.json", "parts/post.json"] })") == "W019 over.json 1:28");
  folder.write("other.json", R"({ "passes": [{ "name": "one", "type": "fullscreen", "shader": "a.frag.glsl" },
                                            { "name": "two", "type": "blit" }] })");
  CHECK(over(R"({ "extends": ["base.json", "other.json"] })") == "W019 over.json 1:28");
  CHECK(over(R"({ "extends": ["base.json", "over.json"] })") == "W015 over.json 1:28");
  CHECK(over(R"({ "extends": ["base.json", 3] })") == "W003 over.json 1:28");
  CHECK(over(R"({ "extends": [] })") == "W003 over.json 1:14");
  CHECK(over(R"({ "extends": ["base.json", "none.json"] })") == "W001 over.json 1:28");
  folder.write("a.json", R"({ "extends": "b.json" })");
  folder.write("b.json", R"({ "extends": "a.json" })");
  CHECK(over(R"({ "extends": ["base.json", "a.json"] })") == "W015 b.json 1:14");
  CHECK(wrong(folder.file("base.json"), {folder.file("a.json")}) == "W015 b.json 1:14");
}
