// Which enabled passes do not reach the picture, and what is said of them.
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

constexpr const char* kResources = R"J("resources": {
  "hdr": { "texture": "rgba16f", "size": 8 }, "glow": { "texture": "rgba16f", "size": 8 },
  "ldr": { "texture": "rgba8", "size": 8 })J";

// "name: read a b > write c, modify d" as a fullscreen pass.
std::string pass(const std::string& name, const std::string& slots) {
  return R"J({ "name": ")J" + name + R"J(", "type": "fullscreen", "shader": "a.frag.glsl", )J" + slots + " }";
}

const std::string kSky = pass("sky", R"J("write": { "r": "hdr" })J");
const std::string kBalls =
    pass("balls", R"J("modify": { "r": "hdr", "depth": "depth" }, "state": { "depth_test": "greater" })J");
const std::string kBloom = pass("bloom", R"J("read": { "s": "hdr" }, "write": { "r": "glow" })J");
const std::string kShow = pass("show", R"J("read": { "s": "hdr", "g": "glow?" }, "write": { "r": "ldr" })J");

Expanded tell(const std::vector<std::string>& passes, const Settings& settings = {},
              const std::string& rest = "") {
  std::string all;
  for (const std::string& each : passes) all += (all.empty() ? "" : ", ") + each;
  const bool depth = all.find("\"depth\"") != std::string::npos;
  const std::string maybe = all.find("maybe") != std::string::npos ? R"J(, "maybe": ["glow if $on"])J" : "";
  const std::string more =
      maybe + (depth ? R"J(, "depth": { "texture": "depth32f", "size": 8, "clear": 0 } })J" : " }");
  return expandText(std::string("{ ") + kResources + more + R"J(, "passes": [ )J" + all +
                        R"J( ], "present": "ldr")J" + rest + " }",
                    settings);
}

}  // namespace

TEST_CASE("a graph of which every pass reaches the picture says nothing") {
  CHECK(tell({kSky, kBalls, kBloom, kShow}).text() == "");
}

TEST_CASE("a background over what was drawn: one message at the last thing drawn, with what only feeds it") {
  const Expanded e = tell({pass("ground", R"J("write": { "r": "hdr" })J"), kBalls, kSky, kBloom, kShow});
  REQUIRE_MESSAGE(e.diagnostics.size() == 1, e.text());
  CHECK(e.of(text::Code::culledOverwritten).message ==
        "pass 'balls' is culled: 'sky' overwrites 'hdr' before anybody reads it; with it: 'ground'");
  CHECK(e.of(text::Code::culledOverwritten).hint == "move 'sky' above 'balls', or read 'hdr' in between");
}

TEST_CASE("an effect below its reader") {
  const Expanded e = tell({kSky, kShow, kBloom});
  REQUIRE_MESSAGE(e.diagnostics.size() == 1, e.text());
  CHECK(e.of(text::Code::culledUnread).message ==
        "pass 'bloom' is culled: 'show', which reads 'glow', stands above it");
  CHECK(e.of(text::Code::culledUnread).hint == "move 'bloom' above 'show', or disable 'bloom'");
}

TEST_CASE("what a pass that runs draws, and another throws away") {
  const Expanded e = tell({pass("ground", R"J("write": { "r": "hdr", "g": "glow" })J"), kSky, kShow});
  REQUIRE_MESSAGE(e.diagnostics.size() == 1, e.text());
  CHECK(e.of(text::Code::culledOverwritten).message ==
        "what pass 'ground' writes to 'hdr' is lost: 'sky' overwrites 'hdr' before anybody reads it");
}

TEST_CASE("what feeds only what is switched off is no mistake, by whatever it is switched off") {
  const std::string rest = R"J(, "parameters": { "on": { "default": true } })J";
  const std::string needs =
      pass("show", R"J("read": { "s": "hdr", "g": "maybe ?" }, "write": { "r": "ldr" })J");
  const std::string between =
      pass("tint", R"J("enabled": "$on", "read": { "g": "glow" }, "modify": { "r": "hdr" })J");
  CHECK(tell({kSky, kBloom, needs}, with({{"on", "false"}}), rest).text() == "");
  CHECK(tell({kSky, kBloom, between, pass("show", R"J("read": { "s": "hdr" }, "write": { "r": "ldr" })J")},
             with({{"on", "false"}}), rest)
            .text() == "");
  CHECK(tell({kSky, kBloom, pass("mix", R"J("read": { "g": "glow" }, "modify": { "r": "hdr" })J"),
              pass("show", R"J("read": { "s": "hdr" }, "write": { "r": "ldr" })J")},
             with({}, {"mix"}))
            .text() == "");
  // Whether or not another pass stands in the place of the one that is off.
  const std::string use =
      pass("use", R"J("enabled": "$on", "read": { "g": "glow", "s": "hdr" }, "write": { "r": "ldr" })J");
  CHECK(tell({kSky, kBloom, use,
              pass("else", R"J("enabled": "!$on", "read": { "s": "hdr" }, "write": { "r": "ldr" })J")},
             with({{"on", "false"}}), rest)
            .text() == "");
  CHECK(tell({kSky, kBloom, pass("first", R"J("read": { "s": "hdr" }, "write": { "r": "ldr" })J"), use},
             with({{"on", "false"}}), rest)
            .text() == "");
  // But what would not be read either, if it were there, is.
  const Expanded e =
      tell({kSky, kShow, pass("late", R"J("read": { "g": "glow?" }, "modify": { "r": "hdr" })J"), kBloom},
           with({}, {"late"}));
  CHECK(e.of(text::Code::culledUnread).pass == "bloom");
}

TEST_CASE("below the last reader, what only passes that are off would see") {
  const std::string late = pass("late", R"J("modify": { "r": "hdr" })J");
  const std::string unseen =
      pass("off", R"J("enabled": false, "read": { "s": "hdr" }, "write": { "r": "glow" })J");
  const std::string next =
      pass("off", R"J("enabled": false, "read": { "b": "hdr@-1" }, "modify": { "r": "hdr" })J");
  const Expanded a = tell({kSky, kShow, late, unseen});
  const Expanded b = expandText(R"J({ "resources": { "ldr": { "texture": "rgba8", "size": 8 },
      "hdr": { "texture": "rgba16f", "size": 8, "history": 1, "first": 0 } }, "passes": [ )J" +
                                kSky + ", " + next + ", " +
                                pass("show", R"J("read": { "s": "hdr" }, "write": { "r": "ldr" })J") + ", " +
                                late + R"J( ], "present": "ldr" })J");
  // What has a side effect would see it.
  CHECK(
      tell(
          {kSky, kShow, late,
           pass(
               "off",
               R"J("enabled": false, "side_effect": true, "read": { "s": "hdr" }, "write": { "r": "glow" })J")})
          .text() == "");
  for (const Expanded& e : {a, b}) {
    REQUIRE_MESSAGE(e.diagnostics.size() == 1, e.text());
    CHECK(e.of(text::Code::culledUnread).message ==
          "pass 'late' is culled: 'show', which reads 'hdr', stands above it");
  }
}

TEST_CASE("far more readers and writers than one looks at one by one") {
  std::vector<std::string> passes{kSky};
  for (int i = 0; i < 100; ++i)
    passes.push_back(pass("p" + std::to_string(i), R"J("read": { "s": "hdr" }, "write": { "r": "hdr" })J"));
  passes.push_back(kShow);
  CHECK(tell(passes).text() == "");
  passes.push_back(pass("late", R"J("read": { "s": "hdr" }, "write": { "r": "hdr" })J"));
  CHECK(tell(passes).of(text::Code::culledUnread).message ==
        "pass 'late' is culled: 'show', which reads 'hdr', stands above it");
}

TEST_CASE("an optional slot that a pass below would fill, and what is no such slot") {
  const std::string flare = pass("flare", R"J("read": { "g": "glow" }, "modify": { "r": "ldr" })J");
  const Expanded e = tell({kSky, kShow, kBloom, flare});
  REQUIRE_MESSAGE(e.diagnostics.size() == 1, e.text());
  CHECK(e.of(text::Code::readBeforeWrite).message ==
        "pass 'show' reads 'glow' before pass 'bloom' writes it: its slot 'g' stays empty");
  CHECK(e.of(text::Code::readBeforeWrite).severity == text::Severity::warning);
  // Where a pass above is switched off, its absence is why.
  CHECK(
      tell({kSky, pass("early", R"J("write": { "r": "glow" })J"), kShow, kBloom, flare}, with({}, {"early"}))
          .text() == "");
}

TEST_CASE("a chain by alternatives begins with what is there before its first link") {
  const auto told = [](const std::string& passes) {
    return expandText(R"J({ "resources": { "start": { "texture": "rgba8", "size": 8 },
      "hdr": { "texture": "rgba8", "size": 8 }, "light": ["hdr", "start"] }, "passes": [ )J" +
                      pass("begin", R"J("write": { "r": "start" })J") + ", " + passes +
                      R"J( ], "present": "light" })J");
  };
  const auto link = [](const std::string& name) {
    return pass(name, R"J("read": { "s": "light" }, "write": { "r": "hdr" })J");
  };
  CHECK(told(link("one") + ", " + link("two") + ", " + link("three")).text() == "");
  // What begins it anew throws away what was there.
  const Expanded anew = told(link("one") + ", " + pass("new", R"J("write": { "r": "hdr" })J"));
  CHECK(anew.of(text::Code::culledOverwritten).pass == "one");
}

TEST_CASE("no fix is one that takes away what is needed, or switches on what is on") {
  const auto told = [](const std::string& mips, const std::string& show) {
    return expandText(
        R"J({ "resources": { "glow": { "texture": "rgba8", "size": 8, "mips": )J" + mips +
        R"J( }, "ldr": { "texture": "rgba8", "size": 8 } }, "passes": [ )J" +
        pass("first", R"J("write": { "r": "glow.mip[0]" })J") + ", " +
        pass("down", R"J("repeat": { "i": [1, "mips(glow)-1"] },
                        "read": { "s": "glow.mip[i-1]" }, "write": { "r": "glow.mip[i]" })J") +
        ", " + pass("show", R"J("read": { "s": "glow.mip[)J" + show + R"J(]" }, "write": { "r": "ldr" })J") +
        R"J( ], "present": "ldr" })J");
  };
  CHECK(told("3", "2").text() == "");
  const Expanded last = told("3", "1");  // of its repeats, one is lost
  CHECK(last.of(text::Code::culledUnread).hint.find("disable") == std::string::npos);
  const Expanded small = told("9", "5");  // 8 texels have 4 levels
  CHECK(small.of(text::Code::disabledWriter).hint.find("enable") == std::string::npos);
}

TEST_CASE("what \"clear\" says in place of what is drawn below; a chain that begins so is meant") {
  const Expanded e = tell(
      {pass("fog", R"J("read": { "d": "depth" }, "write": { "r": "hdr" })J"),
       pass("balls", R"J("modify": { "r": "hdr", "depth": "depth" }, "state": { "depth_test": "greater" })J"),
       pass("show", R"J("read": { "s": "hdr", "d": "depth" }, "write": { "r": "ldr" })J")});
  CHECK(e.of(text::Code::readBeforeWrite).message ==
        "pass 'fog' reads 'depth' before pass 'balls' writes it: its slot 'd' has only what \"clear\" says");
  const std::string sums = R"J({ "resources": { "a": { "buffer": 16, "clear": 0 }, "b": { "buffer": 16 },
    "ldr": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "up", "type": "compute", "shader": "a.comp.glsl", "threads": 4, "read": { "a": "a" }, "write": { "b": "b" } },
    { "name": "down", "type": "compute", "shader": "a.comp.glsl", "threads": 4, "read": { "b": "b" }, "write": { "a": "a" } },
    { "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "a": "a" }, "write": { "r": "ldr" } } ],
    "present": "ldr" })J";
  CHECK(expandText(sums).text() == "");
}

TEST_CASE("a part that a pass below draws, and a part that an alternative that is off does not read") {
  // "far" alone is read where "on" is true, so that "halve" writes the other layer for nobody.
  const auto told = [](const std::string& passes) {
    return expandText(R"J({ "parameters": { "on": { "default": false } }, "resources": {
      "fields": { "texture": "rgba8", "size": 8, "mips": 2, "layers": 2, "clear": [0, 0, 0, 0] },
      "far": ["fields.layer[1] if $on"], "ldr": { "texture": "rgba8", "size": 8 } }, "passes": [ )J" +
                      passes + R"J( ], "present": "ldr" })J");
  };
  const std::string split = pass("split", R"J("write": { "r": "fields.mip[0]" })J") + ", ";
  const std::string show =
      pass("show", R"J("read": { "s": "fields.layer[0]", "far": "far ?" }, "write": { "r": "ldr" })J");
  const auto halve = [](const std::string& layer) {
    return pass("halve", R"J("modify": { "r": "fields.mip[1])J" + layer + R"J(" })J");
  };
  CHECK(told(split + halve(".layer[0]") + ", " + show).text() == "");
  const Expanded late = told(split + show + ", " + halve(".layer[0]"));
  REQUIRE(late.diagnostics.size() > 0);
  CHECK(late.text().find("'halve'") != std::string::npos);
  // Read in full above all writers: each of them is named that no longer runs.
  const std::string off = ", " + pass("after", R"J("read": { "far": "far ?" }, "modify": { "r": "ldr" })J");
  const Expanded first = told(show + ", " + split + halve("") + off);
  CHECK(first.text().find("'halve'") != std::string::npos);
  // Of the layer that it would read, what is off keeps the writer; of the other one it does not.
  CHECK(told(split + show + ", " + halve(".layer[1]") + off).text() == "");
  CHECK(told(split + show + ", " + halve(".layer[0]") + off).text() != "");
}

TEST_CASE(
    "the second of two alternatives is not read while the first is there; by a condition that is meant") {
  const auto told = [](const char* list) {
    return expandText(std::string(R"J({ "parameters": { "on": { "default": true } }, "resources": {
      "a": { "texture": "rgba8", "size": 8 }, "b": { "texture": "rgba8", "size": 8 }, "either": )J") +
                      list + R"J(, "ldr": { "texture": "rgba8", "size": 8 } }, "passes": [ )J" +
                      pass("make_a", R"J("write": { "r": "a" })J") + ", " +
                      pass("make_b", R"J("write": { "r": "b" })J") + ", " +
                      pass("show", R"J("read": { "s": "either" }, "write": { "r": "ldr" })J") +
                      R"J( ], "present": "ldr" })J");
  };
  CHECK(told(R"J(["a if $on", "b"])J").text() == "");
  CHECK(told(R"J(["a", "b"])J").of(text::Code::culledUnread).pass == "make_b");
}

TEST_CASE("an output is a reader; one that nothing writes is an error, or left out with '?'") {
  const auto told = [](const std::string& output, const Settings& settings = {}) {
    return expandText(
        R"J({ "resources": { "counts": { "buffer": 16, "clear": 0 }, "ldr": { "texture": "rgba8", "size": 8 } },
      "passes": [ { "name": "count", "type": "compute", "shader": "a.comp.glsl", "threads": 4, "modify": { "c": "counts" } }, )J" +
            pass("show", R"J("write": { "r": "ldr" })J") + R"J( ], "present": "ldr", "outputs": { "n": ")J" +
            output + "\" } }",
        settings);
  };
  CHECK(told("counts").text() == "");
  CHECK(told("counts?", with({}, {"count"})).graph->outputs.empty());
  CHECK(told("counts", with({}, {"count"})).has(text::Code::disabledWriter));
}

TEST_CASE(
    "what stays attached: what is modified by storage or image, and one attachment of a pass that stores") {
  const Expanded e = expandText(
      R"J({ "resources": { "list": { "buffer": 16, "clear": 0 }, "used": { "buffer": 4, "clear": 0 },
    "marks": { "texture": "r32ui", "size": 8, "clear": 0 }, "raster": { "texture": "r8", "size": 8, "clear": 0 },
    "other": { "texture": "r8", "size": 8, "clear": 0 }, "ldr": { "texture": "rgba8", "size": 8 } }, "passes": [
    { "name": "place", "type": "compute", "shader": "a.comp.glsl", "threads": 4, "modify": { "list": "list", "used": "used" } },
    { "name": "mark", "type": "draw", "geometry": "triangle", "instances": 1, "shader": "a",
      "modify": { "raster": "raster", "other": "other", "marks": "marks as image" } },
    { "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "list": "list", "marks": "marks" },
      "write": { "r": "ldr" } } ], "present": "ldr" })J");
  CHECK(e.use("place", "used").keep);
  CHECK(e.use("mark", "marks").keep);
  CHECK(e.use("mark", "raster").keep);
  CHECK_FALSE(e.use("mark", "other").keep);
  CHECK_FALSE(e.use("show", "r").keep);
}
