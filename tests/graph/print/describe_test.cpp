// What `weft explain`, `weft diff` and `weft expand` print, on small graphs whose plans are known.
#include <doctest/doctest.h>

#include "engine/graph/compile/compile.h"
#include "engine/graph/print/print.h"
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

constexpr const char* kChain = R"({
  "name": "chain",
  "parameters": { "gain": { "type": "float", "default": 2 } },
  "resources": {
    "hdr": { "texture": "rgba16f", "size": 8, "mips": 3 }, "keys": { "buffer": 64 },
    "old": { "texture": "rgba8", "size": 8, "history": 1, "first": [0, 0, 0, 1] },
    "ldr": { "texture": "rgba8", "size": 8, "clear": 0 }
  },
  "passes": [
    { "name": "sky", "type": "fullscreen", "shader": "a.frag.glsl", "parameters": { "gain": "$gain" }, "write": { "result": "hdr.mip[0]" } },
    { "name": "down", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [1, 2] },
      "read": { "source": "hdr.mip[i-1] as linear" }, "write": { "result": "hdr.mip[i]" } },
    { "name": "sum", "type": "compute", "shader": "a.comp.glsl", "threads": 64, "read": { "source": "hdr" }, "write": { "keys": "keys" } },
    { "name": "mix", "type": "fullscreen", "shader": "a.frag.glsl", "state": { "blend": "add" },
      "read": { "keys": "keys", "before": "old@-1" }, "modify": { "result": "ldr" } },
    { "name": "tint", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "source": "ldr" }, "write": { "result": "ldr" } },
    { "name": "keep", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "source": "ldr" }, "write": { "result": "old" } }
  ],
  "present": "ldr"
})";

std::shared_ptr<const Plan> planOf(const std::string& text, const Settings& settings = {}) {
  text::Diagnostics diagnostics;
  const auto desc = readGraphText(text, "chain.json", diagnostics);
  REQUIRE_MESSAGE(desc, diagnostics.text());
  const auto flat = expandGraph(*desc, testRegistry(), settings, diagnostics);
  REQUIRE_MESSAGE(flat, diagnostics.text());
  return std::make_shared<const Plan>(compile(flat));
}

std::string described(const Plan& plan, const char* name) {
  text::Diagnostics diagnostics;
  const auto text = describe(plan, name, diagnostics);
  REQUIRE_MESSAGE(text, diagnostics.text());
  return *text;
}

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a pass is explained with its slots, who made what it reads, and its barriers") {
  const auto plan = planOf(kChain);
  const std::string mix = described(*plan, "mix");
  INFO(mix);
  CHECK(has(mix, "pass mix: fullscreen at chain.json:"));
  CHECK(has(mix, "read keys: keys as storage, made by 'sum'"));
  CHECK(has(mix, "read before: old@-1 as sampled, made by 'keep'"));
  CHECK(
      has(mix, "barrier shader_storage: 'sum' writes 'keys' as storage, then 'mix' reads 'keys' as storage"));
  // A name means all its repeats; one of them can be named.
  CHECK(has(described(*plan, "down"), "pass down[2]: fullscreen"));
  CHECK_FALSE(has(described(*plan, "down[1]"), "down[2]: fullscreen"));
}

TEST_CASE("resources, their versions and parameters are explained") {
  const auto plan = planOf(kChain);
  const std::string ldr = described(*plan, "ldr");
  INFO(ldr);
  CHECK(has(ldr, "resource ldr: texture rgba8 8x8, 256 bytes at chain.json:"));
  CHECK(has(ldr, "modified by 'mix' as color: ldr"));
  CHECK(has(ldr, "resource ldr#2: "));
  CHECK(has(ldr, "is presented"));
  const std::string gain = described(*plan, "gain");
  CHECK(has(gain, "parameter gain = 2, from the default"));
  CHECK(has(gain, "is read by 'sky' as 'gain'"));
}

TEST_CASE("what is disabled says why, and an unknown name gets the nearest") {
  const auto plan = planOf(kChain, {.disables = {"tint"}});
  CHECK(described(*plan, "tint") == "pass tint: disabled, --disable tint\n");
  text::Diagnostics diagnostics;
  CHECK_FALSE(describe(*plan, "doen", diagnostics));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == text::Code::unknownPass);
  CHECK(has(diagnostics.items()[0].hint, "down"));
}

TEST_CASE("equal plans differ in nothing; a disabled pass, a moved one and a size are told") {
  const auto plan = planOf(kChain);
  CHECK(diffText(*plan, *planOf(kChain)).empty());
  const std::string without = diffText(*plan, *planOf(kChain, {.disables = {"tint"}}));
  INFO(without);
  CHECK(has(without, "- pass tint: step 5 before, now disabled, --disable tint\n"));
  CHECK(has(without, "- resource ldr#2: texture rgba8 8x8"));
  const std::string back = diffText(*planOf(kChain, {.disables = {"tint"}}), *plan);
  CHECK(has(back, "+ pass tint: disabled, --disable tint before, now step 5\n"));

  std::string moved = kChain;
  const std::size_t from = moved.find("    { \"name\": \"tint\""),
                    to = moved.find("    { \"name\": \"keep\"");
  const std::string tint = moved.substr(from, to - from);
  moved.erase(from, to - from);
  moved.insert(moved.find("    { \"name\": \"mix\""), tint);
  const std::string order = diffText(*plan, *planOf(moved));
  INFO(order);
  CHECK((has(order, "~ pass tint: step 5 before, now step 4\n") ||
         has(order, "~ pass mix: step 4 before, now step 5\n")));

  std::string larger = kChain;
  larger.replace(larger.find("\"buffer\": 64"), 12, "\"buffer\": 96");
  CHECK(has(diffText(*plan, *planOf(larger)),
            "~ resource keys: buffer of 64 bytes before, now buffer of 96 bytes\n"));
}

TEST_CASE("lists of alternatives, imports under names of their own and tables are explained") {
  const auto plan = planOf(R"({
    "name": "names",
    "parameters": { "sunny": { "default": true } },
    "resources": {
      "eye": { "import": "camera", "jitter": 8 }, "again": { "import": "spheres" }, "hdr": { "texture": "rgba8", "size": 8 },
      "sky": ["@environment if $sunny", "hdr"]
    },
    "passes": [
      { "name": "fill", "type": "fullscreen", "shader": "a.frag.glsl", "view": "eye",
        "read": { "table": "@spheres", "same": "again", "back": "sky" }, "write": { "result": "hdr" } }
    ],
    "present": "hdr"
  })");
  const std::string eye = described(*plan, "eye");
  INFO(eye);
  CHECK(has(eye, "import eye: view @camera at chain.json:5:7\n"));
  CHECK(has(eye, "argument jitter = 8\n"));
  CHECK(has(eye, "is the view of 'fill'\n"));
  // An import is known by its type, too, and by each name that the files give it.
  CHECK(described(*plan, "@camera") == eye);
  const std::string table = described(*plan, "@spheres");
  INFO(table);
  CHECK(has(table, "resource "));
  CHECK(has(table, "buffer @spheres, 4800 bytes"));
  CHECK_FALSE(has(table, " 0 bytes"));
  CHECK(has(described(*plan, "again"), "read by 'fill' as storage"));
  // What a list stands for follows it.
  const std::string sky = described(*plan, "sky");
  INFO(sky);
  CHECK(has(sky, "name sky: the first that is there of '@environment if $sunny', 'hdr' at chain.json:6:7\n"));
  CHECK(has(sky, "resource @environment: texture rgba16f 2048x1024"));
  CHECK(has(sky, "resource hdr: texture rgba8 8x8"));
}
