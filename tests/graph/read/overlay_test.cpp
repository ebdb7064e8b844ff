// Overlays: files that extend others, presets, and what of them reaches into included files.
#include <algorithm>
#include <filesystem>

#include "tests/graph/expand/support.h"
#include "tests/graph/test_folder.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using base::Code;

namespace {

namespace fs = std::filesystem;

// A folder of files for the time of a test, with a graph to lay overlays over.
class Folder : public TestFolder {
 public:
  Folder() : TestFolder("overlay_test_files") {
    write("base.json", R"({
  "name": "base",
  "parameters": { "gain": { "default": 1.0, "min": 0, "max": 8, "label": "Gain" }, "soft": { "default": true } },
  "let": { "half": "screen/2" },
  "resources": { "hdr": { "texture": "rgba16f", "size": "screen", "mips": 2 }, "ldr": { "texture": "rgba8", "size": "screen" },
                 "either": ["hdr if $soft", "ldr"] },
  "passes": [
    { "name": "fill", "type": "fullscreen", "shader": "fill.frag.glsl", "write": { "result": "hdr.mip[0]" },
      "parameters": { "gain": "$gain", "tint": { "default": 0.5, "min": 0, "max": 1 } } },
    { "include": "parts/post.json", "bind": { "source": "hdr" } },
    { "name": "show", "type": "fullscreen", "shader": "show.frag.glsl", "read": { "picture": "post.out", "extra": "hdr.mip[0]" },
      "write": { "result": "ldr" } }
  ],
  "present": "ldr"
})");
    write("parts/post.json", R"json({
  "parameters": { "curve": { "default": "filmic", "choices": ["filmic", "linear"] } },
  "resources": { "source": { "input": "texture" }, "out": { "texture": "rgba8", "size": "size(source)" } },
  "passes": [
    { "include": "glow.json", "as": "bloom" },
    { "name": "composite", "type": "fullscreen", "shader": "c.frag.glsl", "read": { "color": "source.mip[0]", "glow": "bloom.glow" },
      "write": { "result": "out" }, "defines": { "CURVE": "$curve" }, "parameters": { "strength": { "default": 0.1 } } }
  ]
})json");
    write("parts/glow.json", R"({
  "resources": { "source": { "input": "texture" }, "glow": { "texture": "rgba16f", "size": 64 } },
  "passes": [ { "name": "spread", "type": "fullscreen", "shader": "g.frag.glsl", "read": { "source": "source.mip[0]" },
      "write": { "result": "glow" } } ]
})");
  }
  // An overlay over base.json with these keys beside "extends".
  std::string over(const std::string& keys) const {
    return write("over.json",
                 "{ \"extends\": \"base.json\"" + std::string(keys.empty() ? "" : ", ") + keys + " }");
  }
};

Expanded expandFile(const std::string& path, const std::vector<std::string>& presets = {},
                    const Settings& settings = {}) {
  Expanded result;
  const auto desc = readGraph(path, presets, result.diagnostics);
  if (desc) result.graph = expandGraph(*desc, testRegistry(), settings, result.diagnostics);
  return result;
}

Expanded fine(const std::string& path, const std::vector<std::string>& presets = {},
              const Settings& settings = {}) {
  Expanded e = expandFile(path, presets, settings);
  CHECK_MESSAGE(e.diagnostics.empty(), e.text());
  REQUIRE(e.graph);
  return e;
}

// "W017 over.json 3:5" of every diagnostic of reading.
std::string wrong(const std::string& path, const std::vector<std::string>& presets = {}) {
  base::Diagnostics diagnostics;
  readGraph(path, presets, diagnostics);
  std::string out;
  for (const auto& d : diagnostics.items()) {
    out += (out.empty() ? "" : "; ") + base::nameOf(d.code) + " " +
           fs::path(d.place.file ? *d.place.file : "").filename().string() + " " +
           std::to_string(d.place.line) + ":" + std::to_string(d.place.column);
    CHECK_MESSAGE((!d.hint.empty() || !d.expected.empty()), base::format(d));
  }
  return out;
}

std::string valueOf(const Expanded& e, const std::string& parameter) {
  for (const ParameterSpec& spec : e.graph->parameters)
    if (spec.path == parameter) return toText(spec.value);
  return "none";
}

}  // namespace

TEST_CASE("an overlay that changes nothing is its base under its own name") {
  const Folder folder;
  const Expanded base = fine(folder.file("base.json")), over = fine(folder.over(""));
  CHECK(base.names() == "fill post.bloom.spread post.composite show");
  CHECK(over.names() == base.names());
  CHECK(over.graph->name == "over");
  CHECK(over.graph->files == std::vector<std::string>{folder.file("over.json"), folder.file("base.json"),
                                                      folder.file("parts/post.json"),
                                                      folder.file("parts/glow.json")});
}

TEST_CASE("objects merge key by key, null takes away") {
  const Folder folder;
  const Expanded e = fine(folder.over(R"("name": "mine",
    "parameters": { "gain": { "default": 2, "label": null }, "more": { "default": 3 } },
    "resources": { "hdr": { "texture": "r11f_g11f_b10f" }, "either": "hdr", "spare": { "texture": "r8", "size": 4 } },
    "passes": [ { "name": "fill", "shader": "other.frag.glsl", "parameters": { "tint": 0.25, "speed": 7 } },
                { "name": "show", "read": { "extra": null, "either": "either.mip[0]" } } ])"));
  CHECK(e.graph->name == "mine");
  CHECK(e.resource("hdr").format == Format::r11f_g11f_b10f);
  CHECK(e.resource("hdr").mips == 2);
  CHECK(valueOf(e, "gain") == "2");
  CHECK(valueOf(e, "more") == "3");
  CHECK(valueOf(e, "fill.tint") == "none");
  CHECK(e.uniform("fill", "speed").name == "speed");
  CHECK(e.uniform("fill", "gain").name == "gain");
  CHECK(e.useText("show", "either") == "hdr mip 0");
  CHECK(e.spec("show").slotCount == 3);
}

TEST_CASE("passes are added beside others, moved and removed") {
  const Folder folder;
  const std::string added = R"("name": "extra", "type": "fullscreen", "shader": "e.frag.glsl",
    "read": { "source": "ldr" }, "write": { "result": "ldr" })";
  CHECK(fine(folder.over(R"("passes": [ { "after": "show", )" + added + " } ]")).names() ==
        "fill post.bloom.spread post.composite show extra");
  // two at one anchor: the later stands nearer to it; anchors may be overlays' own
  const std::string two = R"("name": "second", "type": "fullscreen", "shader": "e.frag.glsl",
    "read": { "source": "ldr" }, "write": { "result": "ldr" })";
  CHECK(fine(folder.over(R"("passes": [ { "after": "show", )" + added + R"( }, { "after": "extra", )" + two +
                         " } ]"))
            .names() == "fill post.bloom.spread post.composite show extra second");
  CHECK(fine(folder.over(R"("passes": [ { "after": "show", )" + added + R"( }, { "after": "show", )" + two +
                         " } ]"))
            .names() == "fill post.bloom.spread post.composite show second extra");
  // an include as an anchor, and a new include
  folder.write("parts/more.json", R"({ "passes": [ { "name": "m", "type": "compute", "shader": "m.comp.glsl",
    "side_effect": true, "threads": 1 } ] })");
  CHECK(fine(folder.over(R"("passes": [ { "before": "post", "include": "parts/more.json" } ])")).names() ==
        "fill more.m post.bloom.spread post.composite show");
  // moved: with an anchor of its own file
  const Expanded moved = expandFile(folder.over(R"("passes": [ { "name": "fill", "after": "post" } ])"));
  CHECK(moved.has(Code::readBeforeWrite));
  // removed
  const Expanded less = fine(folder.over(
      R"("passes": [ { "name": "post", "remove": true }, { "name": "show", "read": { "picture": null } } ])"));
  CHECK(less.names() == "fill show");
  CHECK(std::ranges::find(less.graph->files, folder.file("parts/post.json")) == less.graph->files.end());
}

TEST_CASE("suffixes reach into included files, and only there") {
  const Folder folder;
  folder.write("base2.json", R"({ "extends": "base.json" })");
  const Expanded e = fine(folder.over(R"(
    "parameters": { "curve": { "default": "linear" } },
    "resources": { "bloom.glow": { "size": 32 }, "out": { "texture": "rgba16f" } },
    "passes": [ { "name": "spread", "parameters": { "wide": 2 } },
                { "after": "composite", "name": "sharpen", "type": "fullscreen", "shader": "s.frag.glsl",
                  "read": { "source": "out" }, "write": { "result": "out" } } ])"));
  CHECK(e.names() == "fill post.bloom.spread post.composite post.sharpen show");
  CHECK(e.resource("post.bloom.glow").width == 32);
  CHECK(e.resource("post.out").format == Format::rgba16f);
  CHECK(e.define("post.composite", "CURVE") !=
        fine(folder.file("base.json")).define("post.composite", "CURVE"));
  CHECK(e.uniform("post.bloom.spread", "wide").name == "wide");
  // A second include of a changed file is not changed.
  const Expanded twice = fine(folder.over(R"(
    "resources": { "twin.glow": { "size": 16 } },
    "passes": [ { "before": "post", "include": "parts/glow.json", "as": "twin", "bind": { "source": "hdr" } },
                { "name": "show", "read": { "twin": "twin.glow" } } ])"));
  CHECK(twice.resource("post.bloom.glow").width == 64);
  // What the overlay itself includes can be reached, whatever stands first in it.
  CHECK(twice.resource("twin.glow").width == 16);
}

TEST_CASE("overlays of overlays, and overlays that are included") {
  const Folder folder;
  folder.write("parts/wide.json", R"({ "extends": "glow.json", "resources": { "glow": { "size": 128 } } })");
  folder.write("middle.json", R"({ "extends": "base.json", "set": { "gain": 2, "strength": 0.3 },
    "resources": { "post.bloom.glow": { "size": 32 }, "hdr": { "mips": 3 } } })");
  const Expanded e =
      fine(folder.write("parts/top.json", R"({ "extends": "../middle.json", "set": { "strength": 0.4 },
    "resources": { "hdr": { "mips": 4 } }, "passes": [ { "name": "post.bloom", "include": "wide.json" } ] })"));
  CHECK(e.resource("hdr").mips == 4);
  CHECK(e.resource("post.bloom.glow").width == 128);
  CHECK(valueOf(e, "gain") == "2");
  CHECK(valueOf(e, "post.composite.strength") == "0.4");
  CHECK(e.graph->files.front() == folder.file("parts/top.json"));
  for (const char* name :
       {"middle.json", "base.json", "parts/post.json", "parts/wide.json", "parts/glow.json"})
    CHECK_MESSAGE(
        std::ranges::any_of(e.graph->files,
                            [&](const std::string& file) { return fs::equivalent(file, folder.file(name)); }),
        name);
}

TEST_CASE("values: presets in order, then the command line; included files first") {
  const Folder folder;
  const std::string base = folder.file("base.json");
  const std::string a =
      folder.write("a.json", R"({ "name": "A", "set": { "gain": 3, "curve": "linear", "soft": false } })");
  const std::string b = folder.write("b.json", R"({ "set": { "gain": 4, "composite.strength": 0.5 } })");
  CHECK(valueOf(fine(base, {a}), "gain") == "3");
  CHECK(fine(base, {a}).graph->name == "base");
  const Expanded both = fine(base, {a, b});
  CHECK(valueOf(both, "gain") == "4");
  CHECK(valueOf(both, "post.curve") == "linear");
  CHECK(valueOf(both, "soft") == "false");
  CHECK(valueOf(both, "post.composite.strength") == "0.5");
  CHECK(std::ranges::find(both.graph->files, b) != both.graph->files.end());
  CHECK(valueOf(fine(base, {b, a}), "gain") == "3");
  CHECK(valueOf(fine(base, {a, b}, with({{"gain", "5"}})), "gain") == "5");
  // a path is from the folder of the file that says it, one of the command line is as it is
  folder.write(
      "lut.json",
      R"({ "extends": "base.json", "parameters": { "lut": { "type": "file", "default": "d.cube" } } })");
  const std::string lut = folder.file("lut.json");
  const std::string p = folder.write("parts/p.json", R"({ "set": { "lut": "../tables/p.cube" } })");
  const std::string absolute =
      folder.write("parts/absolute.json", R"({ "set": { "lut": "/tables/p.cube" } })");
  const std::string none = folder.write("parts/none.json", R"({ "set": { "lut": "" } })");
  CHECK(valueOf(fine(lut), "lut") == folder.file("d.cube"));
  CHECK(valueOf(fine(lut, {p}), "lut") == folder.file("tables/p.cube"));
  CHECK(valueOf(fine(lut, {absolute}), "lut") == "/tables/p.cube");
  CHECK(valueOf(fine(lut, {p, none}), "lut") == "");
  CHECK(valueOf(fine(lut, {p}, with({{"lut", "x/y.cube"}})), "lut") == "x/y.cube");
  // a preset is an overlay: it may say more
  const std::string c = folder.write(
      "c.json",
      R"({ "resources": { "glow": { "size": 8 } }, "passes": [ { "name": "show", "enabled": true } ] })");
  CHECK(fine(base, {c}).resource("post.bloom.glow").width == 8);
  // "set" of an included file stays in it and yields to that of the including file
  folder.write("parts/post2.json",
               R"({ "extends": "post.json", "set": { "curve": "linear", "strength": 0.2 } })");
  const Expanded inner = fine(folder.over(
      R"("set": { "strength": 0.9 }, "passes": [ { "name": "post", "include": "parts/post2.json" } ])"));
  CHECK(valueOf(inner, "post.curve") == "linear");
  CHECK(valueOf(inner, "post.composite.strength") == "0.9");
}

TEST_CASE("values that do not fit are reported where they stand") {
  const Folder folder;
  const auto only = [&](const std::string& text) {
    const Expanded e = expandFile(folder.file("base.json"), {folder.write("p.json", text)});
    REQUIRE_MESSAGE(e.diagnostics.size() == 1, e.text());
    const base::Diagnostic& d = e.diagnostics.items()[0];
    REQUIRE(d.place.file);
    CHECK(*d.place.file == folder.file("p.json"));
    return base::nameOf(d.code) + " " + std::to_string(d.place.line) + ":" + std::to_string(d.place.column);
  };
  CHECK(only(R"({ "set": { "curve": "filmc" } })") == "W047 1:12");
  CHECK(only(R"({ "set": { "gain": 9 } })") == "W048 1:12");
  CHECK(only(R"({ "set": { "gian": 1 } })") == "W044 1:12");
  CHECK(only(R"({ "set": { "gain": null } })") == "W003 1:20");
  CHECK(only(R"({ "set": { "gain": [1, "x"] } })") == "W003 1:20");
  CHECK(only(R"({ "set": 3 })") == "W003 1:10");
  CHECK(only(R"([])") == "W003 1:1");
  CHECK(only(R"({ "extends": "parts/post.json" })") == "W019 1:14");
  CHECK(only(R"({ "passes": [ { "name": "sohw", "enabled": false } ] })") == "W016 1:25");
  CHECK(expandFile(folder.file("base.json"), {folder.file("none.json")}).has(Code::unreadableFile));
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
  base::Diagnostics diagnostics;
  const auto desc = readGraph(
      folder.over(R"("passes": [ { "name": "nw", "type": "compute", "before": "shwo" } ])"), diagnostics);
  REQUIRE(desc);
  CHECK(diagnostics.errorCount() == 1);
  std::vector<std::string> names;
  for (const PassDesc& pass : desc->passes) names.push_back(pass.name);
  CHECK(names == std::vector<std::string>{"fill", "post", "nw", "show"});
}

TEST_CASE("a name that several includes have must be longer") {
  const Folder folder;
  const std::string twin =
      R"("passes": [ { "before": "post", "include": "parts/glow.json", "as": "twin", "bind": { "source": "hdr" } })";
  base::Diagnostics diagnostics;
  readGraph(folder.over(twin + R"(, { "name": "spread", "enabled": false } ])"), diagnostics);
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  CHECK(diagnostics.items()[0].code == Code::ambiguousName);
  CHECK(diagnostics.items()[0].found == "twin.spread, post.bloom.spread");
  CHECK(fine(folder.over(twin + R"(, { "name": "bloom.spread", "enabled": true } ])")).graph);
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

TEST_CASE("a list of extends: a graph, then overlays in their order, then the file itself; the last wins") {
  const Folder folder;
  folder.write(
      "looks/warm.json",
      R"({ "name": "warm", "set": { "gain": 2, "tint": 0.25 }, "resources": { "ldr": { "texture": "rgba16f" } } })");
  folder.write("looks/grain.json", R"({ "extends": "warm.json", "set": { "gain": 3 },
    "passes": [ { "after": "show", "name": "grain", "type": "fullscreen", "shader": "n.frag.glsl", "read": { "source": "ldr" },
                  "write": { "result": "ldr" } } ] })");
  const Expanded e = fine(folder.write(
      "all.json",
      R"({ "extends": ["base.json", "looks/warm.json", "looks/grain.json"], "set": { "strength": 0.5 } })"));
  CHECK(e.names() == "fill post.bloom.spread post.composite show grain");
  CHECK(e.graph->name == "all");
  CHECK(valueOf(e, "gain") == "3");
  CHECK(valueOf(e, "fill.tint") == "0.25");
  CHECK(valueOf(e, "post.composite.strength") == "0.5");
  CHECK(std::vector<std::string>(e.graph->files.begin(), e.graph->files.begin() + 4) ==
        std::vector<std::string>{folder.file("all.json"), folder.file("base.json"),
                                 folder.file("looks/warm.json"), folder.file("looks/grain.json")});
  // The other order: the one that extends warm.json brings it below itself, and then it lies on top once more.
  CHECK(valueOf(fine(folder.write("turned.json",
                                  R"({ "extends": ["base.json", "looks/grain.json", "looks/warm.json"] })")),
                "gain") == "2");
  CHECK(fine(folder.write("alone.json", R"({ "extends": ["base.json"] })")).names() ==
        "fill post.bloom.spread post.composite show");
}

TEST_CASE("a preset lays what it extends below itself, also where that is an overlay of the graph") {
  const Folder folder;
  const std::string warm = folder.write("warm.json", R"({ "set": { "gain": 2, "tint": 0.25 } })");
  const std::string warmer =
      folder.write("warmer.json", R"({ "extends": "warm.json", "set": { "gain": 4 } })");
  const Expanded e = fine(folder.file("base.json"), {warmer});
  CHECK(valueOf(e, "gain") == "4");
  CHECK(valueOf(e, "fill.tint") == "0.25");
  CHECK(e.graph->name == "base");
  CHECK(std::ranges::find(e.graph->files, warm) != e.graph->files.end());
  for (const ParameterSpec& spec : e.graph->parameters)
    if (spec.path == "fill.tint") CHECK(spec.origin == Origin::preset);
  const std::string own =
      folder.write("own.json", R"({ "extends": ["base.json", "warm.json"], "set": { "gain": 5 } })");
  CHECK(valueOf(fine(folder.file("base.json"), {own}), "gain") == "5");
  CHECK(valueOf(fine(own, {own}), "gain") == "5");
}

TEST_CASE("a list of extends that cannot be has its place: two graphs, a circle, what is no path") {
  const Folder folder;
  const auto over = [&](const char* text) { return wrong(folder.write("over.json", text)); };
  CHECK(over(R"({ "extends": ["base.json", "parts/post.json"] })") == "W019 over.json 1:28");
  folder.write("other.json", R"({ "passes": [{ "name": "one", "type": "fullscreen", "shader": "a.frag.glsl" },
                                            { "name": "two", "like": "one" }] })");
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

TEST_CASE("the papers' overlays read and expand") {
  const fs::path paper = WEFT_SOURCE_DIR "/tests/graph/paper";
  const auto of = [&](const char* name) { return fine((paper / name).string()); };
  const Expanded dynres = of("dynres.json"), low = of("lowend.json"), temporal = of("temporal.json"),
                 gi = of("studio_gi.json");
  CHECK(dynres.names().ends_with("post.fxaa upscale ui"));
  CHECK(low.names().ends_with("post.composite post.sharpen upscale ui"));
  CHECK(low.resource("hdr").width == 640);
  CHECK(low.resource("hdr").format == Format::r11f_g11f_b10f);
  CHECK(low.resource("ibl.specular").width == 256);
  CHECK(low.resource("post.bloom.glow").mips == 4);
  CHECK(valueOf(low, "draw") == "icosphere");
  CHECK(temporal.names().find("temporal_resolve post.") != std::string::npos);
  CHECK(gi.useText("spheres", "sh") == "gi.sh[0]");
  const std::string studio = (paper / "studio.json").string();
  const Expanded gaussian = fine(studio, {}, with({{"bloom_kind", "gaussian"}}));
  CHECK(gaussian.names().find("post.gaussian_bloom.glow_blur[3]") != std::string::npos);
  CHECK(gaussian.names().find("post.gaussian_bloom.glow_up") == std::string::npos);
  const Expanded cine = fine(studio, {(paper / "presets/cine_full_frame.json").string()});
  CHECK(valueOf(cine, "post.curve") == "agx");
  CHECK(valueOf(cine, "post.composite.temperature") == "5600");
}

TEST_CASE("every bundled preset fits the studio, or the graph that it is for") {
  int presets = 0;
  for (const auto& entry : fs::directory_iterator(WEFT_SOURCE_DIR "/graphs/presets")) {
    if (entry.path().extension() != ".json") continue;  // beside them: the tables they name
    INFO(entry.path().string());
    const bool probes = entry.path().stem() == "point_probes";
    const std::string graph = WEFT_SOURCE_DIR "/graphs/studio" + std::string(probes ? "_gi" : "") + ".json";
    CHECK(fine(graph, {entry.path().string()}).graph);
    ++presets;
  }
  CHECK(presets >= 3);
}
