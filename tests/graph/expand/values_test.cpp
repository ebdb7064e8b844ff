// Parameters, lets, --set and --disable, defines, uniforms, age, state, sizes and limits.
#include "tests/graph/expand/support.h"
#include "tests/graph/test_folder.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

Expanded tryPass(const std::string& pass, const std::string& head, const Settings& settings = {}) {
  return expandText(
      R"J({ "resources": { "out": { "texture": "rgba8", "size": [16, 8] } }, "passes": [ { "name": "p", "shader": "a.frag.glsl", "type": "fullscreen", "write": { "result": "out" }, )J" +
          pass + R"J( } ], "present": "out")J" + head + "}",
      settings);
}
Expanded tryTexture(const std::string& keys, const Settings& settings = {}) {
  return expandText(
      R"J({ "resources": { "t": { "texture": "rgba8", )J" + keys +
          R"J( } }, "passes": [ { "name": "p", "type": "compute", "shader": "a.comp.glsl", "threads": 1, "side_effect": true, "write": { "t": "t" } } ] })J",
      settings);
}

}  // namespace

TEST_CASE("defines: booleans, numbers, choices with all their names") {
  const Expanded e = tryPass(
      R"J("defines": { "NEAR": "1 == 1", "N": "2 + 3", "X": 0.5, "CURVE": "$curve" }, "parameters": { "grain": { "default": true, "define": true }, "mode": { "default": "b-2", "choices": ["a", "b-2"], "define": true }, "lut": "$lut" })J",
      R"J(, "parameters": { "curve": { "default": "filmic", "choices": ["linear", "filmic"] }, "lut": { "default": false, "define": true } })J");
  // "b-2" is no name for a choice, so the reader refuses it
  CHECK_FALSE(e.graph);
  const Expanded good = tryPass(
      R"J("defines": { "NEAR": "1 == 1", "N": "2 + 3", "X": 0.5, "CURVE": "$curve" }, "parameters": { "grain": { "default": true, "define": true }, "mode": { "default": "b", "choices": ["a", "b"], "define": true }, "lut": "$lut" })J",
      R"J(, "parameters": { "curve": { "default": "filmic", "choices": ["linear", "filmic"] }, "lut": { "default": false, "define": true } })J");
  CHECK(good.text() == "");
  CHECK(good.define("p", "NEAR") == "1");
  CHECK(good.define("p", "N") == "5");
  CHECK(good.define("p", "X") == "0.5");
  CHECK(good.define("p", "CURVE") == "1");
  CHECK(good.define("p", "CURVE_LINEAR") == "0");
  CHECK(good.define("p", "CURVE_FILMIC") == "1");
  CHECK(good.define("p", "GRAIN") == "1");
  CHECK(good.define("p", "MODE") == "1");
  CHECK(good.define("p", "MODE_A") == "0");
  CHECK(good.define("p", "LUT") == "0");
  CHECK(good.spec("p").uniforms.empty());
}

TEST_CASE("uniforms carry values and the parameter behind them; what influences more is structural") {
  const Expanded e = tryPass(
      R"J("repeat": { "i": [0, 1] }, "enabled": "$gate || true", "parameters": { "a": "$plain", "b": "i / 4.0", "c": "$twice * 2", "d": { "default": [1, 2, 3] } })J",
      R"J(, "parameters": { "plain": { "default": 1.5 }, "base": { "default": 3.0 }, "gate": { "default": false } }, "let": { "twice": "$base * 2" })J");
  CHECK(e.uniform("p[1]", "a").value == Value::number(1.5));
  CHECK(e.uniform("p[1]", "a").path == "plain");
  CHECK(e.uniform("p[1]", "b").value == Value::number(0.25));
  CHECK(e.uniform("p[1]", "c").value == Value::number(12));
  CHECK(e.uniform("p[1]", "c").path == "");
  CHECK(e.uniform("p[1]", "d").path == "p.d");
  for (const ParameterSpec& parameter : e.graph->parameters) {
    INFO(parameter.path);
    CHECK(parameter.structural == (parameter.path == "gate"));
  }
  const Expanded through = tryPass(
      R"J("parameters": { "a": 1 }, "enabled": "$both")J",
      R"J(, "parameters": { "m": { "default": true }, "n": { "default": true } }, "let": { "both": "$m && $n" })J");
  REQUIRE_MESSAGE(through.graph, through.text());
  for (const ParameterSpec& parameter : through.graph->parameters) CHECK(parameter.structural);
}

TEST_CASE("age() is folded to the last version, also through a let") {
  const Expanded e = expandText(R"J({ "let": { "fade": "min(age(a) / 0.25, 1)", "half": "$fade / 2" },
    "resources": { "out": { "texture": "rgba8", "size": 8 }, "a": { "texture": "rgba8", "size": 8 } },
    "passes": [ { "name": "one", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "a" }, "parameters": { "f": "$half", "g": "age(a)" } },
                { "name": "two", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "s": "a" }, "write": { "r": "a" } },
                { "name": "three", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "s": "a" }, "write": { "r": "out" } } ], "present": "out" })J");
  CHECK(e.text() == "");
  std::uint32_t asked = kNone;
  const auto age = [&](std::uint32_t key) {
    asked = key;
    return 0.1;
  };
  CHECK(e.uniform("one", "f").dynamic.evaluateFolded(age).v[0] == doctest::Approx(0.2));
  CHECK(e.graph->resourceNames[asked] == "a#2");
  CHECK(e.uniform("one", "g").dynamic.evaluateFolded(age).v[0] == doctest::Approx(0.1));
  const Expanded size = expandText(
      R"J({ "let": { "fade": "age(a)" }, "resources": { "a": { "texture": "rgba8", "size": "$fade" } }, "passes": [] })J");
  CHECK(size.has(Code::badTime));
  const Expanded slow = tryPass(R"J("update": "on_change", "parameters": { "t": "age(out)" })J", "");
  CHECK(slow.of(Code::badTime).pass == "p");
}

TEST_CASE("--set: suffixes, types, ranges, choices") {
  const std::string head =
      R"J(, "parameters": { "n": { "default": 3, "min": 0, "max": 6 }, "f": { "default": 0.5 }, "b": { "default": true }, "v": { "default": [1, 2] }, "c": { "default": "no", "choices": ["no", "yes"] } })J";
  const std::string pass =
      R"J("parameters": { "n": "$n", "f": "$f", "b": "$b", "v": "$v", "own": { "default": 1.0 } }, "defines": { "C": "$c" })J";
  const Expanded e = tryPass(
      pass, head,
      with({{"n", "4"}, {"f", "-1.5e1"}, {"b", "false"}, {"v", "[3, 4.5]"}, {"c", "yes"}, {"own", "2"}}));
  CHECK(e.text() == "");
  CHECK(e.uniform("p", "n").value == Value::number(4));
  CHECK(e.uniform("p", "f").value == Value::number(-15));
  CHECK(e.uniform("p", "b").value == Value::boolean(false));
  CHECK(toText(e.uniform("p", "v").value) == "[3, 4.5]");
  CHECK(e.define("p", "C") == "1");
  CHECK(e.uniform("p", "own").value == Value::number(2));
  CHECK(tryPass(pass, head, with({{"p.own", "7"}})).uniform("p", "own").value == Value::number(7));
  CHECK(tryPass(pass, head, with({{"n", "7"}}))
            .of(Code::numberOutOfRange)
            .expected.starts_with("a whole number from 0 to 6, as test.json:1:"));
  CHECK(tryPass(pass, head, with({{"n", "2.5"}})).has(Code::badParameterValue));
  CHECK(tryPass(pass, head, with({{"n", "nan"}})).has(Code::badParameterValue));
  CHECK(tryPass(pass, head, with({{"b", "1"}})).has(Code::badParameterValue));
  CHECK(tryPass(pass, head, with({{"v", "[1]"}})).has(Code::badParameterValue));
  CHECK(tryPass(pass, head, with({{"c", "yess"}})).of(Code::badParameterValue).hint == "did you mean 'yes'?");
  CHECK(tryPass(pass, head, with({{"owm", "2"}})).of(Code::unknownParameter).hint == "did you mean 'own'?");
}

TEST_CASE("--set and --disable of names that several things end in") {
  const std::string text = R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "a", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "out" }, "parameters": { "k": { "default": 1.0 }, "on": { "default": true } } },
    { "name": "b", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [0, 2] }, "read": { "s": "out" }, "write": { "r": "out" }, "parameters": { "k": { "default": 1.0 } } } ], "present": "out" })J";
  const Expanded both = expandText(text, with({{"k", "2"}}));
  CHECK(both.of(Code::ambiguousName).found == "a.k, b.k");
  CHECK(expandText(text, with({{"b.k", "2"}})).uniform("b[0]", "k").value == Value::number(2));
  CHECK(expandText(text, with({}, {"b"})).names() == "a");
  CHECK(expandText(text, with({}, {"b[1]"})).names() == "a b[0] b[2]");
  CHECK(expandText(text, with({}, {"bb"})).has(Code::unknownPass));
  CHECK(expandText(text, with({}, {"on"})).of(Code::parameterNotPass).hint == "--set on=VALUE");
}

TEST_CASE("has() of a pass is whether nothing disables all of it by name") {
  const std::string text = R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "first", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "out" } },
    { "name": "with", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": "has(b)", "read": { "s": "out" }, "write": { "r": "out" } },
    { "name": "b", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [0, 1] }, "read": { "s": "out" }, "write": { "r": "out" } } ], "present": "out" })J";
  CHECK(expandText(text).names() == "first with b[0] b[1]");
  CHECK(expandText(text, with({}, {"b"})).names() == "first");
  CHECK(expandText(text, with({}, {"b[1]"})).names() == "first with b[0]");
  CHECK(expandText(text, with({}, {"with"})).names() == "first b[0] b[1]");
  std::string other = text;
  other.replace(other.find("\"repeat\""), 0, "\"enabled\": false, ");
  CHECK(expandText(other).names() == "first");
  other = text;
  other.replace(other.find("has(b)"), 6, "has(c)");
  CHECK(expandText(other).has(Code::unknownVariable));
}

TEST_CASE("has() of a pass of an included file is whether nothing disables it or the include") {
  const TestFolder folder("values_test_has_below");
  folder.write("in.json", R"J({ "resources": { "c": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "c" } } ] })J");
  folder.write("mid.json", R"J({ "passes": [ { "include": "in.json" } ] })J");
  const auto names = [&](const std::string& asked, const std::string& disabled,
                         const std::string& stanza = "") {
    const std::string path =
        folder.write("top.json", R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "with", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": ")J" +
                                     asked + R"J(", "write": { "r": "out" } },
    { "include": "mid.json")J" + stanza +
                                     R"J( },
    { "name": "end", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "s": "out?", "t": "mid.in.c?" }, "write": { "r": "out" } } ],
    "present": "out" })J");
    Expanded e;
    const auto desc = readGraph(path, e.diagnostics);
    REQUIRE_MESSAGE(desc, e.text());
    e.graph = expandGraph(*desc, testRegistry(), disabled.empty() ? Settings{} : with({}, {disabled}),
                          e.diagnostics);
    return e.has(Code::unknownVariable) ? "unknown" : e.names();
  };
  CHECK(names("has(mid.in.p)", "") == "with mid.in.p end");
  CHECK(names("has(mid.in.p)", "mid.in.p") == "end");
  CHECK(names("has(mid.in.p)", "mid.in") == "end");
  CHECK(names("has(mid.in.p)", "mid") == "end");
  CHECK(names("has(mid.in.p)", "", R"(, "enabled": false)") == "end");
  CHECK(names("has(mid.in.q)", "") == "unknown");
  CHECK(names("has(in.p)", "") == "unknown");
}

TEST_CASE("--disable of a name in a file that is included twice means both, of two files neither") {
  const TestFolder folder("values_test_files");
  folder.write("in.json", R"J({ "resources": { "c": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "c" } },
    { "name": "fix", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [0, 1] }, "read": { "s": "c" }, "write": { "r": "c" } } ] })J");
  folder.write("mid.json", R"J({ "passes": [ { "include": "in.json" } ] })J");
  const auto names = [&](const std::string& pass, const std::string& more = "") {
    const std::string path = folder.write(
        "top.json",
        R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 } },
    "passes": [ { "include": "in.json", "as": "a" }, { "include": "mid.json", "as": "b" }, )J" +
            more +
            R"J( { "name": "sum", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "s": "a.c", "t": "b.in.c" }, "write": { "r": "out" } } ], "present": "out" })J");
    Expanded e;
    const auto desc = readGraph(path, e.diagnostics);
    REQUIRE_MESSAGE(desc, e.text());
    e.graph = expandGraph(*desc, testRegistry(), with({}, {pass}), e.diagnostics);
    return e.has(Code::ambiguousName) ? e.of(Code::ambiguousName).found : e.names();
  };
  CHECK(names("fix") == "a.p b.in.p sum");
  CHECK(names("fix[1]") == "a.p a.fix[0] b.in.p b.in.fix[0] sum");
  CHECK(names("a.fix") == "a.p b.in.p b.in.fix[0] b.in.fix[1] sum");
  CHECK(names("in.fix") == "a.p a.fix[0] a.fix[1] b.in.p sum");
  folder.write("other.json", R"J({ "resources": { "d": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "fix", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "d" }, "side_effect": true } ] })J");
  CHECK(names("fix", R"({ "include": "other.json" },)") == "a.fix, b.in.fix, other.fix");
  // An include likewise.
  folder.write("high.json", R"J({ "passes": [ { "include": "mid.json" } ] })J");
  const std::string path = folder.write("top.json",
                                        R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 } },
    "passes": [ { "include": "high.json", "as": "a" }, { "include": "high.json", "as": "b" },
                { "name": "sum", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "s": "a.mid.in.c?" }, "write": { "r": "out" } } ], "present": "out" })J");
  Expanded e;
  const auto desc = readGraph(path, e.diagnostics);
  REQUIRE_MESSAGE(desc, e.text());
  e.graph = expandGraph(*desc, testRegistry(), with({}, {"mid"}), e.diagnostics);
  CHECK(e.names() == "sum");
}

TEST_CASE("state words, flags and per-slot blending") {
  const Expanded e = expandText(
      R"J({ "parameters": { "wire": { "default": true } }, "resources": { "out": { "texture": "rgba8", "size": 8, "clear": 0 }, "v": { "texture": "rg16f", "size": 8, "clear": 0 }, "d": { "texture": "depth32f", "size": 8, "clear": 0 } },
    "passes": [ { "name": "p", "type": "draw", "shader": "a", "list": "spheres", "geometry": "icosphere(2 + 1)", "modify": { "radiance": "out", "velocity": "v", "depth": "d" },
      "state": { "blend": { "radiance": "premultiplied" }, "depth_test": "greater_equal", "depth_write": false, "cull": "back", "polygon": "$wire ? line : fill", "offset": [2, 4] } } ], "present": "out" })J");
  CHECK(e.text() == "");
  const StateSpec& s = e.spec("p").state;
  REQUIRE(s.colors.size() == 1);
  CHECK(s.colors[0].first == "radiance");
  CHECK(s.colors[0].second.blend.color == BlendPart{BlendFactor::one, BlendFactor::one_minus_src_alpha});
  CHECK((s.depthTest && s.depthCompare == Compare::greater_equal && !s.depthWrite && s.cull == Cull::back &&
         s.lines));
  CHECK(s.offsetFactor == 2);
  CHECK(s.offsetUnits == 4);
  CHECK(e.spec("p").geometry == "icosphere");
  CHECK(e.spec("p").geometryArguments == std::vector<double>{3});
  CHECK(tryPass(R"J("state": { "blend": "ad" })J", "").of(Code::badState).hint == "did you mean 'add'?");
  CHECK(tryPass(R"J("state": { "blend": { "reslt": "add" } })J", "").of(Code::badState).hint ==
        "did you mean 'result'?");
  CHECK(tryPass(R"J("state": { "depth_test": "less" })J", "").has(Code::badState));
}

TEST_CASE("sizes: floored, at least 1, within their limits; levels clamped") {
  Settings odd;
  odd.screenWidth = 1281;
  odd.screenHeight = 1;
  const Expanded e = tryTexture(R"J("size": "screen/2", "mips": 6)J", odd);
  CHECK(e.resource("t").width == 640);
  CHECK(e.resource("t").height == 1);
  CHECK(e.resource("t").mips == 6);
  CHECK(tryTexture(R"J("size": 5, "mips": "full")J").resource("t").mips == 3);
  CHECK(tryTexture(R"J("size": [4, 4], "mips": 9)J").resource("t").bytes == (16 + 4 + 1) * 4);
  CHECK(tryTexture(R"J("size": [8, 4, 2])J").resource("t").target == Target::texture_3d);
  CHECK(tryTexture(R"J("size": [8, 4, 2])J").resource("t").depth == 2);
  CHECK(tryTexture(R"J("size": 8, "view": "cube")J").resource("t").layers == 6);
  CHECK(tryTexture(R"J("size": 8, "layers": 1)J").resource("t").target == Target::texture_2d_array);
  CHECK(tryTexture(R"J("size": 8, "samples": 4)J").has(Code::badFormat) == false);
  CHECK(tryTexture(R"J("size": 8, "mips": 1e9)J").of(Code::numberOutOfRange).expected ==
        "a whole number from 1 to 32");
  CHECK(tryTexture(R"J("size": 0)J").has(Code::numberOutOfRange));
  CHECK(tryTexture(R"J("size": "0 - screen")J").has(Code::numberOutOfRange));
  CHECK(tryTexture(R"J("size": 16385)J").has(Code::numberOutOfRange));
  CHECK(tryTexture(R"J("size": [1e300, 4])J").has(Code::numberOutOfRange));
  CHECK(tryTexture(R"J("size": 8, "layers": 2049)J").has(Code::numberOutOfRange));
  CHECK(tryTexture(R"J("size": 8, "history": 17)J").has(Code::numberOutOfRange));
  CHECK(tryTexture(R"J("size": 8, "samples": 3)J").has(Code::numberOutOfRange));
  CHECK(tryTexture(R"J("size": [8, 4], "view": "cube")J").has(Code::contradictoryTexture));
  CHECK(tryTexture(R"J("size": 8, "view": "3d")J").has(Code::contradictoryTexture));
  CHECK(tryTexture(R"J("size": 8, "samples": 4, "mips": 2)J").has(Code::contradictoryTexture));
  CHECK(expandText(R"J({ "resources": { "b": { "buffer": 3e9 } } })J").has(Code::numberOutOfRange));
  CHECK(expandText(R"J({ "resources": { "b": { "texture": "rgba8f", "size": 1 } } })J")
            .of(Code::unknownFormat)
            .hint == "write 'rgba8'");
}

TEST_CASE("definitions that depend on themselves say how") {
  CHECK(
      expandText(
          R"J({ "let": { "a": "$b + 1", "b": "$a" }, "resources": { "t": { "texture": "rgba8", "size": "$a" } } })J")
          .of(Code::dependsOnItself)
          .message == "$a depends on itself: $a -> $b -> $a");
  CHECK(
      expandText(
          R"J({ "resources": { "t": { "texture": "rgba8", "size": "size(u)" }, "u": { "texture": "rgba8", "size": "size(t)/2" } } })J")
          .of(Code::dependsOnItself)
          .message == "'t' depends on itself: 't' -> 'u' -> 't'");
  CHECK(expandText(R"J({ "resources": { "t": ["u"], "u": ["v"], "v": ["t"] } })J")
            .of(Code::dependsOnItself)
            .message == "'t' depends on itself: 't' -> 'u' -> 'v' -> 't'");
  CHECK(
      expandText(
          R"J({ "let": { "a": "size(t).x" }, "resources": { "t": { "texture": "rgba8", "size": "$a" } } })J")
          .of(Code::dependsOnItself)
          .message.find("'t' -> $a -> 't'") != std::string::npos);
}

TEST_CASE("repeats: order, names, empty ranges, later bounds from earlier indices") {
  const auto names = [](const std::string& repeat) {
    const Expanded e = tryPass(R"J("repeat": )J" + repeat + R"J(, "read": { "s": "out?" })J", "");
    return e.graph ? e.names() : e.text();
  };
  CHECK(names(R"J({ "i": [1, 3] })J") == "p[1] p[2] p[3]");
  CHECK(names(R"J({ "i": [3, 1, -1] })J") == "p[3] p[2] p[1]");
  CHECK(names(R"J([{ "k": [1, 2] }, { "j": ["k-1", 0, -1] }])J") == "p[1,0] p[2,1] p[2,0]");
  CHECK(names(R"J({ "i": [0, 1e8] })J").find("W081") != std::string::npos);
  CHECK(names(R"J({ "i": [0, 3, 0] })J").find("W048") != std::string::npos);
  CHECK(names(R"J({ "i": [0, 1.5] })J").find("W051") != std::string::npos);
  // no pass is left to write what is shown, which names the range
  CHECK(names(R"J({ "i": [1, 0] })J").find("W060") != std::string::npos);
}

TEST_CASE("formats and sizes of levels are those of another resource") {
  const char* const graph = R"J({
    "parameters": { "precision": { "default": "rgba8", "choices": ["rgba8", "rgba16f"] } },
    "resources": {
      "hdr": { "texture": "$precision", "size": [100, 13], "mips": 4 },
      "blurred": { "texture": "format(hdr)", "size": "size(hdr.mip[2])" },
      "last": { "texture": "format(blurred) == rgba16f ? r16f : r8", "size": "size(hdr.mip[3])" }
    },
    "passes": [
      { "name": "p", "type": "compute", "shader": "a.comp.glsl", "side_effect": true, "repeat": { "i": [0, 3] },
        "write": { "a": "hdr.mip[i]" }, "parameters": { "texels": "size(hdr.mip[i])" } },
      { "name": "q", "type": "compute", "shader": "a.comp.glsl", "side_effect": true,
        "write": { "b": "blurred", "c": "last" } } ] })J";
  const Expanded e = expandText(graph);
  CHECK(e.text() == "");
  CHECK(e.resource("hdr").format == Format::rgba8);
  CHECK(e.resource("blurred").format == Format::rgba8);
  CHECK(e.resource("last").format == Format::r8);
  CHECK(e.resource("blurred").width == 25);
  CHECK(e.resource("blurred").height == 3);
  CHECK(e.resource("last").width == 12);
  CHECK(e.resource("last").height == 1);
  CHECK(e.uniform("p[3]", "texels").value == Value{Value::Type::list, 2, {12, 1, 0, 0}, {}});
  CHECK(e.graph->parameters[0].structural);
  Settings settings;
  settings.sets.emplace_back("precision", Value::text("rgba16f"), Origin::panel);
  const Expanded other = expandText(graph, settings);
  CHECK(other.resource("blurred").format == Format::rgba16f);
  CHECK(other.resource("last").format == Format::r16f);
}

TEST_CASE("the size of a level that is not there, and what has no format") {
  CHECK(tryTexture(R"J("mips": 3, "size": [16, 16] }, "u": { "texture": "r8", "size": "size(t.mip[3])")J")
            .has(Code::missingSubresource));
  CHECK(tryTexture(R"J("size": 4 }, "u": { "texture": "format(v)", "size": 4 }, "v": { "buffer": 16)J")
            .has(Code::wrongValueType));
  CHECK(tryTexture(R"J("size": 4 }, "u": { "texture": "size(t).x", "size": 4)J").has(Code::unknownFormat));
  CHECK(tryTexture(R"J("size": 4 }, "u": { "texture": "format(u)", "size": 4)J").has(Code::dependsOnItself));
}

TEST_CASE("a parameter of several values is an element each; what a level depends on is structural") {
  const Expanded e = tryPass(
      R"J("repeat": { "i": [0, 1] }, "parameters": { "taps": [1, "$a", "i", 4, 5], "m": [["$b", 1], [2, "3*i"]], "l": "size(t.mip[$c]).x" })J",
      R"J(, "parameters": { "a": { "default": 2.5 }, "b": { "default": 7.0 }, "c": { "default": 1, "min": 0 } })J");
  const Expanded good = expandText(
      R"J({ "parameters": { "a": { "default": 2.5 }, "b": { "default": 7.0 }, "c": { "default": 1, "min": 0, "max": 2 } },
  "resources": { "t": { "texture": "rgba8", "size": [16, 8], "mips": 3 } },
  "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "side_effect": true, "repeat": { "i": [0, 2] }, "write": { "r": "t.mip[i]" },
    "parameters": { "taps": [1, "$a", "i", 4, 5], "m": [["$b", 1], [2, "3*i"]], "l": "size(t.mip[$c]).x" } } ], "present": "t" })J");
  CHECK(e.has(Code::unknownVariable));  // there is no 't'
  CHECK(good.text() == "");
  const std::vector<UniformSpec>& uniforms = good.spec("p[1]").uniforms;
  REQUIRE(uniforms.size() == 8);
  for (std::uint32_t i = 0; i < 5; ++i) {
    CHECK(uniforms[i].text() == "taps[" + std::to_string(i) + "]");
    CHECK(uniforms[i].elements == 5);
  }
  CHECK(uniforms[1].value == Value::number(2.5));
  CHECK(uniforms[2].value == Value::number(1));
  CHECK(uniforms[5].value == Value{Value::Type::list, 2, {7, 1, 0, 0}, {}});
  CHECK(uniforms[6].value == Value{Value::Type::list, 2, {2, 3, 0, 0}, {}});
  CHECK(uniforms[7].value == Value::number(8));
  CHECK_FALSE(good.graph->parameters[0].structural);
  CHECK_FALSE(good.graph->parameters[1].structural);
  CHECK(good.graph->parameters[2].structural);
}
