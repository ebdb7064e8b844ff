#include "engine/graph/read/read.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/graph/language/keys.h"
#include "tests/graph/language/expr_text.h"
#include "tests/json_pointer.h"

using namespace weft::graph;
using weft::text::Code;
using weft::text::Diagnostics;

namespace {

const std::filesystem::path kPaper = std::filesystem::path(WEFT_SOURCE_DIR) / "tests/graph/paper";

std::shared_ptr<const GraphDesc> read(const std::string& text) {
  Diagnostics diagnostics;
  auto graph = readGraphText(text, "t.json", diagnostics);
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  REQUIRE(graph);
  return graph;
}

// "W004 2:5 /passes/0/raed" of every diagnostic, in order.
std::string wrong(const std::string& text) {
  Diagnostics diagnostics;
  readGraphText(text, "t.json", diagnostics);
  std::string out;
  for (const auto& d : diagnostics.items())
    out += (out.empty() ? "" : "; ") + nameOf(d.code) + " " + std::to_string(d.place.line) + ":" +
           std::to_string(d.place.column) + " " + weft::test::pointerTo(text, d);
  return out;
}

std::string hintOf(const std::string& text) {
  Diagnostics diagnostics;
  readGraphText(text, "t.json", diagnostics);
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  return diagnostics.items()[0].hint;
}

const RefDesc* slotOf(const PassDesc& pass, const std::string& name) {
  for (const SlotDesc& slot : pass.slots)
    if (slot.name == name) return &slot.ref;
  return nullptr;
}

}  // namespace

TEST_CASE("the project's graphs and the graphs in its documentation read without errors") {
  int graphs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WEFT_SOURCE_DIR "/graphs")) {
    if (entry.path().extension() != ".json") continue;
    Diagnostics diagnostics;
    CHECK(readGraph(entry.path().string(), diagnostics));
    CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
    ++graphs;
  }
  CHECK(graphs >= 1);

  std::ifstream in(WEFT_SOURCE_DIR "/docs/graph-format.md");
  const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::string fence = "```json\n";
  int blocks = 0;
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1), ++blocks) {
    const std::size_t from = at + fence.size();
    Diagnostics diagnostics;
    CHECK(
        readGraphText(page.substr(from, page.find("```", from) - from), "docs/graph-format.md", diagnostics));
    CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  }
  CHECK(blocks >= 1);
}

TEST_CASE("graph-format.md names every key of the format") {
  std::ifstream in(WEFT_SOURCE_DIR "/docs/graph-format.md");
  const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  for (const auto keys :
       {std::span<const KeySpec>(shapeOfFile(false).keys),
        std::span<const KeySpec>(shapeOf("parameter").keys),
        std::span<const KeySpec>(shapeOf("texture").keys), std::span<const KeySpec>(shapeOf("buffer").keys),
        std::span<const KeySpec>(shapeOf("import").keys), std::span<const KeySpec>(shapeOf("input").keys),
        std::span<const KeySpec>(shapeOf("pass").keys), std::span<const KeySpec>(shapeOf("include").keys),
        std::span<const KeySpec>(shapeOf("state").keys), placeKeys()})
    for (const KeySpec& spec : keys) {
      const std::string key(spec.key);
      CHECK_MESSAGE((page.find("`" + key + "`") != std::string::npos ||
                     page.find("\"" + key + "\"") != std::string::npos),
                    key);
    }
}

TEST_CASE("the papers' graphs read without errors") {
  for (const char* name :
       {"studio.json", "post.json", "bloom.json", "ibl.json", "deferred.json", "gi.json"}) {
    Diagnostics diagnostics;
    const auto graph = readGraph((kPaper / name).string(), diagnostics);
    CHECK(graph);
    CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  }
}

TEST_CASE("every part of a graph arrives in its description") {
  const auto graph = read(R"json({
  "$schema": "../docs/graph.schema.json", "name": "all",
  "parameters": {
    "bloom": { "default": true, "label": "Bloom", "doc": "Glow around lights", "define": true },
    "count": { "default": 3, "min": 0, "max": 6 },
    "scale": { "default": 1.0, "min": 0.25, "max": 2, "step": 0.0625 },
    "tint": { "default": [1, 0.5, 0] }, "pair": { "type": "vec2", "default": [1, 2] }, "four": { "default": [1, 2, 3, 4] },
    "curve": { "default": "filmic", "choices": ["linear", "filmic"] },
    "lut": { "type": "file", "default": "" }, "real": { "type": "float", "default": 3 }
  },
  "let": { "half": "size(hdr)/2", "two": 2 },
  "inputs": ["outer as linear wrap ?"],
  "resources": {
    "hdr": { "texture": "rgba16f", "size": "screen", "clear": [0, 0, 0, 1], "sample": "linear mirror" },
    "sky": { "texture": "rgba16f", "size": [1024, 512], "mips": "full" },
    "maps": { "texture": "depth32f", "view": "cube_array", "size": 64, "layers": "$count", "mips": 2, "array": 3, "samples": 4, "clear": 1 },
    "flat": { "texture": "r8", "view": "2d", "size": 64 },
    "mean": { "buffer": "16 * $two", "history": 1, "first": -1.0, "reset": ["@cut", "size(hdr)", "camera"] },
    "camera": { "import": "camera", "jitter": "$bloom ? 16 : 0", "file": "a b/c.cube", "other_file": "$lut", "method": "cpu_radix" },
    "order": ["mean if $bloom", "outer"], "alias": "@environment"
  },
  "passes": [
    { "name": "one", "type": "draw", "shader": "a/b", "enabled": "$bloom", "repeat": [{ "k": [1, "$count"] }, { "j": ["k-1", 0, -1] }],
      "write": { "velocity": "flat" }, "read": { "source": "sky.mip[k]" }, "modify": { "result": "hdr" },
      "parameters": { "stage": "k", "radius": { "default": 0.5, "min": 0 } }, "defines": { "NEAR": "j == 0" },
      "state": { "blend": { "result": "premultiplied", "velocity": "none" }, "depth_test": "greater", "offset": [2, 4] },
      "update": "on_change", "slices": 4, "threads": [1, "size(hdr).y"], "instances": "$count",
      "list": "spheres", "geometry": "icosphere($count)", "view": "@sun", "feedback": true, "side_effect": true },
    { "name": "two", "type": "fullscreen", "repeat": { "b": [0, 1], "a": [0, "b"] }, "state": { "blend": "add" } }
  ],
  "present": "hdr",
  "outputs": { "mean": "mean?" }
})json");
  CHECK(graph->name == "all");
  CHECK(graph->files == std::vector<std::string>{"t.json"});
  using P = ParameterDesc::Type;
  const std::vector<P> types = {P::boolean, P::integer, P::number, P::vec3,  P::vec2,
                                P::vec4,    P::choice,  P::file,   P::number};
  REQUIRE(graph->parameters.size() == types.size());
  for (std::size_t i = 0; i < types.size(); ++i)
    CHECK_MESSAGE(graph->parameters[i].type == types[i], graph->parameters[i].name);
  CHECK(graph->parameters[0].define);
  CHECK(graph->parameters[0].doc == "Glow around lights");
  CHECK(graph->parameters[2].step == 0.0625);
  CHECK(toText(graph->parameters[3].initial) == "[1, 0.5, 0]");
  CHECK(graph->parameters[6].choices.size() == 2);
  CHECK(graph->parameters[6].initial == Value::text("filmic"));
  CHECK(graph->parameters[1].place.line == 5);
  CHECK(graph->parameters[1].place.column == 5);

  CHECK(graph->lets.size() == 2);
  REQUIRE(graph->resources.size() == 9);
  const std::vector<ResourceDesc>& all = graph->resources;
  CHECK(all[0].kind == ResourceDesc::Kind::input);
  CHECK(all[0].name == "outer");
  CHECK(all[0].optional);
  CHECK(all[0].sample->sampler.wrap == Wrap::repeat);
  CHECK(all[1].sample->sampler == Sampler{.linear = true, .wrap = Wrap::mirror});
  CHECK(all[1].clear.text() == "[0, 0, 0, 1]");
  CHECK(all[2].fullMips);
  CHECK(all[3].view == "cube_array");
  CHECK(all[3].layers.text() == "$count");
  CHECK(all[3].array.text() == "3");
  CHECK(all[3].samples.text() == "4");
  CHECK(all[4].view.empty());
  const ResourceDesc& mean = all[5];
  CHECK(mean.kind == ResourceDesc::Kind::buffer);
  CHECK(mean.bytes.text() == "16 * $two");
  CHECK(mean.resetRefs.size() == 2);
  CHECK(mean.resetValues.size() == 1);
  const ResourceDesc& camera = all[6];
  CHECK(camera.import.type == "camera");
  REQUIRE(camera.import.arguments.size() == 4);
  CHECK(textOf(camera.import.arguments[1].expr) == "a b/c.cube");
  CHECK(textOf(camera.import.arguments[2].expr) == "$lut");
  CHECK(textOf(camera.import.arguments[3].expr) == "cpu_radix");
  CHECK(all[7].alternatives.size() == 2);
  CHECK(all[8].alternatives[0].import);

  REQUIRE(graph->passes.size() == 2);
  const PassDesc& one = graph->passes[0];
  CHECK(one.enabled.text() == "$bloom");
  REQUIRE(one.repeat.size() == 2);
  CHECK(one.repeat[1].index == "j");
  CHECK(one.repeat[1].step.text() == "-1");
  REQUIRE(one.slots.size() == 3);
  CHECK(one.slots[0].access == Access::write);  // in file order
  CHECK(one.slots[2].access == Access::modify);
  CHECK(slotOf(one, "source")->mip->first.text() == "k");
  CHECK(textOf(one.parameters[0].value) == "k");
  CHECK(one.parameters[1].declared->min == 0.0);
  CHECK(textOf(one.defines[0].expr) == "j == 0");
  REQUIRE(one.state.size() == 4);
  CHECK(one.state[0].name == "blend.result");
  CHECK(one.state[1].name == "blend.velocity");
  CHECK(one.state[2].name == "depth_test");
  CHECK(textOf(one.state[3].expr) == "[2, 4]");
  CHECK(one.cadence == Cadence::on_change);
  CHECK(one.geometry == "icosphere");
  CHECK(one.geometryArguments[0].text() == "$count");
  CHECK(one.view->name == "sun");
  CHECK(one.feedback);
  CHECK(one.sideEffect);
  CHECK(graph->passes[1].repeat[0].index == "b");
  CHECK(graph->passes[1].state[0].name == "blend");
  CHECK(graph->present->name == "hdr");
  CHECK(graph->outputs[0].ref.optional);
  CHECK(graph->unread.empty());
}

TEST_CASE("everything wrong is reported at once, in the order of the text") {
  CHECK(
      wrong(R"({
  "nmae": "x",
  "parameters": { "a": { "default": 9, "max": 3 }, "b": 4, "mip": { "default": 1 } },
  "let": { "a": "1 +" },
  "resources": { "t": { "texture": "r8", "sise": 4 }, "u": { "bufer": 3 }, "v": {}, "i": { "input": "image" } },
  "passes": [ { "name": "p", "type": "compute", "enabled": "$", "read": { "s": "t.mip" }, "update": "never" }, 3 ],
  "present": 7
})") ==
      "W004 2:3 /nmae; W013 3:37 /parameters/a/default; W003 3:57 /parameters/b; W012 3:60 /parameters/mip; "
      "W009 4:12 /let/a; W020 4:21 /let/a; W004 5:42 /resources/t/sise; W004 5:62 /resources/u/bufer; "
      "W005 5:81 /resources/v; W005 5:90 /resources/i; W020 6:61 /passes/0/enabled; "
      "W021 6:86 /passes/0/read/s; W011 6:101 /passes/0/update; W003 6:112 /passes/1; W003 7:14 /present");
}

TEST_CASE("keys: unknown, missing, misspelt") {
  CHECK(hintOf(R"({"passes": [], "resorces": {}})") == "did you mean \"resources\"?");
  CHECK(wrong(R"({"name": "x"})") == "W005 1:1 ");
  CHECK(wrong(R"([])") == "W003 1:1 ");
  CHECK(wrong(R"({"passes": [{}]})") == "W005 1:13 /passes/0; W005 1:13 /passes/0");
  CHECK(wrong(R"({"passes": [{"name": "p", "tpye": "compute"}]})") == "W004 1:27 /passes/0/tpye");
  // It is read as what is meant; that the file is not there is another mistake.
  CHECK(wrong(R"({"passes": [{"incldue": "no.json"}]})") ==
        "W004 1:14 /passes/0/incldue; W001 1:25 /passes/0/incldue");
  CHECK(wrong(R"({"passes": [{"name": "p", "type": "draw", "state": {"cul": "back"}}]})") ==
        "W004 1:53 /passes/0/state/cul");
}

TEST_CASE("duplicate names") {
  CHECK(wrong(R"({"passes": [{"name": "p", "type": "x"}, {"name": "p", "type": "x"}]})") ==
        "W009 1:50 /passes/1/name");
  CHECK(wrong(R"({"resources": {"a": "b", "a": "c"}, "passes": []})") == "W006 1:26 /resources/a");
  CHECK(
      wrong(
          R"({"passes": [{"name": "p", "type": "x", "read": {"s": "a"}, "write": {"s": "b"}, "parameters": {"s": 1}, "defines": {"s": 1}}]})") ==
      "W009 1:70 /passes/0/write/s; W009 1:96 /passes/0/parameters/s; W009 1:117 /passes/0/defines/s");
  CHECK(wrong(R"({"passes": [{"name": "p", "type": "x", "repeat": [{"i": [0, 1]}, {"i": [0, 1]}]}]})") ==
        "W009 1:67 /passes/0/repeat/1/i");
}

TEST_CASE("parameters are held against themselves") {
  const auto with = [](const std::string& parameter) {
    return wrong("{\"passes\": [], \"parameters\": {\"p\": " + parameter + "}}");
  };
  CHECK(with(R"({"type": "int", "default": 1.5})") == "W003 1:63 /parameters/p/default");
  CHECK(with(R"({"type": "vec3", "default": [1, 2]})") == "W003 1:64 /parameters/p/default");
  CHECK(with(R"({"type": "bool", "default": 1})") == "W003 1:64 /parameters/p/default");
  CHECK(with(R"({"type": "flaot", "default": 1})") == "W011 1:45 /parameters/p/type");
  CHECK(with(R"({"default": "x"})") == "W005 1:36 /parameters/p");
  CHECK(with(R"({"default": "x", "choices": ["a", "b"]})") == "W025 1:48 /parameters/p/default");
  CHECK(with(R"({"default": "a", "choices": ["a", "a"]})") == "W009 1:70 /parameters/p/choices/1");
  CHECK(with(R"({"default": "a", "choices": ["a", "b c"]})") == "W012 1:70 /parameters/p/choices/1");
  CHECK(with(R"({"default": "a", "choices": []})") == "W003 1:64 /parameters/p/choices");
  CHECK(with(R"({"type": "choice", "default": "a"})") == "W005 1:36 /parameters/p");
  CHECK(with(R"({"default": true, "min": 0})") == "W014 1:61 /parameters/p/min");
  CHECK(with(R"({"default": 1, "choices": ["a"]})") == "W014 1:62 /parameters/p/choices");
  CHECK(with(R"({"default": 1, "min": 3, "max": 2})") == "W013 1:58 /parameters/p/min");
  CHECK(with(R"({"default": [0, 9], "max": 2})") == "W013 1:52 /parameters/p/default/1");
  CHECK(with(R"({"default": 1, "step": 0})") == "W013 1:59 /parameters/p/step");
  CHECK(with(R"({"default": [1]})") == "W003 1:48 /parameters/p/default");
  CHECK(with(R"({"default": [1, "2"]})") == "W003 1:52 /parameters/p/default/1");
  CHECK(with(R"({"default": null})") == "W003 1:48 /parameters/p/default");
  CHECK(with(R"({"label": "x"})") == "W005 1:36 /parameters/p");
}

TEST_CASE("keys that exclude each other, words, ranges") {
  CHECK(wrong(R"({"passes": [], "resources": {"r": {"texture": "r8", "buffer": 4, "size": 1}}})") ==
        "W014 1:35 /resources/r");
  CHECK(wrong(R"({"passes": [], "resources": {"r": {"buffer": 4, "first": 0, "reset": "@cut"}}})") ==
        "W014 1:58 /resources/r/first; W014 1:70 /resources/r/reset");
  CHECK(wrong(R"({"passes": [], "resources": {"r": {"texture": "r8", "size": 4, "view": "kube"}}})") ==
        "W011 1:72 /resources/r/view");
  CHECK(hintOf(R"({"passes": [], "resources": {"r": {"texture": "r8", "size": 4, "view": "cub"}}})") ==
        "did you mean \"cube\"?");
  CHECK(wrong(R"({"passes": [], "resources": {"r": {"texture": "r8", "size": [1, 2, 3, 4, 5]}}})") ==
        "W003 1:61 /resources/r/size");
  CHECK(wrong(R"({"passes": [], "resources": {"r": {"texture": "r8", "size": [1, null]}}})") ==
        "W003 1:65 /resources/r/size/1");
  CHECK(wrong(R"({"passes": [], "resources": {"r": []}})") == "W003 1:35 /resources/r");
  CHECK(wrong(R"({"passes": [], "resources": {"a.b": "c"}})") == "W012 1:30 /resources/a.b");
  CHECK(wrong(R"({"passes": [{"name": "p", "type": "x", "repeat": {"i": [0]}}]})") ==
        "W003 1:56 /passes/0/repeat/i");
  CHECK(wrong(R"({"passes": [{"name": "p", "type": "x", "repeat": {"i": [0, true]}}]})") ==
        "W003 1:60 /passes/0/repeat/i/1");
  CHECK(wrong(R"({"passes": [{"name": "p", "type": "x", "geometry": "icosphere("}]})") ==
        "W021 1:62 /passes/0/geometry");
  CHECK(wrong(R"({"passes": [{"name": "p", "type": "x", "before": "q"}]})") == "W016 1:50 /passes/0/before");
}

TEST_CASE("what could not be read is remembered, so that a use of it is no second error") {
  Diagnostics diagnostics;
  const auto graph = readGraphText(
      R"({"parameters": {"a": 3}, "let": {"b": "1 +"}, "resources": {"c": {}}, "passes": [{"name": "d", "type": 3},
      {"name": "e f", "type": "x"}]})",
      "t.json", diagnostics);
  REQUIRE(graph);
  CHECK(graph->unread == std::vector<std::string>{"a", "b", "c", "e f"});
  CHECK(diagnostics.errorCount() == 5);
  REQUIRE(graph->passes.size() == 2);
  CHECK(graph->passes[0].name == "d");
  CHECK(graph->passes[1].name == "_e_f");  // stays, so that the rest of it is checked
}
