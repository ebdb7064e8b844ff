// References: includes, imports, kinds, formats, selectors, attachments, overlaps, cadence.
#include <filesystem>
#include <fstream>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// One pass `p` of the given text after passes that write everything it may read.
Expanded tryPass(const std::string& pass, const Settings& settings = {}, const World& world = {}) {
  return expandText(R"J({
    "parameters": { "on": { "default": true } },
    "resources": {
      "out": { "texture": "rgba8", "size": "screen", "clear": 0 },
      "col": { "texture": "rgba16f", "size": "screen", "mips": 4, "clear": 0 },
      "ids": { "texture": "r32ui", "size": "screen", "clear": 0 },
      "dep": { "texture": "depth32f_stencil8", "size": "screen", "clear": 0 },
      "ms":  { "texture": "rgba8", "size": "screen", "samples": 4, "clear": 0 },
      "snorm": { "texture": "rgba8_snorm", "size": "screen", "clear": 0 },
      "small": { "texture": "rgba8", "size": 64, "clear": 0 },
      "lay": { "texture": "rgba8", "size": "screen", "layers": 4, "clear": 0 },
      "cube": { "texture": "depth32f", "size": 32, "view": "cube_array", "layers": 3, "clear": 0 },
      "vol": { "texture": "rgba8", "size": [8, 8, 8], "clear": 0 },
      "arr": { "texture": "rgba8", "size": "screen", "array": 2, "clear": 0 },
      "buf": { "buffer": 64, "clear": 0 },
      "lut": { "import": "cube_lut", "file": "a.cube" },
      "any": ["col if $on", "out"]
    },
    "passes": [ )J" + pass +
                        R"J( ], "present": "out" })J",
                    settings, testRegistry(world));
}
std::string fullscreen(const std::string& rest) {
  return R"J({ "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "out" }, )J" +
         rest + "}";
}
std::string compute(const std::string& rest) {
  return R"J({ "name": "p", "type": "compute", "shader": "a.comp.glsl", "side_effect": true, "threads": 1, )J" +
         rest + "}";
}

}  // namespace

TEST_CASE("kinds by default and by word") {
  const Expanded e = tryPass(fullscreen(
      R"J("read": { "a": "col", "b": "buf", "c": "buf as uniform", "d": "dep as compare", "t": "lut as linear", "s": "dep.stencil", "i": "@spheres" })J"));
  CHECK(e.text() == "");
  CHECK(e.use("p", "a").kind == Kind::sampled);
  CHECK(e.use("p", "b").kind == Kind::storage);
  CHECK(e.use("p", "c").kind == Kind::uniform);
  CHECK(e.use("p", "d").planes == 1);
  CHECK(e.slot("p", "d").sampler.compare);
  CHECK(e.slot("p", "d").sampler.linear);
  CHECK(e.use("p", "s").planes == 2);
  CHECK(e.use("p", "result").kind == Kind::color);
  CHECK(e.use("p", "i").kind == Kind::storage);
  CHECK(e.resource("lut").target == Target::texture_3d);
  CHECK(e.resource("lut").kind == ResourceKind::imported_texture);
  const Expanded draw = tryPass(
      R"J({ "name": "p", "type": "draw", "shader": "a", "list": "spheres", "geometry": "quad", "modify": { "radiance": "small", "result": "small" } })J");
  CHECK(draw.has(Code::writtenTwice));
  const Expanded c = tryPass(compute(R"J("write": { "result": "vol" })J"));
  CHECK(c.use("p", "result").kind == Kind::image);
  const Expanded d =
      tryPass(fullscreen(R"J("modify": { "depth": "dep" }, "state": { "depth_test": "greater" })J"));
  CHECK(d.use("p", "depth").kind == Kind::depth);
  CHECK(d.use("p", "depth").planes == 3);
}

TEST_CASE("what stands in for an import") {
  const std::string graph = R"J({ "resources": {
      "sky": { "texture": "rgba16f", "size": 8, "history": 1 }, "environment": ["@environment", "sky"],
      "out": { "texture": "rgba8", "size": 8 } },
    "passes": [ { "name": "make", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "sky" } },
      { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "out" },
        "read": { "now": "environment" } } ], "present": "out" })J";
  const Expanded with = expandText(graph);
  CHECK(with.text() == "");
  REQUIRE(with.graph->imports.size() == 1);
  CHECK(with.graph->imports[0].standIns == std::vector<std::string>{"sky"});
  const Expanded without = expandText(graph, {}, testRegistry({.environment = false}));
  CHECK(without.text() == "");
}

TEST_CASE("kinds and formats that do not fit") {
  const auto is = [](Code code, const std::string& pass) {
    const Expanded e = tryPass(pass);
    INFO(pass, "\n", e.text());
    CHECK_FALSE(e.graph);
    CHECK(e.of(code).pass == "p");
    CHECK(e.diagnostics.errorCount() == 1);
  };
  is(Code::badKind, fullscreen(R"J("read": { "a": "col as uniform" })J"));
  is(Code::badKind, fullscreen(R"J("read": { "a": "buf as sampled" })J"));
  is(Code::badKind, fullscreen(R"J("read": { "a": "col as color" })J"));
  is(Code::badKind, fullscreen(R"J("read": { "a": "buf as indirect" })J"));
  is(Code::badKind, fullscreen(R"J("read": { "a": "col as indirect" })J"));
  is(Code::badKind, fullscreen(R"J("read": { "a": "@cut" })J"));
  is(Code::badKind, fullscreen(R"J("read": { "a": "buf as linear" })J"));
  is(Code::badKind, fullscreen(R"J("read": { "a": "ms as linear" })J"));
  is(Code::badKind, fullscreen(R"J("modify": { "a": "arr" })J"));
  is(Code::badKind, compute(R"J("modify": { "a": "col.mip[0] as color" })J"));
  is(Code::badKind, compute(R"J("write": { "a": "col.mip[0] as sampled" })J"));
  is(Code::badFormat, fullscreen(R"J("modify": { "a": "snorm" })J"));
  is(Code::badFormat, fullscreen(R"J("read": { "a": "col as compare" })J"));
  is(Code::badFormat, fullscreen(R"J("read": { "a": "ids as linear" })J"));
  is(Code::badFormat, fullscreen(R"J("read": { "a": "col.mip[0] as depth" })J"));
  is(Code::badFormat, compute(R"J("modify": { "a": "dep" })J"));
  is(Code::badSelector, fullscreen(R"J("read": { "a": "buf.mip[0]" })J"));
  is(Code::badSelector, fullscreen(R"J("read": { "a": "col.stencil" })J"));
  is(Code::badSelector, fullscreen(R"J("read": { "a": "col.face[0]" })J"));
  is(Code::badSelector, fullscreen(R"J("read": { "a": "vol.layer[0]" })J"));
  is(Code::badSelector, fullscreen(R"J("read": { "a": "col[0]" })J"));
  is(Code::badSelector, fullscreen(R"J("read": { "a": "cube.face[0]" })J"));
  is(Code::missingSubresource, fullscreen(R"J("read": { "a": "col.mip[4]" })J"));
  is(Code::missingSubresource, fullscreen(R"J("read": { "a": "lay.layer[-1]" })J"));
  is(Code::missingSubresource, fullscreen(R"J("read": { "a": "cube.layer[0].face[6]" })J"));
  is(Code::missingSubresource, fullscreen(R"J("read": { "a": "arr[2]" })J"));
  is(Code::missingSubresource, fullscreen(R"J("read": { "a": "col.mip[2..1]" })J"));
  is(Code::noHistory, fullscreen(R"J("read": { "a": "col@-1" })J"));
  is(Code::noHistory, fullscreen(R"J("read": { "a": "@environment@-2" })J"));
  is(Code::noHistory, fullscreen(R"J("read": { "a": "lut@-1" })J"));
  is(Code::notWritable, compute(R"J("write": { "a": "@environment" })J"));
  is(Code::notWritable, compute(R"J("write": { "a": "col@-1" })J"));
  is(Code::unknownResource, fullscreen(R"J("read": { "a": "coll" })J"));
  is(Code::unknownImport, fullscreen(R"J("read": { "a": "@enviroment" })J"));
  is(Code::attachmentsDiffer, fullscreen(R"J("modify": { "a": "small" })J"));
  is(Code::attachmentsDiffer, fullscreen(R"J("modify": { "a": "lay" })J"));
  is(Code::attachmentsDiffer, fullscreen(R"J("modify": { "a": "ms" })J"));
  is(Code::attachmentsDiffer, fullscreen(R"J("modify": { "a": "col.mip[1]" })J"));
  is(Code::readAndWritten, fullscreen(R"J("modify": { "a": "col.mip[0]" }, "read": { "b": "col" })J"));
  is(Code::readAndWritten, compute(R"J("write": { "a": "col.mip[0]" }, "read": { "b": "col.mip[0..1]" })J"));
}

TEST_CASE("a pass may read one level and write another, and modify with feedback") {
  const Expanded levels =
      tryPass(compute(R"J("write": { "a": "col.mip[1]" }, "read": { "b": "col.mip[0]" })J"));
  CHECK(levels.text() == "");
  const Expanded feedback = tryPass(
      fullscreen(R"J("feedback": true, "modify": { "a": "col.mip[0]" }, "read": { "b": "col.mip[0]" })J"));
  CHECK(feedback.text() == "");
  CHECK(feedback.use("p", "a").feedback);
}

TEST_CASE("faces and layers of cubes") {
  const Expanded e = tryPass(
      R"J({ "name": "p", "type": "draw", "shader": "a", "list": "opaque", "geometry": "mesh", "side_effect": true,
    "repeat": [{ "l": [0, 1] }, { "f": [0, 5] }], "view": "@shadowed_lights[l].face[f]", "modify": { "depth": "cube.layer[l].face[f]" }, "state": { "depth_test": "less" } })J");
  CHECK(e.text().find("error") == std::string::npos);
  CHECK(e.resource("cube").layers == 18);
  CHECK(e.resource("cube").target == Target::texture_cube_array);
  CHECK(e.use("p[1,4]", "depth").layer == 10);
  CHECK(e.use("p[1,4]", "depth").layers == 1);
  CHECK(e.spec("p[1,4]").viewLayer == 1);
  CHECK(e.spec("p[1,4]").viewFace == 4);
  CHECK(e.graph->imports[e.spec("p[1,4]").view].request.type == "shadowed_lights");
  CHECK(e.spec("p[1,4]").declared == "p");
  const Expanded all = tryPass(fullscreen(
      R"J("read": { "a": "cube.layer[1]", "b": "cube.layer[1].face[2..3]", "c": "lay.layer[1..]" })J"));
  CHECK(all.use("p", "a").layer == 6);
  CHECK(all.use("p", "a").layers == 6);
  CHECK(all.use("p", "b").layer == 8);
  CHECK(all.use("p", "b").layers == 2);
  CHECK(all.useText("p", "c") == "lay layer 1..3");
}

TEST_CASE("imports that have nothing") {
  const World empty{.environment = false, .sun = false, .spheres = 0, .pointLights = 0, .shadowedLights = 0};
  CHECK(tryPass(fullscreen(R"J("read": { "a": "@environment" })J"), {}, empty).has(Code::emptyImport));
  CHECK(tryPass(fullscreen(R"J("read": { "a": "@environment ?" })J"), {}, empty).useText("p", "a") == "-");
  const std::string shadow =
      R"J({ "name": "p", "type": "draw", "shader": "a", "list": "opaque", "geometry": "mesh", "enabled": "has(sun)", "view": "@sun", "side_effect": true, "modify": { "depth": "cube.layer[0].face[0]" }, "state": { "depth_test": "greater" } })J";
  CHECK(tryPass(shadow).names() == "p");
  CHECK(tryPass(shadow, {}, empty).has(Code::emptyImport) == false);
}

TEST_CASE("equal imports are one, and a declared camera is everybody's view") {
  const Expanded e = expandText(R"J({
    "resources": { "out": { "texture": "rgba8", "size": 8 }, "camera": { "import": "camera", "jitter": 16 },
                   "o1": { "import": "draw_order", "method": "cpu_std" }, "o2": { "import": "draw_order", "list": "spheres", "method": "cpu_std" } },
    "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "a": "o1", "b": "o2" }, "write": { "result": "out" } } ], "present": "out" })J");
  CHECK(e.use("p", "a").resource == e.use("p", "b").resource);
  CHECK(e.graph->imports[e.spec("p").view].request.type == "camera");
  CHECK(e.graph->imports[e.spec("p").view].request.arguments[0].second == Value::number(16));
}

TEST_CASE("cadence: an always pass may not add to what a slower one made") {
  const std::string head = R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "slow", "type": "fullscreen", "shader": "a.frag.glsl", "update": "on_change", "slices": 4, "write": { "result": "out" } },
    { "name": "rides", "type": "compute", "shader": "a.comp.glsl", "update": "on_change", "slices": 0, "modify": { "result": "out" } })J";
  const Expanded good = expandText(head + R"J(], "present": "out" })J");
  CHECK(good.text() == "");
  CHECK(good.graph->passes[0].slices == 4);
  CHECK(good.graph->passes[1].slices == 0);
  const Expanded bad = expandText(
      head +
      R"J(, { "name": "fast", "type": "fullscreen", "shader": "a.frag.glsl", "modify": { "result": "out" }, "state": { "blend": "add" } } ], "present": "out" })J");
  CHECK(bad.of(Code::addsUp).pass == "fast");
}

TEST_CASE("slices: what could never end, what another writes too, and types that run whole are reported") {
  const auto tryPasses = [](const std::string& passes) {
    return expandText(R"J({ "resources": {
        "a": { "texture": "rgba8", "size": 8 }, "b": { "texture": "rgba8", "size": 8 }, "c": { "texture": "rgba8", "size": 8 } },
      "passes": [)J" + passes +
                      R"J(,
        { "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "src": "b" }, "write": { "r": "c" } } ], "present": "c" })J");
  };
  const std::string slow =
      R"J({ "name": "slow", "type": "fullscreen", "shader": "a.frag.glsl", "update": "on_change", "slices": 2, )J";
  CHECK(tryPasses(slow + R"J("write": { "r": "b" } })J").text() == "");
  CHECK(
      tryPasses(
          R"J({ "name": "fast", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "a.mip[0]" } }, )J" +
          slow + R"J("read": { "src": "a.mip[0]" }, "write": { "r": "b" } })J")
          .of(Code::badSlices)
          .pass == "slow");
  const auto jointly = [](const std::string& passes) {
    return expandText(
        R"J({ "resources": { "b": { "texture": "rgba8", "size": 8, "clear": 0 } }, "passes": [)J" + passes +
        R"J( ], "present": "b" })J");
  };
  const std::string fast =
      R"J({ "name": "fast", "type": "fullscreen", "shader": "a.frag.glsl", "modify": { "r": "b" } })J";
  CHECK(jointly(fast + ", " + slow + R"J("modify": { "r": "b" } })J").of(Code::badSlices).pass == "fast");
  const auto after = jointly(slow + R"J("modify": { "r": "b" } }, )J" + fast);
  CHECK(after.of(Code::addsUp).pass == "fast");
  CHECK(after.text().find("W077") == std::string::npos);
  const std::string group =
      R"J({ "name": "one", "type": "fullscreen", "shader": "a.frag.glsl", "update": "on_change", "slices": 2,
        "write": { "r": "a.mip[0]" } },
      { "name": "between", "type": "fullscreen", "shader": "a.frag.glsl", "update": "CADENCE", "read": { "src": "a.mip[0]" }, "write": { "r": "c" } },
      { "name": "two", "type": "fullscreen", "shader": "a.frag.glsl", "update": "on_change", "slices": 2, "read": { "src": "c", "made": "a.mip[0]" }, "write": { "r": "b" } })J";
  const auto with = [&](const std::string& in) {
    return std::string(group).replace(group.find("CADENCE"), 7, in);
  };
  CHECK(tryPasses(with("once")).of(Code::badSlices).pass == "between");
  CHECK(tryPasses(with("on_change")).text() == "");
  CHECK(
      tryPasses(
          R"J({ "name": "top", "type": "fullscreen", "shader": "a.frag.glsl", "update": "on_change", "write": { "r": "a.mip[0]" } },
      { "name": "mips", "type": "mipmap", "update": "on_change", "slices": 3, "read": { "source": "a.mip[0]" }, "write": { "result": "a.mip[1]" } },
      { "name": "use", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "src": "a" }, "write": { "r": "b" } })J")
          .of(Code::badSlices)
          .pass == "mips");
}

TEST_CASE("includes: prefixes, binds, inputs of the same name, names from outside") {
  const std::filesystem::path folder = std::filesystem::path(WEFT_BINARY_DIR) / "expand_include";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  };
  write(
      "inner.json",
      R"J({ "parameters": { "k": { "default": 2.0 } }, "inputs": ["hdr"], "resources": { "res": { "texture": "rgba8", "size": "size(hdr)" } },
    "passes": [ { "name": "go", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "source": "hdr" }, "write": { "result": "res" },
                  "parameters": { "k": "$k", "outer": "$outer", "own": { "default": 3 } } } ], "outputs": { "res": "res?" } })J");
  const auto top = [&](const std::string& include, const Settings& settings = {}) {
    const std::string path = write(
        "top.json",
        R"J({ "parameters": { "outer": { "default": 5.0 } }, "resources": { "hdr": { "texture": "rgba16f", "size": [4, 2] }, "other": { "texture": "rgba16f", "size": [8, 2] } },
      "passes": [ { "name": "a", "type": "compute", "shader": "a.comp.glsl", "write": { "r": "hdr" } }, { "name": "b", "type": "compute", "shader": "a.comp.glsl", "write": { "r": "other" } }, )J" +
            include + R"J( ], "present": "inc.res" })J");
    Expanded e;
    const auto desc = readGraph(path, e.diagnostics);
    REQUIRE_MESSAGE(desc, e.text());
    e.graph = expandGraph(*desc, testRegistry(), settings, e.diagnostics);
    return e;
  };
  const Expanded same = top(R"J({ "include": "inner.json", "as": "inc" })J");
  CHECK(same.names() == "a b inc.go");
  CHECK(same.useText("inc.go", "source") == "hdr");
  CHECK(same.resource("inc.res").width == 4);
  CHECK(same.uniform("inc.go", "k").path == "inc.k");
  CHECK(same.uniform("inc.go", "outer").value == Value::number(5));
  CHECK(same.uniform("inc.go", "outer").path == "outer");
  CHECK(same.uniform("inc.go", "own").path == "inc.go.own");
  CHECK(same.graph->outputNames == std::vector<std::string>{"inc.res"});
  const Expanded bound = top(R"J({ "include": "inner.json", "as": "inc", "bind": { "hdr": "other" } })J");
  CHECK(bound.useText("inc.go", "source") == "other");
  CHECK(bound.resource("inc.res").width == 8);
  const Expanded typo = top(R"J({ "include": "inner.json", "as": "inc", "bind": { "hdrr": "other" } })J");
  CHECK(typo.of(Code::badBind).hint == "did you mean 'hdr'?");
  const Expanded nowhere = top(R"J({ "include": "inner.json", "as": "inc", "bind": { "hdr": "othr" } })J");
  CHECK(nowhere.of(Code::unknownResource).hint == "did you mean 'other'?");
  const Expanded off = top(R"J({ "include": "inner.json", "as": "inc" })J", with({}, {"inc"}));
  CHECK(
      off.of(Code::disabledWriter).message.find("'inc.go' that would write it is disabled (--disable inc)") !=
      std::string::npos);
  const Expanded part =
      top(R"J({ "include": "inner.json", "as": "inc", "bind": { "hdr": "other.mip[0]" } })J");
  CHECK(part.has(Code::badBind));
}

TEST_CASE("enabled of an include: none of its passes without it, and what decides is structural") {
  const std::filesystem::path folder = std::filesystem::path(WEFT_BINARY_DIR) / "expand_include_enabled";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  };
  write("dim.json",
        R"J({ "parameters": { "own": { "default": true } }, "inputs": ["hdr"],
    "passes": [ { "name": "first", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "source": "hdr" }, "write": { "result": "hdr" } },
                { "name": "second", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": "$own", "read": { "source": "hdr" }, "write": { "result": "hdr" } } ] })J");
  const auto top = [&](const std::string& enabled, const Settings& settings = {}) {
    const std::string path = write(
        "top.json",
        R"J({ "parameters": { "dim": { "default": true } }, "resources": { "hdr": { "texture": "rgba16f", "size": 4 } },
      "passes": [ { "name": "fill", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "hdr" } },
                  { "include": "dim.json", "enabled": )J" +
            enabled + R"J( } ], "present": "hdr" })J");
    Expanded e;
    const auto desc = readGraph(path, e.diagnostics);
    REQUIRE_MESSAGE(desc, e.text());
    e.graph = expandGraph(*desc, testRegistry(), settings, e.diagnostics);
    return e;
  };
  CHECK(top("true").names() == "fill dim.first dim.second");
  CHECK(top(R"("$dim")").names() == "fill dim.first dim.second");
  CHECK(top(R"("$dim")", with({{"own", "false"}})).names() == "fill dim.first");
  const Expanded off = top(R"("$dim")", with({{"dim", "false"}}));
  CHECK(off.names() == "fill");
  REQUIRE(off.graph->disabled.size() == 2);
  CHECK(off.graph->disabled[1].name == "dim.second");
  CHECK(off.graph->disabled[1].why == "enabled: $dim is false");
  REQUIRE(off.graph->parameters.size() == 2);
  CHECK(off.graph->parameters[0].structural);
  CHECK(top("false").names() == "fill");
  CHECK(top(R"("$dimm")").of(Code::unknownVariable).hint == "did you mean '$dim'?");
  CHECK(top(R"("$dim || $dimm")").of(Code::unknownVariable).hint ==
        "did you mean '$dim'?");  // also where it is not evaluated
  CHECK(top(R"("a")").of(Code::wrongValueType).message == "'enabled' of an include is no condition");
}

TEST_CASE("mipmap and blit hold their two slots against each other") {
  const auto copy = [](const std::string& type, const std::string& source, const std::string& result) {
    return tryPass(R"J({ "name": "p", "type": ")J" + type +
                   R"J(", "side_effect": true, "read": { "source": ")J" + source + R"J(" }, "write": { ")J" +
                   (type == "blit" ? "destination" : "result") + R"J(": ")J" + result + R"J(" } })J");
  };
  CHECK(copy("mipmap", "col.mip[0]", "col.mip[1..]").text() == "");
  CHECK(copy("mipmap", "col.mip[0]", "col.mip[1..]").use("p", "result").kind == Kind::copy);
  CHECK(copy("mipmap", "col.mip[0]", "col.mip[2..]").has(Code::badSlots));
  CHECK(copy("mipmap", "small", "col.mip[1..]").has(Code::badSlots));
  CHECK(copy("blit", "col.mip[0] as linear", "out").text() == "");
  CHECK(copy("blit", "ids", "out").has(Code::badFormat));
  CHECK(copy("blit", "dep", "out").has(Code::badFormat));
  CHECK(
      tryPass(
          R"J({ "name": "p", "type": "blit", "side_effect": true, "read": { "sorce": "col" }, "write": { "destination": "out" } })J")
          .of(Code::badSlots)
          .hint == "did you mean 'source'?");
}

TEST_CASE("an import with a stand-in satisfies a plain read, not an optional one") {
  Registry registry = testRegistry({.environment = false});
  const auto factsOf = registry.factsOf;
  registry.factsOf = [factsOf](const ImportRequest& request) {
    ImportFacts facts = factsOf(request);
    facts.fallback = "graphs/daylight.json";
    return facts;
  };
  const Expanded e = expandText(
      R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 }, "env": ["@environment", "@environment"] }, "passes": [
    { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "plain": "@environment", "maybe": "@environment?", "list": "env" }, "write": { "result": "out" } } ], "present": "out" })J",
      {}, registry);
  CHECK(e.text() == "");
  CHECK(e.useText("p", "plain") == "@environment");
  CHECK(e.useText("p", "maybe") == "-");
  CHECK(e.useText("p", "list") == "@environment");
  CHECK(e.graph->imports[0].fallback == "graphs/daylight.json");
}

TEST_CASE("a depth attachment stays attached for the test of its own pass, unless the test always passes") {
  const auto keepsDepth = [](const std::string& test) {
    const Expanded e = tryPass(
        R"J({ "name": "p", "type": "draw", "shader": "a", "list": "spheres", "geometry": "quad", "modify": { "radiance": "out", "depth": "dep" })J" +
        test + " }");
    CHECK_FALSE(e.use("p", "radiance").keep);
    return e.use("p", "depth").keep;
  };
  CHECK(keepsDepth(R"J(, "state": { "depth_test": "greater" })J"));
  CHECK_FALSE(keepsDepth(R"J(, "state": { "depth_test": "always" })J"));
}
