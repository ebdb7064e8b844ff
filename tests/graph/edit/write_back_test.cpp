// Changes written back: the files read again give what was tweaked, and no other byte moves.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "engine/graph/edit/edit.h"
#include "engine/text/json/dom.h"
#include "tests/graph/expand/support.h"
#include "tests/graph/test_folder.h"
#include "tests/json_pointer.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

namespace fs = std::filesystem;

std::string contents(const std::string& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

class OverlayFolder : public TestFolder {
 public:
  OverlayFolder() : TestFolder("write_back_test_files") {}
  std::string copy(const std::string& name) const {
    return write(name, contents(std::string(WEFT_SOURCE_DIR) + "/graphs/" + name));
  }
};

std::shared_ptr<const FlatGraph> load(const std::string& path, const Settings& settings,
                                      std::span<const std::string> presets = {}) {
  text::Diagnostics diagnostics;
  const auto desc = readGraph(path, diagnostics, {.presets = presets});
  const auto flat = desc ? expandGraph(*desc, testRegistry(), settings, diagnostics) : nullptr;
  INFO(diagnostics.text());
  REQUIRE(flat);
  return flat;
}

const ParameterSpec& parameter(const FlatGraph& graph, const std::string& path) {
  const auto at = std::ranges::find(graph.parameters, path, &ParameterSpec::path);
  REQUIRE_MESSAGE(at != graph.parameters.end(), "no parameter ", path);
  return *at;
}

struct Written {
  std::optional<WriteBack> plan;
  text::Diagnostics diagnostics;
};

// Plans and saves.
Written writeBack(const std::string& path, const Settings& settings,
                  std::span<const std::string> presets = {}) {
  Written out;
  text::Diagnostics reading;
  const auto desc = readGraph(path, reading, {.presets = presets});
  INFO(reading.text());
  REQUIRE(desc);
  out.plan = planWriteBack(*desc, presets, testRegistry(), settings, out.diagnostics);
  if (out.plan && !saveWriteBack(*out.plan, out.diagnostics)) out.plan.reset();
  return out;
}

// `text` without the bytes of the values at `pointers`.
std::string around(const std::string& text, const std::vector<std::string>& pointers) {
  text::Diagnostics diagnostics;
  const auto root = text::parseJson(text, {}, diagnostics);
  REQUIRE(root);
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  for (const std::string& pointer : pointers)
    if (const auto* value = weft::test::findPointer(*root, pointer))
      ranges.emplace_back(value->begin, value->end);
  std::ranges::sort(ranges);
  std::string out;
  std::size_t at = 0;
  for (const auto& [begin, end] : ranges) {
    out += text.substr(at, begin - at) + "#";
    at = end;
  }
  return out + text.substr(at);
}

// A value a person could choose with the parameter's widget.
Value randomSetting(const ParameterDesc& desc, std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto number = [&] {
    const double x = uniform(desc.min.value_or(-5), desc.max.value_or(5));
    const double digits = std::pow(10, std::uniform_int_distribution<int>(0, 4)(random));
    return std::clamp(std::round(x * digits) / digits, desc.min.value_or(-5), desc.max.value_or(5));
  };
  switch (desc.type) {
    case ParameterDesc::Type::boolean:
      return Value::boolean(random() % 2 == 0);
    case ParameterDesc::Type::integer:
      return Value::number(std::clamp(std::round(number()), desc.min.value_or(-5), desc.max.value_or(5)));
    case ParameterDesc::Type::number:
      return Value::number(number());
    case ParameterDesc::Type::choice:
      return Value::text(desc.choices[random() % desc.choices.size()]);
    case ParameterDesc::Type::file:
      return Value::text(random() % 2 ? "luts/a \"b\".cube" : "");
    default:
      break;
  }
  Value list = desc.initial;
  for (int i = 0; i < list.count; ++i) list.v[static_cast<std::size_t>(i)] = number();
  return list;
}

constexpr const char* kSmall = R"({
  // what a person may change
  "name": "small",
  "parameters": {
    "gain": { "default": 1.0, "min": 0, "max": 8 }, // a float because of the point
    "steps": { "min": 1, "default": 3, "max": 9 },
    "tint":  { "default": [1.0, 0.5,   0], "min": 0, "max": 1 },
    "curve": { "choices": ["filmic", "aces"], "default": "filmic" /* Hable */ },
    "soft":  { "default": true }
  },
  "resources": { "a": { "texture": "rgba8", "size": "screen" }, "b": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "sky", "type": "fullscreen", "shader": "s.frag.glsl", "write": { "result": "a" },
      "parameters": { "gain_": "$gain", "own": { "type": "float", "default": 2 } } },
    { "name": "blur", "type": "fullscreen", "shader": "b.frag.glsl", "enabled": "$soft || $steps > 4", "read": { "source": "a" },
      "write": { "result": "a" } },
    {
      "name": "show",
      "type": "fullscreen",
      "shader": "c.frag.glsl", // the last step
      "read": { "source": "a" },
      "write": { "result": "b" }
    },
    { "name": "extra", "type": "fullscreen", "shader": "e.frag.glsl", "read": { "source": "b" }, "write": { "result": "b" } }
  ],
  "present": "b"
}
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("a value is written over the default and nothing else changes") {
  const OverlayFolder folder;
  const std::string path = folder.write("small.json", kSmall);
  const auto written = writeBack(path, {.sets = {{"gain", "2"},
                                                 {"steps", "5"},
                                                 {"tint", "[1, 0.25, 0]"},
                                                 {"curve", "aces"},
                                                 {"soft", "false"},
                                                 {"own", "0.1"}}});
  INFO(written.diagnostics.text());
  REQUIRE(written.plan);
  CHECK(written.plan->rest.sets.empty());
  std::string expected = replaced(kSmall, "\"default\": 1.0", "\"default\": 2.0");
  expected = replaced(expected, "\"default\": 3", "\"default\": 5");
  expected = replaced(expected, "[1.0, 0.5,   0]", "[1.0, 0.25,   0]");
  expected = replaced(expected, "\"default\": \"filmic\" /*", "\"default\": \"aces\" /*");
  expected = replaced(expected, "\"default\": true", "\"default\": false");
  expected = replaced(expected, "\"default\": 2 ", "\"default\": 0.1 ");
  CHECK(contents(path) == expected);
}

TEST_CASE("tweaks that the files say already leave them alone") {
  const OverlayFolder folder;
  const std::string path = folder.write("small.json", kSmall);
  const auto written = writeBack(path, {.sets = {{"gain", "1"}, {"curve", "filmic"}}});
  REQUIRE(written.plan);
  CHECK(written.plan->files.empty());
  CHECK(contents(path) == kSmall);
}

TEST_CASE("disabled passes: \"enabled\" beside the others, a condition is kept") {
  const OverlayFolder folder;
  const std::string path = folder.write("small.json", kSmall);
  const auto written = writeBack(path, {.disables = {"extra", "blur"}});
  INFO(written.diagnostics.text());
  REQUIRE(written.plan);
  std::string expected = replaced(kSmall, "\"e.frag.glsl\",", "\"e.frag.glsl\", \"enabled\": false,");
  expected = replaced(expected, "\"$soft || $steps > 4\"", "\"($soft || $steps > 4) && false\"");
  CHECK(contents(path) == expected);

  // One member a line: the new one has its own, the comment stays where it was.
  const std::string lines = folder.write(
      "lines.json", replaced(replaced(kSmall, "\"present\": \"b\"", "\"present\": \"a\""),
                             "\"write\": { \"result\": \"b\" }\n", "\"write\": { \"result\": \"a\" }\n"));
  const std::string before = contents(lines);
  REQUIRE(writeBack(lines, {.disables = {"show", "extra"}}).plan);
  CHECK(contents(lines) ==
        replaced(replaced(before, "// the last step\n", "// the last step\n      \"enabled\": false,\n"),
                 "\"e.frag.glsl\",", "\"e.frag.glsl\", \"enabled\": false,"));
}

TEST_CASE("a disabled include: \"enabled\" in its line, a condition is kept") {
  const OverlayFolder folder;
  folder.write("small.json", kSmall);
  const std::string top = R"({
  "parameters": { "on": { "default": true } },
  "passes": [
    { "include": "small.json", "as": "one" }, // kept
    { "include": "small.json", "as": "two", "enabled": "$on" },
    { "include": "small.json", "as": "three" }
  ],
  "present": "three.b"
}
)";
  const std::string path = folder.write("top.json", top);
  const auto written = writeBack(path, {.disables = {"one", "two"}});
  INFO(written.diagnostics.text());
  REQUIRE(written.plan);
  CHECK(contents(path) == replaced(replaced(top, "\"as\": \"one\"", "\"as\": \"one\", \"enabled\": false"),
                                   "\"$on\"", "\"$on && false\""));

  const std::string over = folder.write("over.json", R"({ "extends": "top.json" })");
  folder.write("top.json", top);
  REQUIRE(writeBack(over, {.disables = {"two"}}).plan);
  CHECK(contents(over) == R"({ "extends": "top.json", "passes": [{ "name": "two", "enabled": false }] })");
}

TEST_CASE("CRLF, tabs and a byte order mark stay") {
  const OverlayFolder folder;
  for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
    const std::string text = mark + replaced(replaced(kSmall, "\n", "\r\n"), "  ", "\t");
    const std::string path = folder.write("crlf.json", text);
    REQUIRE(writeBack(path, {.sets = {{"gain", "0.125"}}, .disables = {"extra"}}).plan);
    CHECK(contents(path) == replaced(replaced(text, "\"default\": 1.0", "\"default\": 0.125"),
                                     "\"e.frag.glsl\",", "\"e.frag.glsl\", \"enabled\": false,"));
  }
}

TEST_CASE("what decides a value is what changes: a set, a preset, an overlay, a file included twice") {
  const OverlayFolder folder;
  const std::string small = folder.write("small.json", kSmall);
  const std::string over = folder.write("over.json", R"({
	"extends": "small.json",
	"set": { "gain": 4 } // louder
}
)");
  REQUIRE(writeBack(over, {.sets = {{"gain", "5.5"}, {"own", "3"}}, .disables = {"blur"}}).plan);
  CHECK(contents(over) == R"({
	"extends": "small.json",
	"set": { "gain": 5.5, "own": 3 }, // louder
	"passes": [{ "name": "blur", "enabled": false }]
}
)");
  CHECK(contents(small) == kSmall);

  const std::vector<std::string> presets = {folder.write("look.json", "{ \"name\": \"look\" }")};
  REQUIRE(writeBack(small, {.sets = {{"curve", "aces"}}}, presets).plan);
  CHECK(contents(presets[0]) == "{ \"name\": \"look\", \"set\": { \"curve\": \"aces\" } }");
  CHECK(parameter(*load(small, {}, presets), "curve").value.symbol == "aces");
  CHECK(contents(small) == kSmall);

  folder.write(
      "part.json",
      R"({ "parameters": { "own": { "default": 1.0 } }, "resources": { "c": { "texture": "rgba8", "size": 4 } },
    "passes": [ { "name": "p", "type": "fullscreen", "shader": "p.frag.glsl", "write": { "result": "c" }, "parameters": { "amount": "$own" } } ] })");
  const std::string twice = folder.write("twice.json", R"({
  "name": "twice",
  "resources": { "d": { "texture": "rgba8", "size": 4 } },
  "passes": [
    { "include": "part.json", "as": "left" }, { "include": "part.json", "as": "right" },
    { "name": "sum", "type": "fullscreen", "shader": "q.frag.glsl", "read": { "one": "left.c", "two": "right.c" }, "write": { "result": "d" } }
  ],
  "present": "d"
})");
  const auto one = writeBack(twice, {.sets = {{"left.own", "7"}}});
  INFO(one.diagnostics.text());
  REQUIRE(one.plan);
  const auto after = load(twice, {});
  CHECK(parameter(*after, "left.own").value.v[0] == 7);
  CHECK(parameter(*after, "right.own").value.v[0] == 1);
}

TEST_CASE("a file that changed meanwhile is left as it is: W195") {
  const OverlayFolder folder;
  const std::string path = folder.write("small.json", kSmall);
  text::Diagnostics diagnostics;
  const auto desc = readGraph(path, diagnostics);
  const auto plan = planWriteBack(*desc, {}, testRegistry(), {.sets = {{"gain", "2"}}}, diagnostics);
  REQUIRE(plan);
  folder.write("small.json", std::string(kSmall) + "\n// somebody else\n");
  CHECK_FALSE(saveWriteBack(*plan, diagnostics));
  CHECK(diagnostics.contains(Code::fileChanged));
  CHECK(contents(path) == std::string(kSmall) + "\n// somebody else\n");
}

TEST_CASE("what has no place in the files is refused whole: W196") {
  const OverlayFolder folder;
  folder.write("part.json", R"({ "resources": { "c": { "texture": "rgba8", "size": 4 } },
    "passes": [ { "name": "p", "type": "fullscreen", "shader": "p.frag.glsl", "write": { "result": "c" } },
      { "name": "fix", "type": "fullscreen", "shader": "r.frag.glsl", "read": { "s": "c" }, "write": { "result": "c" } } ] })");
  const std::string twice = folder.write("twice.json", R"({
  "parameters": { "k": { "default": 1.0 } },
  "resources": { "d": { "texture": "rgba8", "size": 4 } },
  "passes": [
    { "include": "part.json", "as": "left" }, { "include": "part.json", "as": "right" },
    { "name": "sum", "type": "fullscreen", "shader": "q.frag.glsl", "read": { "one": "left.c", "two": "right.c" }, "write": { "result": "d" },
      "parameters": { "amount": "$k" } }
  ],
  "present": "d"
})");
  const std::string before = contents(twice);
  const auto written = writeBack(twice, {.sets = {{"k", "2"}}, .disables = {"left.fix"}});
  CHECK_FALSE(written.plan);
  CHECK(written.diagnostics.contains(Code::cannotWriteBack));
  CHECK(contents(twice) == before);
  // Disabled in both, it is written into the file that holds it.
  const auto both = writeBack(twice, {.disables = {"fix"}});
  INFO(both.diagnostics.text());
  REQUIRE(both.plan);
  CHECK(both.plan->rest.disables.empty());
  CHECK(contents(twice) == before);
  CHECK(load(twice, {})->passNames == std::vector<std::string>{"left.p", "right.p", "sum"});
}

TEST_CASE("random tweaks of the bundled graph come back from its files, and only values moved") {
  std::mt19937 random(7);
  for (int round = 0; round < 12; ++round) {
    const OverlayFolder folder;
    for (const char* name : {"ibl.json", "daylight.json", "daylight_sun.json", "lit.json",
                             "mesh_shadows.json", "neighbors.json", "fade.json", "post.json", "boxes.json"})
      folder.copy(name);
    for (const auto& effect : fs::directory_iterator(WEFT_SOURCE_DIR "/graphs/effects"))
      folder.copy("effects/" + effect.path().filename().string());
    const std::string path = folder.copy("studio.json");
    const auto start = load(path, {});
    Settings settings;
    for (const ParameterSpec& each : start->parameters)
      if (random() % 4 == 0) settings.sets.emplace_back(each.path, toText(randomSetting(each.desc, random)));
    const auto wanted = load(path, settings);
    const auto written = writeBack(path, settings);
    INFO(written.diagnostics.text());
    REQUIRE(written.plan);
    const auto after = load(path, {});
    for (const ParameterSpec& each : wanted->parameters) {
      INFO(each.path);
      const Value& value = parameter(*after, each.path).value;
      if (each.desc.type == ParameterDesc::Type::file && !each.value.symbol.empty())
        CHECK(fs::absolute(value.symbol).lexically_normal() ==
              fs::absolute(each.value.symbol).lexically_normal());
      else
        CHECK(value == each.value);
    }
    for (const WriteBack::File& file : written.plan->files) {
      const text::JsonTree before = text::parseJsonTree(file.before);
      std::vector<std::string> pointers;
      for (const ParameterSpec& each : start->parameters)
        if (*each.desc.initialPlace.file == file.path)
          pointers.push_back(
              text::pointerAt(before.root, text::offsetOf(file.before, each.desc.initialPlace)));
      CHECK(around(file.before, pointers) == around(contents(file.path), pointers));
    }
  }
}
