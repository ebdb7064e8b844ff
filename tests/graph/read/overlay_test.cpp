// Overlays: files that extend others, presets, and what of them reaches into included files.
#include <algorithm>
#include <filesystem>

#include "tests/graph/read/overlay_files.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using namespace weft::graph::test::overlays;
using text::Code;

namespace fs = std::filesystem;

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
    "passes": [ { "name": "fill", "shader": "other.frag.glsl", "parameters": { "tint": 0.25, "speed": "$more" } },
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

TEST_CASE("whole names reach into included files, and only there") {
  const Folder folder;
  folder.write("base2.json", R"({ "extends": "base.json" })");
  const Expanded e = fine(folder.over(R"(
    "parameters": { "post.curve": { "default": "linear" } },
    "resources": { "post.bloom.glow": { "size": 32 }, "post.out": { "texture": "rgba16f" } },
    "passes": [ { "name": "post.bloom.spread", "parameters": { "wide": 2 } },
                { "after": "post.composite", "name": "sharpen", "type": "fullscreen", "shader": "s.frag.glsl",
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

TEST_CASE("what is new is new, whatever it is the end of, and stands in the file that its name says") {
  const Folder folder;
  const std::string pass = R"("type": "fullscreen", "shader": "e.frag.glsl", "read": { "source": "out" })";
  const Expanded e = fine(folder.over(R"J(
    "resources": { "glow": { "texture": "r8", "size": "size(hdr)/2" }, "post.half": { "texture": "r8", "size": "size(out)/2" } },
    "passes": [ { "after": "fill", "name": "mark", "type": "fullscreen", "shader": "e.frag.glsl", "write": { "result": "glow" } },
                { "after": "post.composite", "name": "halve", )J" +
                                      pass + R"J(, "write": { "result": "half" } },
                { "after": "post.halve", "name": "post.whole", "type": "fullscreen", "shader": "e.frag.glsl",
                  "read": { "source": "half" }, "write": { "result": "out" } },
                { "name": "show", "read": { "mark": "glow" } } ])J"));
  CHECK(e.names() == "fill mark post.bloom.spread post.composite post.halve post.whole show");
  CHECK(e.resource("glow").format == Format::r8);
  CHECK(e.resource("post.bloom.glow").format == Format::rgba16f);
  CHECK(e.resource("post.half").format == Format::r8);
  // Within its own file a pass moves, and uses sets, by the whole name or by that file's own.
  for (const char* set : {"post.bloom.more", "more"}) {
    const Expanded moved = fine(folder.over(
        R"("sets": { "post.bloom.more": { "modify": { "more": "glow" } } }, "passes": [ { "after": "post.bloom.spread", "name": "again",
           "type": "fullscreen", "shader": "g.frag.glsl", "use": ")" +
        std::string(set) + R"(" }, { "name": "post.composite", "after": "post.bloom" } ])"));
    CHECK(moved.graph->passNames.size() == 5);
    CHECK(moved.spec("post.bloom.again").shader == "g.frag.glsl");
    CHECK(moved.spec("post.bloom.again").slotCount == 1);
  }
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
  folder.write("lut.json",
               R"({ "extends": "base.json", "parameters": { "lut": { "type": "file", "default": "d.cube" } },
           "resources": { "table": { "import": "cube_lut", "file": "$lut" } } })");
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
      R"({ "resources": { "post.bloom.glow": { "size": 8 } }, "passes": [ { "name": "show", "enabled": true } ] })");
  CHECK(fine(base, {c}).resource("post.bloom.glow").width == 8);
  // "set" of an included file stays in it and yields to that of the including file
  folder.write("parts/post2.json",
               R"({ "extends": "post.json", "set": { "curve": "linear", "strength": 0.2 } })");
  const Expanded inner = fine(folder.over(
      R"("set": { "strength": 0.9 }, "passes": [ { "name": "post", "include": "parts/post2.json" } ])"));
  CHECK(valueOf(inner, "post.curve") == "linear");
  CHECK(valueOf(inner, "post.composite.strength") == "0.9");
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
