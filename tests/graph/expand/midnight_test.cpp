// Mistakes that a person makes at midnight, typed into a graph that is right: one message each, with the fix that mends it.
#include <doctest/doctest.h>

#include "engine/graph/compile/compile.h"
#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

constexpr const char* kNightGraph = R"({
  "parameters": {
    "bloom": { "default": true },
    "tone":  { "default": "soft", "choices": ["soft", "hard"] },
    "keep":  { "default": 0.9 }
  },
  "resources": {
    "scene": { "texture": "rgba16f", "size": "screen" },
    "glow":  { "texture": "rgba16f", "size": "screen/2", "mips": 4 },
    "depth": { "texture": "depth32f", "size": "screen", "clear": 0 },
    "sums":  { "buffer": "4*256", "clear": 0 },
    "trail": { "texture": "rgba16f", "size": "screen", "history": 1, "first": 0 },
    "ldr":   { "texture": "rgba8", "size": "screen" }
  },
  "passes": [
    { "name": "paint", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "radiance": "scene" } },
    { "name": "bright", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": "$bloom",
      "read": { "source": "scene as linear" }, "write": { "result": "glow.mip[0]" } },
    { "name": "down", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": "$bloom", "repeat": { "i": [1, 3] },
      "read": { "source": "glow.mip[i-1]" }, "write": { "result": "glow.mip[i]" }, "state": { "blend": "none" } },
    { "name": "follow", "type": "fullscreen", "shader": "a.frag.glsl",
      "read": { "now": "scene", "before": "trail@-1" }, "write": { "result": "trail" }, "parameters": { "keep": "$keep" } },
    { "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "color": "trail", "glow": "glow ?", "sums": "sums", "depth": "depth" },
      "write": { "result": "ldr" }, "defines": { "TONE": "$tone" } }
  ],
  "present": "ldr" })";

// What is said of the graph with `right` written wrong. Nothing may crash on what is left, either.
text::Diagnostics saidOfNight(const std::string& right, const std::string& wrong) {
  std::string text = kNightGraph;
  const std::size_t at = text.find(right);
  REQUIRE_MESSAGE(at != std::string::npos, right);
  text.replace(at, right.size(), wrong);
  text::Diagnostics diagnostics;
  const auto desc = readGraphText(text, "midnight.json", diagnostics);
  if (desc) expandGraph(*desc, testRegistry(), {}, diagnostics);
  return diagnostics;
}

void checkOne(const char* right, const char* wrong, text::Code code, std::string_view message,
              std::string_view hint) {
  const text::Diagnostics said = saidOfNight(right, wrong);
  INFO(wrong, "\n", said.text());
  REQUIRE(said.size() == 1);
  const text::Diagnostic& d = said.items()[0];
  CHECK(d.severity == text::Severity::error);
  CHECK(d.code == code);
  CHECK(d.message.find(message) != std::string::npos);
  CHECK(d.hint.find(hint) != std::string::npos);
}

}  // namespace

TEST_CASE("the graph is right before a mistake is made in it") {
  CHECK(saidOfNight("\"ldr\"", "\"ldr\"").empty());
}

TEST_CASE("a mistake at midnight: expressions in the words of other languages") {
  using enum text::Code;
  const char *size = "\"rgba8\", \"size\": \"screen\"", *enabled = "\"enabled\": \"$bloom\"",
             *bytes = "\"4*256\"";
  checkOne(size, "\"rgba8\", \"size\": \"1920,1080\"", badExpression, "is no value", "write [1920, 1080]");
  checkOne(size, "\"rgba8\", \"size\": \"screen*0.5px\"", badExpression, "is no value", "write 'screen*0.5'");
  checkOne(size, "\"rgba8\", \"size\": \"scene\"", wrongValueType, "is no size", "write 'size(scene)'");
  checkOne(size, "\"rgba8\", \"size\": \"scene.size\"", badExpression, "is no value", "size(scene)");
  checkOne(size, "\"rgba8\", \"size\": \"scene.width/2\"", badExpression, "is no value", "size(scene)");
  checkOne(bytes, "\"uint[256]\"", badExpression, "is no value", "write 256*4");
  checkOne(enabled, "\"enabled\": \"$tone == 'hard'\"", badExpression, "unexpected '''", "without quotes");
  checkOne("\"blend\": \"none\"", "\"blend\": [\"src_alpha\", \"one\"]", wrongType,
           "\"blend\" has the wrong type", "premultiplied");
  checkOne("\"blend\": \"none\"", "\"blend\": { \"src\": \"one\", \"dst\": \"one\" }", badState,
           "blends 'src'", "'alpha' is src_alpha");
  checkOne(bytes, "\"4 * 2^8\"", badExpression, "unexpected '^'", "there is no power");
  checkOne(bytes, "\"mips(scene.mip[0])\"", badExpression, "'.mip' selects", "size(scene)");
  checkOne(bytes, "\"scene.mip[0]\"", badExpression, "'scene.mip' is no value", "size(scene)");
  checkOne(bytes, "\"camera.position.x\"", badExpression, "is no value", "has 'camera_position'");
  checkOne(enabled, "\"enabled\": \"on\"", wrongValueType, "is no condition", "write true");
  checkOne(enabled, "\"enabled\": \"${bloom}\"", badExpression, "'$' stands without a name",
           "without braces");
  checkOne(enabled, "\"groups\": [8, 8, 1]", unknownKey, "\"groups\"", "\"threads\" counts invocations");
  checkOne(enabled, "\"clear_color\": [0, 0, 0]", unknownKey, "\"clear_color\"",
           "set \"clear\" on the texture");
  checkOne("\"fullscreen\"", "\"postprocess\"", unknownPassType, "unknown type", "write 'fullscreen'");
}

TEST_CASE("a mistake at midnight: references") {
  using enum text::Code;
  checkOne("\"now\": \"scene\"", "\"now\": \"$scene\"", badReference, "'$' where a name is expected",
           "resources have no '$'");
  checkOne("\"now\": \"scene\"", "\"now\": \"scene linear\"", badReference, "unexpected 'linear'",
           "write 'as linear'");
  checkOne("\"now\": \"scene\"", "\"now\": \"trail@prev\"", badReference, "history is written",
           "write 'trail@-1'");
  checkOne("\"now\": \"scene\"", "\"now\": \"trail[-1]\"", badSelector, "is no array", "write 'trail@-1'");
  checkOne("\"glow.mip[0]\"", "\"glow[0]\"", badSelector, "is no array", "'glow.mip[…]'");
  checkOne("\"now\": \"scene\"", "\"now\": \"depth.stencil\"", badSelector, "has no stencil",
           "depth32f_stencil8");
  checkOne("\"glow ?\"", "\"?glow\"", badReference, "'?' where a name is expected", "at the very end");
  checkOne("\"present\": \"ldr\"", "\"present\": \"$bloom ? glow : ldr\"", badReference, "'$'",
           "[\"a if $x\", \"b\"]");
  checkOne("\"present\": \"ldr\"", "\"present\": \"depth\"", badKind, "no color texture", "present that");
  checkOne("\"now\": \"scene\"", "\"now\": \"scene as compare\"", badFormat, "does not fit",
           "leave 'compare' out");
  checkOne("\"present\": \"ldr\"", "\"present\": \"ldr\", \"outputs\": { \"bins\": \"sum\" }",
           unknownResource, "output 'bins' reads the unknown resource 'sum'", "'sums'");
}

TEST_CASE(
    "a mistake at midnight: declarations in the form of another engine, and nothing follows from them") {
  using enum text::Code;
  checkOne("\"texture\": \"rgba8\"", "\"texture\": { \"format\": \"rgba8\" }", wrongType,
           "\"texture\" has the wrong type", "texel format");
  checkOne("\"buffer\": \"4*256\"", "\"buffer\": { \"bytes\": 1024 }", wrongType,
           "\"buffer\" has the wrong type", "");
  checkOne("\"mips\": 4", "\"mips\": true", wrongValueType, "the number of mips", "\"full\"");
  checkOne("\"mips\": 4", "\"mips\": \"all\"", wrongValueType, "the number of mips", "\"full\"");
  checkOne("\"history\": 1, \"first\": 0", "\"first\": 0", keysExclude, "keeps no history", "\"history\": 1");
  checkOne("\"default\": 0.9", "\"default\": \"#ffffff\"", missingKey, "a string as its default", "");
  checkOne("\"default\": \"soft\"", "\"default\": \"Soft\"", notAChoice, "not one of the choices",
           "\"soft\"");
  checkOne("\"type\": \"fullscreen\", \"shader\": \"a.frag.glsl\"", "\"feedback\": false", missingKey,
           "neither a \"type\" nor a \"shader\"", "\"type\"");
  checkOne("\"repeat\": { \"i\": [1, 3] }", "\"repeat\": { \"i\": 3 }", wrongType, "\"i\" has the wrong type",
           "");
  checkOne("\"repeat\": { \"i\": [1, 3] }", "\"repeat\": { \"i\": [1, \"glow.mips - 1\"] }", badExpression,
           "is no value", "mips(glow)");
  checkOne("{ \"radiance\": \"scene\" }", "{ \"radiance\": \"@environment\" }", notWritable,
           "which is an import", "of the graph's own");
}

TEST_CASE("a texture that no pass writes is one mistake, however many passes read it") {
  using enum text::Code;
  checkOne(
      "{ \"name\": \"paint\", \"type\": \"fullscreen\", \"shader\": \"a.frag.glsl\", \"write\": { "
      "\"radiance\": \"scene\" } },",
      "", nobodyWrites, "pass 'bright' and one more read 'scene', which no pass writes",
      "let a pass before it write it");
  // Two textures are two mistakes.
  const text::Diagnostics said =
      saidOfNight("\"write\": { \"result\": \"trail\" }", "\"write\": { \"result\": \"ldr\" }");
  CHECK_MESSAGE(said.contains(nobodyWrites), said.text());
}

// The dead instance comes first, and only warns; the live one of the same stanza is an error all the same.
TEST_CASE(
    "midnight: a live read of what nobody writes is an error, also behind a dead read by the same stanza") {
  constexpr const char* kHalfDead = R"({
    "resources": {
      "src": { "texture": "rgba8", "size": "screen", "array": 2 },
      "dst": { "texture": "rgba8", "size": "screen", "array": 2 } },
    "passes": [
      { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [0, 1] },
        "read": { "source": "src[i]" }, "write": { "result": "dst[i]" } } ],
    "present": "dst[1]" })";
  text::Diagnostics diagnostics;
  const auto desc = readGraphText(kHalfDead, "half_dead.json", diagnostics);
  REQUIRE(desc);
  CHECK_FALSE(expandGraph(*desc, testRegistry(), {}, diagnostics));
  CHECK(diagnostics.errorCount() == 1);
}
