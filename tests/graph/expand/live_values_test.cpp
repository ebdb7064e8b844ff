// Live parameters: which there are, what is left of expressions that read them, and that a value set while a
// plan runs gives every uniform what the graph gives it when it is expanded anew.
#include <algorithm>
#include <bit>
#include <limits>
#include <random>

#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/names/settings.h"
#include "engine/graph/print/print.h"
#include "tests/graph/expand/support.h"
#include "tests/graph/language/expr_text.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using text::Code;

namespace {

// One pass `p` with `body` of its stanza, in a file with `head` before its passes.
Expanded expandPass(const std::string& head, const std::string& body, const Settings& settings = {}) {
  return expandText(
      R"J({ )J" + head +
          R"J(, "resources": { "out": { "texture": "rgba8", "size": 8 }, "in": { "texture": "rgba8", "size": 8, "clear": 0 } },
      "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "out" }, )J" +
          body + R"J( } ], "present": "out" })J",
      settings);
}

std::string liveOf(const Expanded& e) {
  REQUIRE_MESSAGE(e.graph, e.text());
  std::string all;
  for (const ParameterSpec& parameter : e.graph->parameters)
    if (!parameter.structural) all += (all.empty() ? "" : " ") + parameter.path;
  return all;
}

std::vector<Value> valuesOf(const FlatGraph& graph) {
  std::vector<Value> values;
  for (const ParameterSpec& parameter : graph.parameters) values.push_back(parameter.value);
  return values;
}

Value valueOf(const UniformSpec& uniform, std::span<const Value> values, double age) {
  return uniform.dynamic.present()
             ? uniform.dynamic.evaluateFolded([&](std::uint32_t) { return age; }, values)
             : uniform.value;
}

bool sameBits(const Value& a, const Value& b) {
  for (std::size_t i = 0; i < a.v.size(); ++i)
    if (std::bit_cast<std::uint64_t>(a.v[i]) != std::bit_cast<std::uint64_t>(b.v[i])) return false;
  return a.type == b.type && a.count == b.count && a.symbol == b.symbol;
}

Value randomValue(const ParameterDesc& desc, std::mt19937& random) {
  using Type = ParameterDesc::Type;
  const auto number = [&] {
    const double x =
        std::uniform_real_distribution<double>(desc.min.value_or(-8), desc.max.value_or(8))(random);
    return desc.type == Type::integer ? std::floor(x) : x;
  };
  switch (desc.type) {
    case Type::boolean:
      return Value::boolean(random() % 2 == 0);
    case Type::integer:
    case Type::number:
      return Value::number(number());
    case Type::choice:
      return Value::text(desc.choices[random() % desc.choices.size()]);
    case Type::file:
      return Value::text("");
    default:
      break;
  }
  Value list{Value::Type::list, static_cast<std::uint8_t>(componentsOf(desc.type)), {}, {}};
  for (std::size_t i = 0; i < list.count; ++i) list.v[i] = number();
  return list;
}

// What `base` gives with `values` against what the graph gives expanded with them.
void compare(const FlatGraph& base, const std::vector<Value>& values, const FlatGraph& anew) {
  REQUIRE(base.passNames == anew.passNames);
  const std::vector<Value> theirs = valuesOf(anew);
  for (std::size_t pass = 0; pass < base.specs.size(); ++pass) {
    const auto &mine = base.specs[pass].uniforms, &other = anew.specs[pass].uniforms;
    REQUIRE(mine.size() == other.size());
    for (std::size_t u = 0; u < mine.size(); ++u)
      for (const double age : {0.0, 0.1, 0.25, 7.5, std::numeric_limits<double>::infinity()}) {
        INFO(base.passNames[pass], " ", mine[u].name, " at age ", age);
        CHECK(sameBits(valueOf(mine[u], values, age), valueOf(other[u], theirs, age)));
      }
  }
}

}  // namespace

TEST_CASE("live: a parameter on which nothing but uniforms depends, also through let") {
  const std::string head =
      R"J("parameters": { "plain": { "default": 1.5 }, "base": { "default": 3.0 }, "speed": { "default": 0.25 }, "gate": { "default": true },
        "idle": { "default": 2.0 }, "mode": { "default": "b", "choices": ["a", "b"] }, "defined": { "default": 1 } },
      "let": { "twice": "$base * 2", "more": "$twice + 1", "fade": "min(age(in) / $speed, 1)" })J";
  const Expanded e =
      expandPass(head, R"J("read": { "s": "in ?" }, "enabled": "$gate", "defines": { "D": "$defined" },
      "parameters": { "a": "$plain", "b": "$more", "c": "$fade * $twice", "d": "$mode == b ? $plain : 0", "e": { "default": [1, 2] },
                      "f": { "type": "bool", "default": false, "define": true } })J");
  REQUIRE(e.diagnostics.size() == 1);
  CHECK(e.of(text::Code::unusedDeclaration).message.find("'idle'") != std::string::npos);
  CHECK(liveOf(e) == "plain base speed idle mode p.e");
  // What is known stays folded; parameters and ages are leaves.
  CHECK(textOf(e.uniform("p", "a").dynamic) == "$#0");
  CHECK(textOf(e.uniform("p", "b").dynamic) == "$#1 * 2 + 1");
  CHECK(e.uniform("p", "b").dynamic.parameterKeys() == std::vector<std::uint32_t>{1});
  CHECK(e.uniform("p", "b").value == Value::number(7));
  CHECK(textOf(e.uniform("p", "c").dynamic) == "min(age(#1) / $#2, 1) * ($#1 * 2)");
  CHECK(e.uniform("p", "c").dynamic.dynamic());
  CHECK(textOf(e.uniform("p", "d").dynamic) == "$#5 == b ? $#0 : 0");
  CHECK(e.uniform("p", "d").dynamic.parameterKeys() == std::vector<std::uint32_t>{0, 5});
  CHECK(textOf(e.uniform("p", "e").dynamic) == "$#7");
}

TEST_CASE("live: whatever shapes the plan is structural") {
  const auto live = [](const std::string& body, const std::string& more = "") {
    return liveOf(
        expandPass(R"J("parameters": { "px": { "default": 2 } }, "let": { "py": "$px + 1" })J" + more, body));
  };
  CHECK(live(R"J("parameters": { "a": "$py" })J") == "px");
  CHECK(live(R"J("parameters": { "a": "$py" }, "enabled": "$px > 0")J").empty());
  CHECK(live(R"J("parameters": { "a": "$py" }, "repeat": { "i": [1, "$py - 2"] })J").empty());
  CHECK(live(R"J("parameters": { "a": "$py" }, "defines": { "N": "$py" })J").empty());
  CHECK(live(R"J("parameters": { "a": "$py" }, "state": { "blend": "$px > 1 ? none : add" })J").empty());
  const Expanded size = expandText(
      R"J({ "parameters": { "px": { "default": 2 }, "pz": { "default": 2 }, "pw": { "default": 0.5 }, "pv": { "default": 2 } },
      "resources": { "out": { "texture": "rgba8", "size": "4 * $px", "clear": "$pw" }, "camera": { "import": "camera", "jitter": "$pz" }, "maybe": ["out if $pv > 1"] },
      "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "out" }, "parameters": { "a": "$px + $pz + $pw + $pv" } } ],
      "present": "out" })J");
  CHECK(liveOf(size).empty());
}

TEST_CASE("live: a branch that means nothing now leaves its parameters structural") {
  const std::string head =
      R"J("parameters": { "on": { "default": 0.0 }, "n": { "default": 0 }, "k": { "default": 1.0 } })J";
  const Expanded e =
      expandPass(head, R"J("enabled": "$n == 0", "parameters": { "a": "$on > 0 ? 1 / $n : 0", "b": "$k" })J");
  CHECK(e.text() == "");
  CHECK(liveOf(e) == "k");
  CHECK(e.uniform("p", "a").value == Value::number(0));
}

TEST_CASE("live: lets that double in length are no tree without end") {
  std::string lets = R"J("l0": "$k")J";
  for (int i = 1; i <= 30; ++i) {
    const std::string before = "$l" + std::to_string(i - 1);
    lets += R"J(, "l)J" + std::to_string(i) + R"J(": "()J" + before + " + " + before + R"J() / 2")J";
  }
  const Expanded e = expandPass(
      R"J("parameters": { "k": { "default": 1.5 }, "j": { "default": 1.0 } }, "let": { )J" + lets + " }",
      R"J("parameters": { "a": "$l30", "b": "$l5", "c": "$j" })J");
  CHECK(e.text() == "");
  CHECK(e.uniform("p", "a").value == Value::number(1.5));
  CHECK(liveOf(e) == "j");
}

TEST_CASE("lets over age() that double in length end in one message") {
  std::string lets = R"J("l0": "age(in)")J";
  for (int i = 1; i <= 30; ++i) {
    const std::string before = "$l" + std::to_string(i - 1);
    lets += R"J(, "l)J" + std::to_string(i) + R"J(": ")J" + before + " + " + before + R"J(")J";
  }
  const Expanded e =
      expandPass(R"J("let": { )J" + lets + " }", R"J("parameters": { "a": "$l30", "b": "$l5" })J");
  CHECK(e.has(text::Code::badExpression));
  CHECK(e.diagnostics.errorCount() == 1);
}

TEST_CASE("live: an expression that cannot be evaluated is reported as it was before") {
  const std::string head = R"J("parameters": { "n": { "default": 0.0 } })J";
  CHECK(expandPass(head, R"J("parameters": { "a": "1 / $n" })J").has(text::Code::noFiniteResult));
  CHECK(expandPass(head, R"J("parameters": { "a": "age(in) / $n" })J").has(text::Code::noFiniteResult));
  CHECK(expandPass(head, R"J("parameters": { "a": "1 / $n" })J", with({{"n", "4"}})).text() == "");
}

TEST_CASE("live: random values give every uniform of the bundled graphs the bits of a new expansion") {
  std::mt19937 random(8);
  std::size_t changed = 0, uniforms = 0;
  for (const char* name : {"studio", "glow", "daylight", "ibl", "bench_copy"}) {
    text::Diagnostics said;
    const auto desc = readGraph(std::string(WEFT_SOURCE_DIR) + "/graphs/" + name + ".json", said);
    REQUIRE_MESSAGE(desc, said.text());
    for (const bool all : {false, true}) {  // with everything on as well
      Settings settings;
      if (all && std::string(name) == "studio")
        for (const char* effect :
             {"dof", "motion_blur", "auto_exposure", "fog", "grain", "grading", "ibl.sliced"})
          settings.sets.emplace_back(effect, "true");
      const auto base = expandGraph(*desc, testRegistry(), settings, said);
      REQUIRE_MESSAGE(base, said.text());
      const std::string plan = dumpText(compile(base));
      const auto tryWith = [&](const std::vector<std::size_t>& which) {
        std::vector<Value> values = valuesOf(*base);
        Settings anew = settings;
        for (const std::size_t i : which) {
          values[i] = randomValue(base->parameters[i].desc, random);
          REQUIRE(takesValue(base->parameters[i].desc, values[i]));
          anew.sets.emplace_back(base->parameters[i].path, values[i], Origin::panel);
        }
        const auto made = expandGraph(*desc, testRegistry(), anew, said);
        REQUIRE_MESSAGE(made, said.text());
        compare(*base, values, *made);
        CHECK(dumpText(compile(made)) == plan);  // it is the same plan
      };
      std::vector<std::size_t> live;
      for (std::size_t i = 0; i < base->parameters.size(); ++i)
        if (!base->parameters[i].structural) live.push_back(i);
      for (const std::size_t i : live) tryWith({i});
      for (int round = 0; round < 10; ++round) tryWith(live);
      changed += live.size();
      for (const PassSpec& spec : base->specs)
        uniforms += static_cast<std::size_t>(
            std::ranges::count_if(spec.uniforms, [](const auto& u) { return u.dynamic.live(); }));
    }
  }
  MESSAGE(changed, " live parameters, ", uniforms, " uniforms that read them");
  CHECK(changed > 80);
  CHECK(uniforms > 60);
}

namespace {

Expanded followed(const std::string& parameters, const std::string& head = "", const std::string& keys = "") {
  return expandText(
      R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 } }, )J" + head +
      R"J("passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "r": "out" }, )J" +
      keys + R"J("parameters": { )J" + parameters + R"J( } } ], "present": "out" })J");
}

// "camera.position" of each, in the order of their keys.
std::string watchedOf(const Expanded& e) {
  const Registry registry = testRegistry();
  std::string all;
  for (const WatchedValue& each : e.graph->watched) {
    const ImportSpec& import = e.graph->imports[each.import];
    const auto type = std::ranges::find(registry.imports, import.request.type, &ImportType::name);
    all += import.name + "." + type->columns[each.column].name +
           (each.part == kWholeValue ? " " : "#" + std::to_string(each.part) + " ");
  }
  return all;
}

}  // namespace

TEST_CASE("values of imports are followed while the plan runs, also beside parameters and age()") {
  const Expanded e = followed(
      R"J("eye": "@camera.position", "mid": "@camera.near_plane / 2 + $gain", "up": "@camera.position.y * 2",
          "late": "age(out) * @sun.texel", "pair": ["@sun.texel", 1, 2, 3, 4])J",
      R"J("parameters": { "gain": { "default": 2.0 } }, )J");
  CHECK(e.text() == "");
  CHECK(watchedOf(e) == "@camera.position @camera.near_plane @sun.texel ");
  CHECK(e.uniform("p", "eye").value.count == 3);
  CHECK(e.uniform("p", "eye").dynamic.parameterKeys() == std::vector<std::uint32_t>{1});
  CHECK(e.uniform("p", "mid").dynamic.parameterKeys() == std::vector<std::uint32_t>{0, 2});
  CHECK_FALSE(e.graph->parameters[0].structural);
  const std::vector<Value> values = {
      Value::number(10), {Value::Type::list, 3, {1, 2, 3, 0}, {}}, Value::number(0.5), Value::number(4)};
  const auto threeSeconds = [](std::uint32_t) { return 3.0; };
  CHECK(e.uniform("p", "mid").dynamic.evaluateFolded({}, values) == Value::number(10.25));
  CHECK(e.uniform("p", "up").dynamic.evaluateFolded({}, values) == Value::number(4));
  CHECK(e.uniform("p", "late").dynamic.dynamic());
  CHECK(e.uniform("p", "late").dynamic.evaluateFolded(threeSeconds, values) == Value::number(12));
  CHECK(e.uniform("p", "pair").dynamic.evaluateFolded({}, values) == Value::number(4));
}

TEST_CASE("values of imports are followed through lets, from a let to another, beside parameters and age()") {
  const Expanded e =
      followed(R"J("eye": "$eye", "up": "$eye.y * $twice", "late": "$late", "plain": "$twice")J",
               R"J("parameters": { "gain": { "default": 2.0 } },
          "let": { "eye": "@camera.position", "twice": "$gain * $near", "near": "@camera.near_plane", "late": "age(out) + $near" }, )J");
  REQUIRE(e.text() == "");
  CHECK(watchedOf(e) == "@camera.position @camera.near_plane ");
  CHECK(e.uniform("p", "eye").value.count == 3);
  CHECK_FALSE(e.graph->parameters[0].structural);
  const std::vector<Value> values = {
      Value::number(10), {Value::Type::list, 3, {1, 2, 3, 0}, {}}, Value::number(0.5)};
  CHECK(e.uniform("p", "eye").dynamic.evaluateFolded({}, values).v[2] == 3);
  CHECK(e.uniform("p", "up").dynamic.evaluateFolded({}, values) == Value::number(10));
  CHECK(e.uniform("p", "plain").dynamic.evaluateFolded({}, values) == Value::number(5));
  const auto threeSeconds = [](std::uint32_t) { return 3.0; };
  CHECK(e.uniform("p", "late").dynamic.evaluateFolded(threeSeconds, values) == Value::number(3.5));
}

TEST_CASE("a matrix of an import is a column each; a row is known before the frame") {
  const Expanded e = followed(R"J("m": "@camera.view", "t": "@sun[0].texel")J");
  CHECK(e.text() == "");
  CHECK(watchedOf(e) == "@camera.view#0 @camera.view#1 @camera.view#2 @camera.view#3 @sun.texel ");
  CHECK(e.spec("p").uniforms[3].text() == "m[3]");
  CHECK(e.spec("p").uniforms[3].value.count == 4);
  const Expanded row =
      followed(R"J("t": "@sun[$row].texel")J", R"J("parameters": { "row": { "default": 0, "min": 0 } }, )J");
  CHECK(row.text() == "");
  CHECK(row.graph->parameters[0].structural);
}

TEST_CASE("values of imports stand in parameters only, have names, and are there") {
  CHECK(followed(R"J("a": 1)J", R"J("let": { "near": "@camera.near_plane" }, )J").text() ==
        "");  // nobody asks
  CHECK(followed(R"J("a": 1)J", R"J("let": { "near": "@camera.near_plane", "far": "$near * 2" }, )J",
                 R"J("enabled": "$far > 0", )J")
            .has(Code::badTime));
  CHECK(followed(R"J("a": 1)J", "", R"J("enabled": "@camera.near_plane > 0", )J").has(Code::badTime));
  const Expanded near = followed(R"J("a": "@camera.positon")J");
  CHECK(near.of(Code::unknownVariable).hint == "did you mean 'position'?");
  CHECK(followed(R"J("a": "@lamps.color")J").has(Code::unknownVariable));
  CHECK(followed(R"J("a": "@camra.position")J").has(Code::unknownImport));
  CHECK(followed(R"J("a": "@camera")J").has(Code::badExpression));
  CHECK(followed(R"J("a": "@camera.view * 2")J").has(Code::operandsDoNotFit));
  CHECK(followed(R"J("a": "@sun[0.5].texel")J").has(Code::operandsDoNotFit));
  // An on_change pass follows them; it sees no age().
  CHECK(followed(R"J("a": "@camera.near_plane")J", "", R"J("update": "on_change", )J").text() == "");
}

TEST_CASE("an import that is not there has no values, but behind has()") {
  const Registry none = testRegistry({.sun = false});
  const auto text = [](const std::string& value, const std::string& keys = "") {
    return R"J({ "resources": { "out": { "texture": "rgba8", "size": 8 } }, "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "side_effect": true, "write": { "r": "out" }, )J" +
           keys + R"J("parameters": { "a": ")J" + value + R"J(" } } ] })J";
  };
  CHECK(expandText(text("@sun.texel"), {}, none).has(Code::emptyImport));
  CHECK(expandText(text("has(@sun) ? @sun.texel : 3"), {}, none).uniform("p", "a").value == Value::number(3));
  CHECK(expandText(text("@sun.texel", R"J("enabled": "has(@sun)", )J"), {}, none).graph);
}
